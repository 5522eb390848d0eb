#include "bindings/cli/terminal/line_editor.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include "bindings/cli/terminal/edited_line.h"
#include "bindings/cli/terminal/keys.h"
#include "bindings/cli/terminal/terminal.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostListed = 200;

std::string common_beginning(const std::vector<std::string>& words) {
    std::string common = words.front();
    for (const std::string& word : words) {
        const auto end = std::mismatch(common.begin(), common.end(), word.begin(), word.end());
        common.erase(end.first, common.end());
    }
    return common;
}

// Returns names of files that begin with the text after the last quotation mark; those of folders
// end with '/'.
Completions file_names(std::string_view line) {
    Completions found;
    const std::size_t quote = line.find_last_of("'\"");
    if (quote == std::string_view::npos) return found;
    const std::size_t slash = line.find_last_of('/');
    found.begin = slash != std::string_view::npos && slash > quote ? slash + 1 : quote + 1;
    const std::string folder(line.substr(quote + 1, found.begin - quote - 1));
    const std::string_view typed = line.substr(found.begin);
    std::error_code error;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end;
         !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.compare(0, typed.size(), typed) != 0) continue;
        if (name[0] == '.' && typed.empty()) continue;
        std::error_code unknown;
        found.words.push_back(name + (entry->is_directory(unknown) ? "/" : ""));
    }
    std::sort(found.words.begin(), found.words.end());
    return found;
}

// Words below each other in as many columns as fit.
std::string in_columns(const std::vector<std::string>& words, std::size_t width) {
    std::size_t widest = 0;
    for (const std::string& word : words) widest = std::max(widest, cells_of(word) + 2);
    const std::size_t columns = std::max<std::size_t>(1, width / widest);
    const std::size_t rows = (words.size() + columns - 1) / columns;
    std::string text;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t i = row; i < words.size(); i += rows) {
            const bool last = i + rows >= words.size();
            text += words[i] + std::string(last ? 0 : widest - cells_of(words[i]), ' ');
        }
        text += '\n';
    }
    return text;
}

// The line on the terminal. It is written with nothing but '\r', blanks and '\b', which all
// terminals know; a long line is shown only near the cursor.
class LineView {
  public:
    void show(std::string_view prompt, const EditedLine& line) {
        const std::size_t width = terminal_columns();
        const std::size_t taken = std::min(cells_of(prompt) + 1, width - 1), room = width - taken;
        begin_ = std::min(begin_, line.cursor());
        const std::string_view text = line.text();
        while (cells_of(text.substr(begin_, line.cursor() - begin_)) > room) {
            begin_ = next_character(text, begin_);
        }
        std::size_t end = begin_;
        for (std::size_t next; end < text.size(); end = next) {
            next = next_character(text, end);
            if (cells_of(text.substr(begin_, next - begin_)) > room) break;
        }
        draw(std::string(prompt) + std::string(text.substr(begin_, end - begin_)),
             cells_of(text.substr(line.cursor(), end - line.cursor())));
    }

    // The cursor has left the shown part.
    void forget() {
        shown_.clear();
        cells_behind_ = 0;
        begin_ = 0;
    }

  private:
    void draw(const std::string& text, std::size_t cells_behind) {
        const bool goes_on = cells_behind_ == 0 && cells_behind == 0 && !shown_.empty() &&
                             text.compare(0, shown_.size(), shown_) == 0;
        if (goes_on) {
            std::cout << text.substr(shown_.size());
        } else {
            const std::size_t cells = cells_of(text), old = cells_of(shown_);
            const std::size_t blanks = old > cells ? old - cells : 0;
            std::cout << (shown_.empty() ? "" : "\r") << text << std::string(blanks, ' ')
                      << std::string(blanks + cells_behind, '\b');
        }
        std::cout << std::flush;
        shown_ = text;
        cells_behind_ = cells_behind;
    }

    std::string shown_;
    std::size_t cells_behind_ = 0, begin_ = 0;
};

// The typing of one line.
class Typing {
  public:
    Typing(std::string prompt, const LineEditorOptions& options, const History& history)
        : prompt_(std::move(prompt)), options_(options), history_(history), at_(history.size()) {}

    LineEditor::Read run() {
        const RawTerminal raw;
        while (!outcome_) {
            view_.show(prompt_, line_);
            if (const std::optional<KeyPress> press = next_key()) handle(*press);
        }
        if (*outcome_ == LineEditor::Outcome::end) return {};
        const bool given_up = *outcome_ == LineEditor::Outcome::interrupted;
        std::cout << (given_up ? "^C\n" : "\n") << std::flush;
        return {*outcome_, given_up ? std::string() : line_.text()};
    }

  private:
    // Returns nothing if the typing has ended.
    std::optional<KeyPress> next_key() {
        constexpr int kMilliseconds = 100;
        for (;;) {
            const TypedByte typed = read_terminal(kMilliseconds);
            if (options_.interrupted && options_.interrupted()) {
                return end(LineEditor::Outcome::interrupted);
            }
            if (typed.ended) return end(LineEditor::Outcome::end);
            if (!typed.byte) continue;
            return read_key(*typed.byte, [] { return read_terminal(kMilliseconds).byte; });
        }
    }

