/// Places in files that a message names, and the editor that opens them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lissom::window {

struct SourcePlace {
    std::string file;
    /// From 1.
    int line = 1;

    bool operator==(const SourcePlace&) const = default;
};

/// Returns the first FILE:LINE in `text` whose file `exists`; names of files may have blanks.
std::optional<SourcePlace> find_place(std::string_view text,
                                      const std::function<bool(const std::string&)>& exists);

/// Returns the words of the command that opens `place` with `editor`, a value of $VISUAL: a program
/// and options. Knows how the common editors are told a line; others get "+LINE FILE", as vi does.
std::vector<std::string> editor_command(std::string_view editor, const SourcePlace& place);

/// Functions of the system for opening a file.
struct EditorHost {
    /// Returns the value of a variable of the environment; null if it is not set.
    std::function<const char*(const char*)> variable;
    /// Starts a program with these words, the first its name, without a shell; returns an error, or
    /// nothing.
    std::function<std::string(const std::vector<std::string>&)> start;
};

/// Opens `place` in $VISUAL, else $EDITOR. Returns a message for the person if that fails, or
/// nothing.
std::string open_in_editor(const SourcePlace& place, const EditorHost& host);

/// Programs that were started, in the terminal that this one was started from.
class StartedPrograms {
  public:
    /// Starts `words`; returns an error, or nothing.
    std::string start(const std::vector<std::string>& words);
    /// Returns failures of started programs since the last call, in words.
    std::vector<std::string> failures();

  private:
    struct Started {
        int id = 0;
        std::string name;
    };
    std::vector<Started> started_;
};

}  // namespace lissom::window
