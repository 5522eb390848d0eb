#include "bindings/cli/terminal/line_editor.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "bindings/cli/terminal/terminal.h"

#ifdef LISSOM_HAS_READLINE
#include <readline/history.h>
#include <readline/readline.h>
#endif

namespace lissom::cli {

LineEditor::LineEditor() : interactive_(input_is_terminal()) {}

std::optional<std::string> LineEditor::read(const char* prompt) {
#ifdef LISSOM_HAS_READLINE
    if (interactive_) {
        char* typed = readline(prompt);
        if (!typed) return std::nullopt;
        std::string line(typed);
        std::free(typed);
        return line;
    }
#endif
    if (interactive_) std::cout << prompt << std::flush;
    std::string line;
    if (!std::getline(std::cin, line)) return std::nullopt;
    return line;
}

void LineEditor::remember([[maybe_unused]] const std::string& line) {
#ifdef LISSOM_HAS_READLINE
    if (interactive_ && !line.empty()) add_history(line.c_str());
#endif
}

}  // namespace lissom::cli
