#include "bindings/lua/core/failure.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>

#include "kernel/io/stream/file_error.h"

namespace lissom::lua {
namespace {

void copy_text(char* target, std::size_t size, const char* text) {
    std::strncpy(target, text, size - 1);
    target[size - 1] = '\0';
}

bool counts_from_one_in_lua(ElementKind kind) {
    return kind == ElementKind::vertex || kind == ElementKind::edge || kind == ElementKind::face ||
           kind == ElementKind::corner || kind == ElementKind::component ||
           kind == ElementKind::strand;
}

bool is_digit_at(const std::string& text, std::size_t place) {
    return place < text.size() && std::isdigit(static_cast<unsigned char>(text[place])) != 0;
}

// Replaces whole occurrences of `from`, not "vertex 7" within "vertex 70".
bool replace_all(std::string& text, const std::string& from, const std::string& to) {
    bool found = false;
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;) {
        if (is_digit_at(text, at + from.size())) {
            at += from.size();
            continue;
        }
        text.replace(at, from.size(), to);
        at += to.size();
        found = true;
    }
    return found;
}

// Raises the number in every "vertex 7" that is one of the elements, in one pass.
std::string renumber_each(const std::string& text, const Elements& elements) {
    const std::string name = std::string(kind_name(elements.kind)) + " ";
    std::string result;
    std::size_t at = 0;
    for (std::size_t found; (found = text.find(name, at)) != std::string::npos;) {
        const std::size_t begin = found + name.size();
        std::size_t end = begin;
        while (is_digit_at(text, end)) ++end;
        result += text.substr(at, begin - at);
        at = end;
        if (begin == end) continue;
        const long long id = std::atoll(text.substr(begin, end - begin).c_str());
        const bool is_named = std::count(elements.ids.begin(), elements.ids.end(), id) > 0;
        result += std::to_string(is_named ? id + 1 : id);
    }
    return result + text.substr(at);
}

}  // namespace

void Failure::set(const Error& error) noexcept {
    code = error.code();
    kind = error.elements().kind;
    count = error.elements().count;
    id_count = std::min(error.elements().ids.size(), Elements::kMaximumIds);
    std::copy_n(error.elements().ids.begin(), id_count, ids);
    set_input(error);
    try {
        copy_text(message, sizeof message, lua_message(error).c_str());
    } catch (const std::exception&) {
        copy_text(message, sizeof message, error.what());
    }
}

void Failure::set_input(const Error& error) noexcept {
    const auto* known = dynamic_cast<const FileError*>(&error);
    const bool fits = known && known->file().size() < sizeof file;
    copy_text(file, sizeof file, fits ? known->file().c_str() : "");
    line = kind == ElementKind::line && id_count > 0 ? at(ids[0]) + 1 : 0;
}

void Failure::set(ErrorCode code_given, const char* text) noexcept {
    code = code_given;
    kind = ElementKind::none;
    count = id_count = line = 0;
    file[0] = '\0';
    copy_text(message, sizeof message, text);
}

std::string lua_message(const Error& error) {
    std::string text = error.message();
    const Elements& elements = error.elements();
    if (!counts_from_one_in_lua(elements.kind) || elements.ids.empty()) return text;
    if (replace_all(text, describe(elements), describe(elements, 1))) return text;
    return renumber_each(text, elements);
}

}  // namespace lissom::lua
