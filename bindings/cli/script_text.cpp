#include "bindings/cli/script_text.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

namespace lissom::cli {
namespace {

bool is_letter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// The end of the next `word` from `at` on that is no part of a longer one, or npos.
std::size_t after_word(std::string_view text, std::string_view word, std::size_t at) {
    while ((at = text.find(word, at)) != std::string_view::npos) {
        const std::size_t end = at + word.size();
        const bool is_whole =
            (at == 0 || !is_letter(text[at - 1])) && (end == text.size() || !is_letter(text[end]));
        if (is_whole) return end;
        at = end;
    }
    return at;
}

bool has_word(std::string_view text, std::string_view word) {
    return after_word(text, word, 0) != std::string_view::npos;
}

// require "lissom", with or without brackets, is followed by this.
bool names_lissom(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t("), text.size()));
    return text.starts_with("\"lissom\"") || text.starts_with("'lissom'");
}

bool requires_others(std::string_view text) {
    for (std::size_t at = 0; (at = after_word(text, "require", at)) != std::string_view::npos;) {
        if (!names_lissom(text.substr(at))) return true;
    }
    return has_word(text, "dofile") || has_word(text, "loadfile");
}

}  // namespace

ScriptTraits script_traits(std::string_view text) {
    return {has_word(text, "params") || requires_others(text), has_word(text, "arg")};
}

bool calls_test(std::string_view text) {
    return has_word(text, "test");
}

bool is_recording(std::string_view text) {
    while (text.starts_with("--") || text.starts_with("\n") || text.starts_with("\r\n")) {
        text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    }
    return text.starts_with("return (require(\"lissom\").replay{");
}

std::string_view without_mark(std::string_view text) {
    constexpr std::string_view kMark = "\xef\xbb\xbf";
    return text.substr(text.starts_with(kMark) ? kMark.size() : 0);
}

std::optional<std::string> script_text(const std::string& file) {
    const auto all_of = [](std::istream& stream) {
        const std::string text(std::istreambuf_iterator<char>(stream), {});
        return std::string(without_mark(text));
    };
    if (file == "-") return all_of(std::cin);
    // A pipe could be read only once.
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return std::nullopt;
    std::string text = all_of(stream);
    return stream.bad() ? std::nullopt : std::optional(std::move(text));
}

}  // namespace lissom::cli
