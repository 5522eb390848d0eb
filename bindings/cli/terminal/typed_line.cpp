#include "bindings/cli/terminal/typed_line.h"

#ifdef LISSOM_HAS_LIBEDIT

#include <algorithm>
#include <cerrno>
#include <clocale>
#include <cstdio>
#include <cwchar>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string_view>
#include <system_error>
#include <vector>

#include "bindings/cli/terminal/history.h"
#include "bindings/cli/terminal/libedit.h"
#include "bindings/cli/terminal/line_editor.h"
#include "bindings/cli/terminal/terminal.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxListed = 200;
constexpr int kMilliseconds = 100;

// Words below each other in as many columns as fit.
std::string in_columns(const std::vector<std::string>& words, std::size_t width) {
    std::size_t widest = 0;
    for (const std::string& word : words) widest = std::max(widest, word.size() + 2);
    const std::size_t columns = std::max<std::size_t>(1, width / widest);
    const std::size_t rows = (words.size() + columns - 1) / columns;
    std::string text;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t i = row; i < words.size(); i += rows) {
            const bool last = i + rows >= words.size();
            text += words[i] + std::string(last ? 0 : widest - words[i].size(), ' ');
        }
        text += '\n';
    }
    return text;
}

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

// Characters are those of UTF-8 while it lives: the program itself reads bytes.
class Utf8 {
  public:
    Utf8() : before_(std::setlocale(LC_CTYPE, nullptr)) { std::setlocale(LC_CTYPE, "C.UTF-8"); }
    ~Utf8() { std::setlocale(LC_CTYPE, before_.c_str()); }
    Utf8(const Utf8&) = delete;
    Utf8& operator=(const Utf8&) = delete;

  private:
    std::string before_;
};

class EditedLines final : public TypedLines {
  public:
    EditedLines(const Libedit& lib, const LineEditorOptions& options, const History& history)
        : lib_(lib), options_(options) {
        const Utf8 characters;
        editor_ = lib_.init("lissom", stdin, stdout, stderr);
        history_ = lib_.history_init();
        HistEvent event;
        lib_.history(history_, &event, H_SETSIZE, static_cast<int>(History::kMaxLines));
        for (std::size_t i = 0; i < history.size(); ++i) remember(history.line(i));
        lib_.set(editor_, EL_CLIENTDATA, this);
        lib_.set(editor_, EL_PROMPT, shown_prompt);
        lib_.set(editor_, EL_SIGNAL, 0);
        lib_.set(editor_, EL_HIST, lib_.history, history_);
        lib_.set(editor_, EL_GETCFN, next_character);
        // el_set copies both names and never frees them.
        lib_.wide_set(editor_, EL_ADDFN, L"lissom-complete", L"Completes the word", complete_word);
        lib_.set(editor_, EL_EDITOR, "emacs");
        bind_keys();
        lib_.source(editor_, nullptr);
    }
    ~EditedLines() override {
        lib_.history_end(history_);
        lib_.end(editor_);
    }
    EditedLines(const EditedLines&) = delete;
    EditedLines& operator=(const EditedLines&) = delete;

    Outcome read(const char* prompt, std::string& line) override {
        const Utf8 characters;
        prompt_ = prompt;
        interrupted_ = false;
        std::cout << std::flush;
        // Keys that are pressed from the prompt on are edited.
        lib_.set(editor_, EL_PREP_TERM, 1);
        int count = 0;
        const char* const text = lib_.gets(editor_, &count);
        if (interrupted_) {
            std::cout << "^C\n" << std::flush;
            return Outcome::interrupted;
        }
        if (!text || count <= 0) return Outcome::end;
        line.assign(text, static_cast<std::size_t>(count));
        if (line.ends_with('\n')) line.pop_back();
        return Outcome::line;
    }

    void remember(const std::string& line) override {
        const Utf8 characters;
        HistEvent event;
        lib_.history(history_, &event, H_ENTER, line.c_str());
    }

  private:
    static EditedLines& of(EditLine* editor) {
        void* lines = nullptr;
        libedit()->get(editor, EL_CLIENTDATA, &lines);
        return *static_cast<EditedLines*>(lines);
    }

