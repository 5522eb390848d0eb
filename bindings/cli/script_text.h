/// Facts from the text of a script before it runs.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lissom::cli {

struct ScriptTraits {
    /// Whether it may declare parameters: it names `params`, or requires modules that could.
    bool may_declare = false;
    /// Whether it reads the words of the command line by itself: it names `arg`.
    bool reads_words = false;
};

/// Looks for words, also in comments and strings: the answer false is certain.
ScriptTraits script_traits(std::string_view text);

/// Returns whether it may call `test`: looks for the word, as script_traits does.
bool calls_test(std::string_view text);

/// Returns whether it is a recording of tools, as the window writes them.
bool is_recording(std::string_view text);

/// Returns a text without the byte order mark that editors put before it.
std::string_view without_mark(std::string_view text);

/// Returns the text of a regular file, or of the standard input for "-", without a byte order mark;
/// nothing if it cannot be read.
std::optional<std::string> script_text(const std::string& file);

}  // namespace lissom::cli
