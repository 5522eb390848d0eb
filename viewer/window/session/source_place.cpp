#include "viewer/window/session/source_place.h"

#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <sstream>

extern "C" char** environ;

namespace lissom::window {
namespace {

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// Whether the name of a file may begin after `c`.
bool ends_word(char c) {
    return std::strchr(" \t\n\"'`([<", c) != nullptr;
}

// Returns the number at the beginning of `text`; 0 if there is none.
int number_at(std::string_view text) {
    constexpr std::size_t kMaxDigits = 8;
    int number = 0;
    for (const char c : text.substr(0, kMaxDigits)) {
        if (!is_digit(c)) break;
        number = 10 * number + (c - '0');
    }
    return number;
}

// The longest end of `text` that is the name of a file.
std::string file_at_end(std::string_view text,
                        const std::function<bool(const std::string&)>& exists) {
    for (std::size_t begin = 0; begin < text.size(); ++begin) {
        if (begin > 0 && !ends_word(text[begin - 1])) continue;
        std::string name(text.substr(begin));
        if (exists(name)) return name;
    }
    return {};
}

// How editors are told the line.
enum class LineForm { plus, colon, goto_colon, option };

LineForm form_of(const std::string& program) {
    constexpr std::array kColon{"subl", "sublime_text", "zed", "hx", "helix", "micro"};
    constexpr std::array kGoto{"code", "codium", "code-insiders", "cursor"};
    const std::string name = std::filesystem::path(program).filename().string();
    const auto is_in = [&](const auto& names) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (is_in(kColon)) return LineForm::colon;
    if (is_in(kGoto)) return LineForm::goto_colon;
    return name == "kate" ? LineForm::option : LineForm::plus;
}

}  // namespace

std::optional<SourcePlace> find_place(std::string_view text,
                                      const std::function<bool(const std::string&)>& exists) {
    for (std::size_t at = text.find(':'); at != std::string_view::npos;
         at = text.find(':', at + 1)) {
        const int line = number_at(text.substr(at + 1));
        if (line == 0) continue;
        std::string file = file_at_end(text.substr(0, at), exists);
        if (!file.empty()) return SourcePlace{std::move(file), line};
    }
    return std::nullopt;
}

std::vector<std::string> editor_command(std::string_view editor, const SourcePlace& place) {
    std::istringstream words{std::string(editor)};
    std::vector<std::string> command;
    for (std::string word; words >> word;) command.push_back(word);
    if (command.empty()) return {};
    // A name that begins with a dash or a plus would be an option.
    const bool is_plain = place.file[0] != '-' && place.file[0] != '+';
    const std::string file = (is_plain ? "" : "./") + place.file;
    const std::string line = std::to_string(place.line);
    switch (form_of(command.front())) {
        case LineForm::plus:
            command.insert(command.end(), {"+" + line, file});
            break;
        case LineForm::colon:
            command.push_back(file + ":" + line);
            break;
        case LineForm::goto_colon:
            command.insert(command.end(), {"-g", file + ":" + line});
            break;
        case LineForm::option:
            command.insert(command.end(), {"-l", line, file});
            break;
    }
    return command;
}

std::string open_in_editor(const SourcePlace& place, const EditorHost& host) {
    for (const char* name : {"VISUAL", "EDITOR"}) {
        const char* editor = host.variable(name);
        const auto command = editor_command(editor ? editor : "", place);
        if (command.empty()) continue;
        const std::string wrong = host.start(command);
        return wrong.empty() ? "" : "the editor of $" + std::string(name) + ": " + wrong;
    }
    return "no editor is set: put one into the variable VISUAL or EDITOR, for instance "
           "VISUAL=gedit lissom view ...";
}

std::string StartedPrograms::start(const std::vector<std::string>& words) {
    std::vector<std::string> copies = words;
    std::vector<char*> arguments;
    for (std::string& word : copies) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t id = 0;
    const int error = posix_spawnp(&id, arguments[0], nullptr, nullptr, arguments.data(), environ);
    if (error != 0) return "'" + words.front() + "' does not start: " + std::strerror(error);
    started_.push_back({id, words.front()});
    return {};
}

std::vector<std::string> StartedPrograms::failures() {
    std::vector<std::string> result;
    std::erase_if(started_, [&](const Started& program) {
        int status = 0;
        if (waitpid(program.id, &status, WNOHANG) != program.id) return false;
        const bool fails = !WIFEXITED(status) || WEXITSTATUS(status) != 0;
        if (fails) result.push_back("'" + program.name + "' ended with an error");
        return true;
    });
    return result;
}

}  // namespace lissom::window
