#include "kernel/io/usda/text.h"
#include "kernel/io/stream/percent.h"

#include <cmath>
#include <limits>
#include <system_error>

#include "kernel/core/numbers/number_text.h"

namespace lissom {
namespace {

constexpr std::size_t kDeepest = 64;

bool is_word_character(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == ':' || c == '.' || static_cast<unsigned char>(c) >= 0x80;
}

bool starts_number(char c) {
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
}

char closing(std::string_view open) {
    if (open == "(") return ')';
    if (open == "[") return ']';
    return open == "{" ? '}' : '\0';
}

bool closes(std::string_view token) {
    return token == ")" || token == "]" || token == "}";
}

// The character that stands behind a backslash at `at`, which moves over it.
char escaped_character(std::string_view text, std::size_t& at) {
    const char c = text[at++];
    if (c == 'n') return '\n';
    if (c == 'r') return '\r';
    if (c == 't') return '\t';
    if (c != 'x' || at + 1 >= text.size()) return c;
    const int high = hex_digit(text[at]), low = hex_digit(text[at + 1]);
    if (high < 0 || low < 0) return c;
    at += 2;
    return static_cast<char>(16 * high + low);
}

std::string without_escapes(std::string_view text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at++];
        result += c == '\\' && at < text.size() ? escaped_character(text, at) : c;
    }
    return result;
}

double number_of(const UsdaText::Token& token) {
    std::string_view text = token.value;
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0.0;
    const auto [stop, error] = read_number(text.data(), text.data() + text.size(), value);
    const bool whole = stop == text.data() + text.size();
    // A number out of range is near zero or beyond any length.
    if (whole && error == std::errc::result_out_of_range) {
        return text.find("e-") != text.npos || text.find("E-") != text.npos
                   ? 0.0
                   : std::numeric_limits<double>::infinity();
    }
    if (error != std::errc() || !whole) {
        refuse(ErrorCode::file_syntax, "expected a number, found " + in_quotes(token.value),
               {ElementKind::line, token.line});
    }
    return value;
}

}  // namespace

UsdaText::UsdaText(std::string_view text)
    : begin_(text.data()), at_(begin_), end_(begin_ + text.size()) {
    advance();
}

double UsdaText::fraction() const {
    return begin_ == end_ ? 1.0 : double(at_ - begin_) / double(end_ - begin_);
}

void UsdaText::skip_line_rest() {
    while (at_ != end_ && *at_ != '\n') ++at_;
}

void UsdaText::skip_block_comment() {
    const std::string_view rest(at_, at(end_ - at_));
    const std::size_t stop = rest.find("*/", 2);
    if (stop == std::string_view::npos) {
        refuse(ErrorCode::file_truncated, "a comment does not end; export the file again",
               {ElementKind::line, line_});
    }
    for (const char c : rest.substr(0, stop)) line_ += c == '\n' ? 1 : 0;
    at_ += stop + 2;
}

// True if there was one at this place.
bool UsdaText::skip_comment() {
    const std::string_view rest(at_, at(end_ - at_));
    if (rest.starts_with("#") || rest.starts_with("//")) {
        skip_line_rest();
        return true;
    }
    if (!rest.starts_with("/*")) return false;
    skip_block_comment();
    return true;
}

void UsdaText::skip_blanks() {
    while (at_ != end_) {
        if (skip_comment()) continue;
        if (*at_ == '\n') {
            ++line_;
        } else if (*at_ != ' ' && *at_ != '\t' && *at_ != '\r') {
            return;
        }
        ++at_;
    }
}

// A text in quotes, which may be triple.
void UsdaText::read_text() {
    const std::string_view rest(at_, end_ - at_);
    const std::string triple(3, *at_);
    const std::string_view quotes =
        rest.starts_with(triple) ? std::string_view(triple) : std::string_view(triple).substr(0, 1);
    std::size_t stop = quotes.size();
    while (stop < rest.size() && !rest.substr(stop).starts_with(quotes)) {
        stop += rest[stop] == '\\' ? 2 : 1;
    }
    if (stop >= rest.size()) {
        refuse(ErrorCode::file_truncated, "a text in quotes does not end; export the file again",
               {ElementKind::line, line_});
    }
    next_.kind = Kind::text;
    next_.value = rest.substr(quotes.size(), stop - quotes.size());
    for (const char c : next_.value) line_ += c == '\n' ? 1 : 0;
    at_ += stop + quotes.size();
}

