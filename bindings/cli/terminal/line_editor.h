/// Reads lines from a person, with editing and history where the build has readline, or from a
/// file.
#pragma once

#include <optional>
#include <string>

namespace lissom::cli {

class LineEditor {
  public:
    LineEditor();

    /// The next line; nothing at the end of the input. The prompt is shown on a terminal only.
    std::optional<std::string> read(const char* prompt);
    /// Keeps a line for the arrow keys.
    void remember(const std::string& line);

    bool interactive() const { return interactive_; }

  private:
    bool interactive_;
};

}  // namespace lissom::cli