    static char* shown_prompt(EditLine* editor) { return of(editor).prompt_.data(); }

    static int next_character(EditLine* editor, wchar_t* character) {
        return of(editor).next(*character);
    }

    static unsigned char complete_word(EditLine* editor, int) { return of(editor).complete(); }

    // Beside the keys that libedit knows of the terminal.
    void bind_keys() {
        static constexpr const char* kKeys[][2] = {
            {"^I", "lissom-complete"},     {"^R", "em-inc-search-prev"},
            {"^W", "ed-delete-prev-word"}, {"\\e[1;5C", "em-next-word"},
            {"\\e[1;5D", "ed-prev-word"},  {"\\e[3~", "ed-delete-next-char"},
            {"\\e[1~", "ed-move-to-beg"},  {"\\e[4~", "ed-move-to-end"},
            {"\\e[H", "ed-move-to-beg"},   {"\\e[F", "ed-move-to-end"},
            {"\\eOH", "ed-move-to-beg"},   {"\\eOF", "ed-move-to-end"},
            {"\\e[A", "ed-prev-history"},  {"\\e[B", "ed-next-history"},
            {"\\e[C", "ed-next-char"},     {"\\e[D", "ed-prev-char"},
            {"\\eOA", "ed-prev-history"},  {"\\eOB", "ed-next-history"},
        };
        for (const auto& [key, command] : kKeys) {
            lib_.set(editor_, EL_BIND, key, command, nullptr);
        }
    }

    // Waits for a character, and asks meanwhile whether Ctrl-C was pressed. Bytes that are no
    // characters are left out.
    int next(wchar_t& character) {
        std::mbstate_t state{};
        for (;;) {
            const TypedByte typed = read_terminal(kMilliseconds);
            if (options_.interrupted && options_.interrupted()) {
                interrupted_ = true;
                errno = EINTR;
                return -1;
            }
            if (typed.ended) return 0;
            if (!typed.byte) continue;
            const std::size_t length = std::mbrtowc(&character, &*typed.byte, 1, &state);
            if (length <= 1) return 1;
            if (length == static_cast<std::size_t>(-1)) state = {};
        }
    }

    Completions offered(const std::string& before) const {
        if (!options_.complete) return {};
        try {
            const Completions found = options_.complete(before);
            return found.in_string ? file_names(before) : found;
        } catch (const std::exception&) {
            return {};
        }
    }

    unsigned char complete() {
        const LineInfo* const line = lib_.line(editor_);
        const std::string before(line->buffer, line->cursor);
        const Completions found = offered(before);
        if (found.words.empty() || found.begin > before.size()) return CC_ERROR;
        const std::string typed = before.substr(found.begin),
                          common = common_beginning(found.words);
        if (common.size() > typed.size() && common.starts_with(typed)) {
            lib_.insert(editor_, common.c_str() + typed.size());
            return CC_REFRESH;
        }
        if (found.words.size() < 2) return CC_ERROR;
        list(found.words);
        return CC_REDISPLAY;
    }

    static void list(std::vector<std::string> words) {
        const std::size_t count = words.size();
        if (count > kMaxListed) words.resize(kMaxListed);
        std::cout << "\n" << in_columns(words, terminal_columns());
        if (count > kMaxListed) std::cout << "... and " << count - kMaxListed << " more\n";
        std::cout << std::flush;
    }

    const Libedit& lib_;
    const LineEditorOptions& options_;
    EditLine* editor_ = nullptr;
    ::History* history_ = nullptr;
    std::string prompt_;
    bool interrupted_ = false;
};

}  // namespace

std::unique_ptr<TypedLines> TypedLines::make(const LineEditorOptions& options,
                                             const History& history) {
    const Libedit* const lib = libedit();
    return lib ? std::make_unique<EditedLines>(*lib, options, history) : nullptr;
}

}  // namespace lissom::cli

#else

namespace lissom::cli {

std::unique_ptr<TypedLines> TypedLines::make(const LineEditorOptions&, const History&) {
    return nullptr;
}

}  // namespace lissom::cli

#endif
