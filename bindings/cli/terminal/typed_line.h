/// Lines typed at a terminal and edited by libedit.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace lissom::cli {

struct LineEditorOptions;
class History;

/// Reads lines with the keys of Emacs, or those that ~/.editrc chooses; Tab completes, and Ctrl-R
/// searches the history.
class TypedLines {
  public:
    /// Returns nothing in builds without libedit, and if it is not installed. The options and the
    /// history must outlive the result.
    static std::unique_ptr<TypedLines> make(const LineEditorOptions& options,
                                            const History& history);

    virtual ~TypedLines() = default;

    enum class Outcome { line, end, interrupted };
    /// Reads a line into `line`. Ctrl-C gives it up.
    virtual Outcome read(const char* prompt, std::string& line) = 0;
    /// Adds a line to those that the arrow keys show.
    virtual void remember(const std::string& line) = 0;
};

}  // namespace lissom::cli