    std::nullopt_t end(LineEditor::Outcome outcome) {
        outcome_ = outcome;
        return std::nullopt;
    }

    void handle(const KeyPress& press) {
        switch (press.key) {
            case Key::text:
                return line_.insert(press.text);
            case Key::enter:
                line_.to_end();
                view_.show(prompt_, line_);
                end(LineEditor::Outcome::line);
                return;
            case Key::end_of_input:
                if (line_.text().empty()) return void(end(LineEditor::Outcome::end));
                return line_.erase_after();
            case Key::complete:
                return complete();
            case Key::older:
                return go_to(at_ - 1);
            case Key::newer:
                return go_to(at_ + 1);
            case Key::search:
                return search();
            case Key::clear_screen:
                return clear_screen();
            default:
                edit(press.key);
        }
    }

    void edit(Key key) {
        switch (key) {
            case Key::left:
                return line_.left();
            case Key::right:
                return line_.right();
            case Key::word_left:
                return line_.word_left();
            case Key::word_right:
                return line_.word_right();
            case Key::begin:
                return line_.to_begin();
            case Key::end:
                return line_.to_end();
            case Key::erase_before:
                return line_.erase_before();
            case Key::erase_after:
                return line_.erase_after();
            case Key::cut_to_begin:
                return line_.cut_to_begin();
            case Key::cut_to_end:
                return line_.cut_to_end();
            case Key::cut_word_before:
                return line_.cut_word_before();
            case Key::cut_word_after:
                return line_.cut_word_after();
            case Key::paste:
                return line_.paste();
            case Key::transpose:
                return line_.transpose();
            default:
                return;
        }
    }

    // Shows line `next` of the history; after its last, the typed line.
    void go_to(std::size_t next) {
        if (next > history_.size()) return ring();
        if (at_ == history_.size()) typed_ = line_.text();
        at_ = next;
        line_.replace(at_ == history_.size() ? typed_ : history_.line(at_));
    }

    // Finds the last line that contains the typed text; Ctrl-R goes to the one before, Ctrl-G gives
    // up, and any other key takes the line.
    void search() {
        const std::string before = line_.text();
        const std::size_t at_before = at_;
        std::string wanted;
        std::size_t from = history_.size();
        for (;;) {
            view_.show("(search: " + wanted + ") ", line_);
            const std::optional<KeyPress> press = next_key();
            if (!press) return;
            if (press->key == Key::leave) {
                at_ = at_before;
                return line_.replace(before);
            }
            if (press->key == Key::text) {
                wanted += press->text;
                from = history_.size();
            } else if (press->key == Key::erase_before) {
                wanted.erase(previous_character(wanted, wanted.size()));
                from = history_.size();
            } else if (press->key != Key::search) {
                return handle(*press);
            }
            const std::optional<std::size_t> found = history_.find(wanted, from);
            if (!found) {
                ring();
                continue;
            }
            from = at_ = *found;
            line_.replace(history_.line(at_));
        }
    }

    Completions offered() const {
        if (!options_.complete) return {};
        try {
            const Completions found = options_.complete(std::string(line_.before()));
            return found.in_string ? file_names(line_.before()) : found;
        } catch (const std::exception&) {
            return {};
        }
    }

    void complete() {
        const Completions found = offered();
        if (found.words.empty() || found.begin > line_.cursor()) return ring();
        const std::string common = common_beginning(found.words);
        if (common.size() > line_.cursor() - found.begin) {
            line_.replace_before(found.begin, common);
        } else if (found.words.size() > 1) {
            list(found.words);
        }
    }

    void list(std::vector<std::string> words) {
        const std::size_t count = words.size();
        if (count > kMostListed) words.resize(kMostListed);
        std::cout << "\n" << in_columns(words, terminal_columns());
        if (count > kMostListed) std::cout << "... and " << count - kMostListed << " more\n";
        view_.forget();
    }

    void clear_screen() {
        if (!terminal_moves_cursor()) return ring();
        std::cout << "\x1b[H\x1b[2J";
        view_.forget();
    }

    static void ring() { std::cout << '\a' << std::flush; }

    std::string prompt_;
    const LineEditorOptions& options_;
    const History& history_;
    // The line of the history that is shown; beyond the last, the one that is typed.
    std::size_t at_;
    std::string typed_;
    EditedLine line_;
    LineView view_;
    std::optional<LineEditor::Outcome> outcome_;
};

}  // namespace

LineEditor::LineEditor(LineEditorOptions options)
    : options_(std::move(options)),
      interactive_(input_is_terminal()),
      history_(interactive_ ? options_.history : fs::path()) {}

LineEditor::~LineEditor() {
    history_.shorten_file();
}

LineEditor::Read LineEditor::read(const char* prompt) {
    if (interactive_ && terminal_sends_keys()) return Typing(prompt, options_, history_).run();
    return read_plainly(prompt);
}

void LineEditor::remember(const std::string& chunk) {
    if (!interactive_) return;
    // Joins the text into one line for the arrow keys; but a comment would swallow the rest.
    std::string text = chunk;
    if (chunk.find("--") == std::string::npos) std::replace(text.begin(), text.end(), '\n', ' ');
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) history_.add(line);
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
