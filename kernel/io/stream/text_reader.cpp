#include "kernel/io/stream/text_reader.h"

#include <algorithm>
#include <limits>
#include <system_error>

#include "kernel/core/numbers/number_text.h"

namespace lissom {
namespace {

// Exponent of ten of the first digit that is not zero in the number [first, last): tells, without
// computing it, whether a number out of range is too large or too small.
std::int64_t decimal_magnitude(const char* first, const char* last) {
    std::int64_t exponent = -1;
    bool fraction = false, significant = false;
    const char* c = first;
    for (; c != last && *c != 'e' && *c != 'E'; ++c) {
        if (*c == '.') {
            fraction = true;
        } else if (*c >= '0' && *c <= '9') {
            significant = significant || *c != '0';
            if (significant && !fraction) ++exponent;
            if (!significant && fraction) --exponent;
        }
    }
    if (c == last || ++c == last) return exponent;
    if (*c == '+') ++c;
    std::int64_t written = 0;
    if (read_number(c, last, written).ec == std::errc::result_out_of_range) {
        return *c == '-' ? -1 : 1;
    }
    constexpr std::int64_t kLimit = std::int64_t{1} << 60;
    return exponent + std::clamp(written, -kLimit, kLimit);
}

double out_of_range_value(const char* first, const char* last) {
    const double magnitude =
        decimal_magnitude(first, last) > 0 ? std::numeric_limits<double>::infinity() : 0.0;
    return *first == '-' ? -magnitude : magnitude;
}

}  // namespace

void TextReader::skip_blanks() {
    while (at_ != end_) {
        if (is_blank(*at_)) {
            ++at_;
        } else if (*at_ != '\\' || !skip_continuation()) {
            return;
        }
    }
}

bool TextReader::skip_line_end() {
    if (at_ == end_ || !is_line_end(*at_)) return false;
    const bool carriage_return = *at_++ == '\r';
    if (carriage_return && at_ != end_ && *at_ == '\n') ++at_;
    ++line_;
    return true;
}

bool TextReader::skip_continuation() {
    if (!style_.continuation || at_ + 1 == end_ || !is_line_end(at_[1])) return false;
    ++at_;
    return skip_line_end();
}

bool TextReader::at_line_end() {
    skip_blanks();
    return at_ == end_ || is_line_end(*at_) || (style_.comment != '\0' && *at_ == style_.comment);
}

bool TextReader::at_end() {
    while (at_line_end()) {
        if (at_ == end_) return true;
        skip_line();
    }
    return false;
}

void TextReader::skip_line() {
    const bool in_comment = style_.comment != '\0' && peek() == style_.comment;
    while (at_ != end_) {
        if (skip_line_end()) return;
        if (in_comment || *at_ != '\\' || !skip_continuation()) ++at_;
    }
}

bool TextReader::at_word_end() const {
    if (at_ == end_ || is_blank(*at_) || is_line_end(*at_)) return true;
    return *at_ == '\\' && style_.continuation && at_ + 1 != end_ && is_line_end(at_[1]);
}

std::string_view TextReader::word() {
    skip_blanks();
    const char* const start = at_;
    while (!at_word_end()) ++at_;
    return {start, at(at_ - start)};
}

std::string_view TextReader::rest_of_line() {
    skip_blanks();
    const char* const start = at_;
    while (at_ != end_ && !is_line_end(*at_)) ++at_;
    const char* last = at_;
    while (last != start && is_blank(last[-1])) --last;
    return {start, at(last - start)};
}

// std::from_chars knows no leading plus.
void TextReader::skip_plus() {
    if (end_ - at_ > 1 && *at_ == '+' && at_[1] != '-') ++at_;
}

double TextReader::number() {
    skip_blanks();
    const char* const start = at_;
    skip_plus();
    double value = 0.0;
    const auto [stop, error] = read_number(at_, end_, value);
    if (error == std::errc::invalid_argument) refuse_word(start, "a number");
    if (error == std::errc::result_out_of_range) value = out_of_range_value(at_, stop);
    at_ = stop;
    if (!at_word_end() && *at_ != style_.comment) refuse_word(start, "a number");
    return value;
}

std::int64_t TextReader::integer() {
    skip_blanks();
    const char* const start = at_;
    skip_plus();
    std::int64_t value = 0;
    const auto [stop, error] = read_number(at_, end_, value);
    if (error == std::errc::invalid_argument) refuse_word(start, "a whole number");
    if (error == std::errc::result_out_of_range) {
        value = *at_ == '-' ? std::numeric_limits<std::int64_t>::min()
                            : std::numeric_limits<std::int64_t>::max();
    }
    at_ = stop;
    // A slash separates the indices of a corner in OBJ.
    const bool at_its_end = at_word_end() || *at_ == '/' || *at_ == style_.comment;
    if (!at_its_end) refuse_word(start, "a whole number");
    return value;
}

double TextReader::next_number() {
    if (at_end()) refuse_truncated(tally);
    return number();
}

std::int64_t TextReader::next_integer() {
    if (at_end()) refuse_truncated(tally);
    return integer();
}

std::string_view TextReader::next_word() {
    if (at_end()) refuse_truncated(tally);
    return word();
}

void TextReader::refuse_word(const char* start, std::string_view expected) {
    at_ = start;
    const std::string_view found = word();
    refuse(ErrorCode::file_syntax,
           "expected " + std::string(expected) + ", found " +
               (found.empty() ? std::string("the end of the line") : in_quotes(found)),
           place());
}

}  // namespace lissom
