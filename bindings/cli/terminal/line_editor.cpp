#include "bindings/cli/terminal/line_editor.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <utility>

#include "bindings/cli/terminal/terminal.h"

namespace lissom::cli {

namespace fs = std::filesystem;

LineEditor::LineEditor(LineEditorOptions options)
    : options_(std::move(options)),
      interactive_(input_is_terminal()),
      history_(interactive_ ? options_.history : fs::path()) {
    if (interactive_) typed_ = TypedLines::make(options_, history_);
}

LineEditor::~LineEditor() {
    history_.shorten_file();
}

LineEditor::Read LineEditor::read(const char* prompt) {
    if (!typed_) return read_plainly(prompt);
    Read result;
    result.outcome = typed_->read(prompt, result.line);
    return result;
}

void LineEditor::remember(const std::string& chunk) {
    if (!interactive_) return;
    // Joins the text into one line for the arrow keys; but a comment would swallow the rest.
    std::string text = chunk;
    if (chunk.find("--") == std::string::npos) std::replace(text.begin(), text.end(), '\n', ' ');
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (history_.add(line) && typed_) typed_->remember(line);
    }
}

LineEditor::Read LineEditor::read_plainly(const char* prompt) const {
    if (interactive_) std::cout << prompt << std::flush;
    std::string line;
    if (!std::getline(std::cin, line)) return {};
    return {Outcome::line, line};
}

fs::path history_file() {
    if (const char* given = std::getenv("LISSOM_HISTORY")) return given;
    const char* state = std::getenv("XDG_STATE_HOME");
    if (state && *state) return fs::path(state) / "lissom" / "history";
    const char* home = std::getenv("HOME");
    if (!home || !*home) return {};
    return fs::path(home) / ".local" / "state" / "lissom" / "history";
}

}  // namespace lissom::cli
