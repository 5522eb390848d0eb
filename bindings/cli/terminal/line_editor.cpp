#include "bindings/cli/terminal/line_editor.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <utility>

#include "bindings/cli/terminal/terminal.h"

#ifdef LISSOM_HAS_READLINE
#include <poll.h>
#include <readline/history.h>
#include <readline/readline.h>
#endif

namespace lissom::cli {

namespace fs = std::filesystem;

#ifdef LISSOM_HAS_READLINE
namespace {

constexpr int kMostLines = 1000;

// readline calls functions without arguments, so what they need is the process's.
const LineEditorOptions* typing_options = nullptr;
std::optional<LineEditor::Read> typed_line;
std::vector<std::string> offered_words;

char* copied(const std::string& text) {
    char* copy = static_cast<char*>(std::malloc(text.size() + 1));
    if (copy) std::memcpy(copy, text.c_str(), text.size() + 1);
    return copy;
}

char* next_word(const char*, int state) {
    static std::size_t next = 0;
    if (state == 0) next = 0;
    return next < offered_words.size() ? copied(offered_words[next++]) : nullptr;
}

char** complete_word(const char* text, int, int end) {
    if (!typing_options || !typing_options->complete) return nullptr;
    try {
        const std::string line(rl_line_buffer, end);
        Completions found = typing_options->complete(line);
        if (found.in_string) return nullptr;
        rl_attempted_completion_over = 1;
        rl_completion_append_character = '\0';
        offered_words = std::move(found.words);
        return offered_words.empty() ? nullptr : rl_completion_matches(text, next_word);
    } catch (const std::exception&) {
        return nullptr;
    }
}

void take_line(char* line) {
    rl_callback_handler_remove();
    typed_line.emplace();
    if (!line) return;
    typed_line->outcome = LineEditor::Outcome::line;
    typed_line->line = line;
    std::free(line);
}

void give_up_line() {
    rl_free_line_state();
    rl_callback_sigcleanup();
    rl_replace_line("", 0);
    rl_callback_handler_remove();
    std::cout << "^C\n" << std::flush;
}

// The handler of Ctrl-C is the program's: it leaves a mark, which is looked for here.
LineEditor::Read read_edited(const char* prompt, const LineEditorOptions& options) {
    constexpr int kMilliseconds = 100;
    typing_options = &options;
    typed_line.reset();
    rl_callback_handler_install(prompt, take_line);
    while (!typed_line) {
        pollfd input{fileno(stdin), POLLIN, 0};
        const int ready = poll(&input, 1, kMilliseconds);
        if (options.interrupted && options.interrupted()) {
            give_up_line();
            return {LineEditor::Outcome::interrupted};
        }
        if (ready > 0) rl_callback_read_char();
    }
    return std::exchange(typed_line, std::nullopt).value_or(LineEditor::Read{});
}

void open_history(const fs::path& file) {
    using_history();
    if (file.empty()) return;
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    read_history(file.c_str());
    stifle_history(kMostLines);
}

}  // namespace

LineEditor::LineEditor(LineEditorOptions options)
    : options_(std::move(options)), interactive_(input_is_terminal()) {
    if (!interactive_) return;
    static char word_breaks[] = " \t\n\"'`@$><=;|&{}()[].:,#+-*/%^~";
    rl_readline_name = "lissom";
    rl_catch_signals = 0;
    rl_basic_word_break_characters = word_breaks;
    rl_completer_word_break_characters = word_breaks;
    rl_attempted_completion_function = complete_word;
    open_history(options_.history);
}

LineEditor::~LineEditor() {
    typing_options = nullptr;
    if (interactive_ && !options_.history.empty()) {
        history_truncate_file(options_.history.c_str(), kMostLines);
    }
}

LineEditor::Read LineEditor::read(const char* prompt) {
    return interactive_ ? read_edited(prompt, options_) : read_plainly(prompt);
}

void LineEditor::remember(const std::string& chunk) {
    if (!interactive_ || chunk.empty()) return;
    // One line, as the arrow keys bring it back; a comment would swallow what follows it.
    std::string line = chunk;
    const bool joins = chunk.find("--") == std::string::npos;
    for (char& c : line) c = joins && c == '\n' ? ' ' : c;
    const HIST_ENTRY* last =
        history_length > 0 ? history_get(history_base + history_length - 1) : nullptr;
    if (last && line == last->line) return;
    add_history(line.c_str());
    if (options_.history.empty()) return;
    if (append_history(1, options_.history.c_str()) != 0) write_history(options_.history.c_str());
}

#else

LineEditor::LineEditor(LineEditorOptions options)
    : options_(std::move(options)), interactive_(input_is_terminal()) {}

LineEditor::~LineEditor() = default;

LineEditor::Read LineEditor::read(const char* prompt) {
    return read_plainly(prompt);
}

void LineEditor::remember(const std::string&) {}

#endif

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
