#include "bindings/cli/terminal/edited_line.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace lissom::cli {
namespace {

struct CodeRange {
    char32_t first, last;
};

constexpr CodeRange kCombining[] = {
    {0x300, 0x36f},   {0x483, 0x489},   {0x591, 0x5bd},   {0x610, 0x61a},   {0x64b, 0x65f},
    {0x200b, 0x200f}, {0x20d0, 0x20ff}, {0xfe00, 0xfe0f}, {0xfe20, 0xfe2f}, {0x1f3fb, 0x1f3ff}};
constexpr CodeRange kWide[] = {{0x1100, 0x115f},   {0x2e80, 0xa4cf},   {0xac00, 0xd7a3},
                               {0xf900, 0xfaff},   {0xfe30, 0xfe6f},   {0xff00, 0xff60},
                               {0xffe0, 0xffe6},   {0x1f300, 0x1f64f}, {0x1f680, 0x1f6ff},
                               {0x1f900, 0x1f9ff}, {0x20000, 0x3fffd}};

template <std::size_t N>
bool is_in(const CodeRange (&ranges)[N], char32_t code) {
    return std::any_of(std::begin(ranges), std::end(ranges),
                       [&](const CodeRange& r) { return r.first <= code && code <= r.last; });
}

bool continues(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

// Returns the bytes of the character that begins at `at`; 1 if they are no UTF-8.
std::size_t length_at(std::string_view text, std::size_t at) {
    const auto first = static_cast<unsigned char>(text[at]);
    const std::size_t length = first < 0xc2 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (first >= 0xf5 || at + length > text.size()) return 1;
    for (std::size_t i = 1; i < length; ++i) {
        if (!continues(text[at + i])) return 1;
    }
    return length;
}

char32_t code_at(std::string_view text, std::size_t at) {
    const std::size_t length = length_at(text, at);
    const auto first = static_cast<unsigned char>(text[at]);
    if (length == 1) return first;
    char32_t code = first & (0x7f >> length);
    for (std::size_t i = 1; i < length; ++i) {
        code = code << 6 | (static_cast<unsigned char>(text[at + i]) & 0x3f);
    }
    return code;
}

std::size_t width_at(std::string_view text, std::size_t at) {
    const char32_t code = code_at(text, at);
    if (is_in(kCombining, code)) return 0;
    return is_in(kWide, code) ? 2 : 1;
}

bool is_word_byte(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x80 || std::isalnum(byte) || c == '_';
}

}  // namespace

std::size_t cells_of(std::string_view text) {
    std::size_t cells = 0;
    for (std::size_t i = 0; i < text.size(); i += length_at(text, i)) cells += width_at(text, i);
    return cells;
}

std::size_t previous_character(std::string_view text, std::size_t at) {
    while (at > 0) {
        std::size_t begin = at - 1;
        while (begin > 0 && at - begin < 4 && continues(text[begin])) --begin;
        if (begin + length_at(text, begin) != at) begin = at - 1;
        at = begin;
        if (width_at(text, at) > 0) break;
    }
    return at;
}

std::size_t next_character(std::string_view text, std::size_t at) {
    if (at < text.size()) at += length_at(text, at);
    while (at < text.size() && width_at(text, at) == 0) at += length_at(text, at);
    return at;
}

void EditedLine::replace(std::string text) {
    text_ = std::move(text);
    cursor_ = text_.size();
}

void EditedLine::insert(std::string_view text) {
    text_.insert(cursor_, text);
    cursor_ += text.size();
}

void EditedLine::replace_before(std::size_t begin, std::string_view text) {
    text_.replace(begin, cursor_ - begin, text);
    cursor_ = begin + text.size();
}

void EditedLine::left() {
    cursor_ = previous_character(text_, cursor_);
}

void EditedLine::right() {
    cursor_ = next_character(text_, cursor_);
}

void EditedLine::erase_before() {
    replace_before(previous_character(text_, cursor_), "");
}

void EditedLine::erase_after() {
    text_.erase(cursor_, next_character(text_, cursor_) - cursor_);
}

void EditedLine::transpose() {
    if (cursor_ == text_.size()) left();
    const std::size_t begin = previous_character(text_, cursor_),
                      end = next_character(text_, cursor_);
    if (begin == cursor_) return;
    std::rotate(text_.begin() + static_cast<std::ptrdiff_t>(begin),
                text_.begin() + static_cast<std::ptrdiff_t>(cursor_),
                text_.begin() + static_cast<std::ptrdiff_t>(end));
    cursor_ = end;
}

std::size_t EditedLine::word_begin() const {
    std::size_t at = cursor_;
    while (at > 0 && !is_word_byte(text_[at - 1])) --at;
    while (at > 0 && is_word_byte(text_[at - 1])) --at;
    return at;
}

std::size_t EditedLine::word_end() const {
    std::size_t at = cursor_;
    while (at < text_.size() && !is_word_byte(text_[at])) ++at;
    while (at < text_.size() && is_word_byte(text_[at])) ++at;
    return at;
}

void EditedLine::cut(std::size_t begin, std::size_t end) {
    if (begin == end) return;
    cut_ = text_.substr(begin, end - begin);
    text_.erase(begin, end - begin);
    cursor_ = begin;
}

}  // namespace lissom::cli
