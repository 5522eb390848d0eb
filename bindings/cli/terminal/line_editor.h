/// Reads lines from a person, with editing, completion and a history that is kept in a file, or
/// from a file.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "bindings/cli/repl/completion.h"
#include "bindings/cli/terminal/history.h"
#include "bindings/cli/terminal/typed_line.h"

namespace lissom::cli {

/// Callbacks of a line editor; both may be empty.
struct LineEditorOptions {
    /// Returns the completions of the line up to the cursor.
    std::function<Completions(const std::string& line)> complete = {};
    /// Whether Ctrl-C was pressed since the last line; asked while a line is typed.
    std::function<bool()> interrupted = {};
    /// File that keeps lines between runs; empty for none.
    std::filesystem::path history = {};
};

class LineEditor {
  public:
    explicit LineEditor(LineEditorOptions options = {});
    ~LineEditor();
    LineEditor(const LineEditor&) = delete;
    LineEditor& operator=(const LineEditor&) = delete;

    /// A typed line, the end of the input, or Ctrl-C, which gives up the line.
    using Outcome = TypedLines::Outcome;
    struct Read {
        Outcome outcome = Outcome::end;
        std::string line = {};
    };

    /// Reads the next line: edited if it is typed and libedit is there. The prompt is shown on a
    /// terminal only.
    Read read(const char* prompt);
    /// Keeps a chunk for the arrow keys and for the next run.
    void remember(const std::string& chunk);

    bool interactive() const { return interactive_; }

  private:
    Read read_plainly(const char* prompt) const;

    LineEditorOptions options_;
    bool interactive_;
    History history_;
    /// Null for input that is not edited.
    std::unique_ptr<TypedLines> typed_;
};

/// Returns the file of the history: $LISSOM_HISTORY, which may be empty for none; else
/// lissom/history in $XDG_STATE_HOME, by default ~/.local/state; empty if there is no home.
std::filesystem::path history_file();

}  // namespace lissom::cli