// An asset between three at signs may have others in it: @@@name@@@.
void UsdaText::read_asset() {
    const std::string_view rest(at_, at(end_ - at_));
    const std::size_t stop = rest.starts_with("@@@") ? rest.find("@@@", 3) : rest.npos;
    if (stop == rest.npos || rest.substr(0, stop).find('\n') != rest.npos) {
        return read_delimited('@');
    }
    next_.kind = Kind::word;
    next_.value = rest.substr(0, stop + 3);
    at_ += stop + 3;
}

// An asset (@name@) or a path (</name>).
void UsdaText::read_delimited(char end) {
    const char* const start = at_++;
    while (at_ != end_ && *at_ != end && *at_ != '\n') ++at_;
    if (at_ != end_ && *at_ == end) ++at_;
    next_.kind = Kind::word;
    next_.value = {start, at(at_ - start)};
}

void UsdaText::advance() {
    skip_blanks();
    next_ = {Kind::end, {}, line_};
    if (at_ == end_) return;
    const char* const start = at_;
    if (*at_ == '"' || *at_ == '\'') return read_text();
    if (*at_ == '@') return read_asset();
    if (*at_ == '<') return read_delimited('>');
    if (starts_number(*at_) || is_word_character(*at_)) {
        next_.kind = starts_number(*at_) ? Kind::number : Kind::word;
        for (++at_; at_ != end_; ++at_) {
            const bool sign = next_.kind == Kind::number && (*at_ == '-' || *at_ == '+');
            if (!is_word_character(*at_) && !sign) break;
        }
    } else {
        next_.kind = Kind::punctuation;
        ++at_;
    }
    next_.value = {start, at(at_ - start)};
}

UsdaText::Token UsdaText::take() {
    const Token token = next_;
    if (token.kind == Kind::end) {
        refuse(ErrorCode::file_truncated, "the file ends within a prim; copy or export it again",
               place());
    }
    advance();
    return token;
}

bool UsdaText::take(std::string_view word) {
    if (!next_.is(word) || next_.kind == Kind::end) return false;
    advance();
    return true;
}

void UsdaText::expect(std::string_view word) {
    if (!take(word)) refuse_token(std::string("'") + std::string(word) + "'");
}

void UsdaText::refuse_token(std::string_view expected) const {
    if (next_.kind == Kind::end) {
        refuse(ErrorCode::file_truncated,
               "the file ends where " + std::string(expected) +
                   " should stand; copy or export it again",
               place());
    }
    refuse(ErrorCode::file_syntax,
           "expected " + std::string(expected) + ", found " + in_quotes(next_.value), place());
}

// Calls visit(token) for all tokens of a value but brackets and commas.
template <typename Visit>
void UsdaText::visit_value(const Visit& visit) {
    std::string open;
    do {
        const Token token = take();
        if (token.kind != Kind::punctuation) {
            visit(token);
        } else if (const char close = closing(token.value); close != '\0') {
            open += close;
            if (open.size() > kDeepest) {
                refuse(ErrorCode::file_syntax, "brackets are nested too deep",
                       {ElementKind::line, token.line});
            }
        } else if (closes(token.value)) {
            if (open.empty() || open.back() != token.value.front()) {
                refuse(ErrorCode::file_syntax,
                       "a bracket " + in_quotes(token.value) + " that nothing opened",
                       {ElementKind::line, token.line});
            }
            open.pop_back();
        }
    } while (!open.empty());
}

void UsdaText::skip_value() {
    visit_value([](const Token&) {});
}

std::vector<double> UsdaText::numbers() {
    std::vector<double> values;
    if (take("None")) return values;
    visit_value([&](const Token& token) { values.push_back(number_of(token)); });
    return values;
}

std::vector<float> UsdaText::floats() {
    std::vector<float> values;
    if (take("None")) return values;
    visit_value([&](const Token& token) {
        const auto value = static_cast<float>(number_of(token));
        if (!std::isfinite(value)) {
            refuse(ErrorCode::not_finite,
                   "the number " + in_quotes(token.value) +
                       " is not finite, or beyond the range of 32-bit numbers",
                   {ElementKind::line, token.line});
        }
        values.push_back(value);
    });
    return values;
}

std::vector<std::string> UsdaText::texts() {
    std::vector<std::string> values;
    visit_value([&](const Token& token) {
        values.push_back(token.kind == Kind::text ? without_escapes(token.value)
                                                  : std::string(token.value));
    });
    return values;
}

}  // namespace lissom
