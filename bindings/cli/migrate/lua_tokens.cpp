#include "bindings/cli/migrate/lua_tokens.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <string>

namespace lissom::cli {
namespace {

bool is_word_letter(char c) {
    return c == '_' || std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

constexpr std::string_view kKeywords[] = {"and",   "break", "do",       "else", "elseif", "end",
                                          "false", "for",   "function", "goto", "if",     "in",
                                          "local", "nil",   "not",      "or",   "repeat", "return",
                                          "then",  "true",  "until",    "while"};

constexpr std::string_view kTwoSigns[] = {"==", "~=", "<=", ">=", "..", "//", "::", "<<", ">>"};

}  // namespace

LuaTokens::LuaTokens(std::string_view text, bool markdown) : text_(text) {
    line_starts_.push_back(0);
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\n') line_starts_.push_back(i + 1);
    }
    if (!markdown) {
        read(0, text.size());
    } else {
        constexpr std::string_view kOpen = "```lua\n";
        for (std::size_t at = text.find(kOpen); at != text.npos; at = text.find(kOpen, at + 1)) {
            const std::size_t end = std::min(text.find("\n```", at), text.size());
            read(at + kOpen.size(), end);
        }
    }
    find_matches();
}

std::string_view LuaTokens::text(std::size_t i) const {
    if (i >= tokens_.size()) return "";
    return text_.substr(tokens_[i].begin, tokens_[i].end - tokens_[i].begin);
}

bool LuaTokens::is_name(std::size_t i) const {
    return i < size() && tokens_[i].kind == TokenKind::name &&
           std::find(std::begin(kKeywords), std::end(kKeywords), text(i)) == std::end(kKeywords);
}

bool LuaTokens::is_string(std::size_t i) const {
    return i < size() && tokens_[i].kind == TokenKind::string;
}

int LuaTokens::line_of(std::size_t at) const {
    const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), at);
    return static_cast<int>(next - line_starts_.begin());
}

void LuaTokens::read(std::size_t begin, std::size_t end) {
    std::size_t at = begin;
    // The first line of a program may be for the shell.
    if (at == 0 && end > 0 && text_[0] == '#') at = std::min(text_.find('\n'), end);
    while (at < end) {
        if (std::isspace(static_cast<unsigned char>(text_[at])) != 0) {
            ++at;
        } else if (text_.substr(at, 2) == "--") {
            at = skip_comment(at, end);
        } else {
            at = read_token(at, end);
        }
    }
}

std::size_t LuaTokens::read_token(std::size_t at, std::size_t end) {
    const std::size_t begin = at;
    const char c = text_[at];
    if (is_word_letter(c)) {
        while (at < end && (is_word_letter(text_[at]) || is_digit(text_[at]))) ++at;
        add(TokenKind::name, begin, at);
        return at;
    }
    if (is_digit(c) || (c == '.' && at + 1 < end && is_digit(text_[at + 1]))) {
        const auto goes_on = [&](char d) { return is_word_letter(d) || is_digit(d) || d == '.'; };
        const auto is_exponent = [](char d) {
            return d == 'e' || d == 'E' || d == 'p' || d == 'P';
        };
        while (at < end && (goes_on(text_[at]) || ((text_[at] == '-' || text_[at] == '+') &&
                                                   is_exponent(text_[at - 1])))) {
            ++at;
        }
        add(TokenKind::number, begin, at);
        return at;
    }
    const std::size_t after = string_end(at, end);
    if (after > at) {
        add(TokenKind::string, begin, after);
        return after;
    }
    const bool two = std::find(std::begin(kTwoSigns), std::end(kTwoSigns), text_.substr(at, 2)) !=
                     std::end(kTwoSigns);
    at += text_.substr(at, 3) == "..." ? 3 : two ? 2 : 1;
    add(TokenKind::symbol, begin, std::min(at, end));
    return std::min(at, end);
}

std::size_t LuaTokens::skip_comment(std::size_t at, std::size_t end) const {
    const std::size_t after = long_end(at + 2, end);
    return after > at + 2 ? after : std::min(text_.find('\n', at), end);
}

// The end of the string that begins at `at`, or `at` if none does.
std::size_t LuaTokens::string_end(std::size_t at, std::size_t end) const {
    const char quote = text_[at];
    if (quote == '[') return long_end(at, end);
    if (quote != '"' && quote != '\'') return at;
    for (std::size_t i = at + 1; i < end; ++i) {
        if (text_[i] == '\\') {
            ++i;
        } else if (text_[i] == quote || text_[i] == '\n') {
            return i + 1;
        }
    }
    return end;
}

// The end of a long bracket such as [==[ ]==] that begins at `at`, or `at` if none does.
std::size_t LuaTokens::long_end(std::size_t at, std::size_t end) const {
    if (at >= end || text_[at] != '[') return at;
    std::size_t signs = 0;
    while (at + 1 + signs < end && text_[at + 1 + signs] == '=') ++signs;
    if (at + 1 + signs >= end || text_[at + 1 + signs] != '[') return at;
    const std::string close = "]" + std::string(signs, '=') + "]";
    const std::size_t found = text_.find(close, at);
    return found == std::string_view::npos ? end : std::min(found + close.size(), end);
}

void LuaTokens::add(TokenKind kind, std::size_t begin, std::size_t end) {
    tokens_.push_back({kind, begin, end, line_of(begin)});
}

void LuaTokens::find_matches() {
    match_.assign(size(), size());
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < size(); ++i) {
        if (tokens_[i].kind != TokenKind::symbol) continue;
        if (is(i, "(") || is(i, "{") || is(i, "[")) open.push_back(i);
        if (!(is(i, ")") || is(i, "}") || is(i, "]")) || open.empty()) continue;
        match_[i] = open.back();
        match_[open.back()] = i;
        open.pop_back();
    }
}

}  // namespace lissom::cli
