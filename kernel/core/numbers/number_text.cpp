#include "kernel/core/numbers/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace lissom {
namespace {

// A decimal number as it is written: mantissa * 10^exponent.
struct Decimal {
    std::uint64_t mantissa = 0;
    std::int64_t exponent = 0;
    bool negative = false;
    // Whether the mantissa has all digits.
    bool whole = true;
    const char* end = nullptr;
};

bool is_decimal_digit(char c) {
    return c >= '0' && c <= '9';
}

void take_digit(Decimal& number, char digit, bool fraction) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max() / 10 - 1;
    if (number.mantissa > kMost) {
        number.whole = false;
        if (!fraction) ++number.exponent;
        return;
    }
    number.mantissa = number.mantissa * 10 + static_cast<std::uint64_t>(digit - '0');
    if (fraction) --number.exponent;
}

// The exponent behind the digits; without digits of its own it does not belong to the number.
void take_exponent(Decimal& number, const char* last) {
    const char* c = number.end;
    if (c == last || (*c != 'e' && *c != 'E')) return;
    const bool negative = ++c != last && *c == '-';
    if (c != last && (*c == '-' || *c == '+')) ++c;
    if (c == last || !is_decimal_digit(*c)) return;
    constexpr std::int64_t kLimit = std::int64_t{1} << 40;
    std::int64_t written = 0;
    for (; c != last && is_decimal_digit(*c); ++c) {
        written = std::min(kLimit, written * 10 + (*c - '0'));
    }
    number.exponent += negative ? -written : written;
    number.end = c;
}

// No end: there is no number.
Decimal scan_decimal(const char* first, const char* last) {
    Decimal number;
    const char* c = first;
    number.negative = c != last && *c == '-';
    if (number.negative) ++c;
    bool fraction = false, digits = false;
    for (; c != last; ++c) {
        if (is_decimal_digit(*c)) {
            digits = true;
            take_digit(number, *c, fraction);
        } else if (*c == '.' && !fraction) {
            fraction = true;
        } else {
            break;
        }
    }
    if (!digits) return number;
    number.end = c;
    take_exponent(number, last);
    return number;
}

bool starts_with_word(const char* first, const char* last, std::string_view word) {
    return static_cast<std::size_t>(last - first) >= word.size() &&
           std::equal(word.begin(), word.end(), first,
                      [](char a, char b) { return a == (b | 0x20); });
}

template <typename Number>
std::from_chars_result read_name(const char* first, const char* last, Number& value) {
    const bool negative = first != last && *first == '-';
    const char* word = first + (negative ? 1 : 0);
    for (const std::string_view name : {"infinity", "inf", "nan"}) {
        if (!starts_with_word(word, last, name)) continue;
        const Number named = name == "nan" ? std::numeric_limits<Number>::quiet_NaN()
                                           : std::numeric_limits<Number>::infinity();
        value = negative ? -named : named;
        return {word + name.size(), std::errc()};
    }
    return {first, std::errc::invalid_argument};
}

// Both factors are doubles without an error, so that the one operation rounds to the nearest.
bool reads_exactly(const Decimal& number, double& value) {
    constexpr std::uint64_t kExact = std::uint64_t{1} << 53;
    constexpr std::array<double, 23> kPowers = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    const auto power = static_cast<std::size_t>(std::abs(number.exponent));
    if (!number.whole || number.mantissa > kExact || power >= kPowers.size()) return false;
    const auto mantissa = static_cast<double>(number.mantissa);
    value = number.exponent < 0 ? mantissa / kPowers[power] : mantissa * kPowers[power];
    if (number.negative) value = -value;
    return true;
}

// The C library rounds to the nearest, at its own pace.
double slow_value(const std::string& text, double) {
    return std::strtod(text.c_str(), nullptr);
}

float slow_value(const std::string& text, float) {
    return std::strtof(text.c_str(), nullptr);
}

template <typename Number>
std::from_chars_result read_value(const char* first, const char* last, Number& value) {
    const Decimal number = scan_decimal(first, last);
    if (!number.end) return read_name(first, last, value);
    double exact = 0.0;
    // Rounded twice, a float would not be the nearest.
    const bool is_exact = std::is_same_v<Number, double> && reads_exactly(number, exact);
    const Number read = is_exact ? static_cast<Number>(exact)
                                 : slow_value(std::string(first, number.end), Number{});
    const bool lost = std::isinf(read) || (read == Number{0} && number.mantissa != 0);
    if (lost) return {number.end, std::errc::result_out_of_range};
    value = read;
    return {number.end, std::errc()};
}

// Digits without zeros at their end, and the exponent of ten of the first.
struct Digits {
    std::string digits;
    int exponent = 0;
};

template <typename Number>
bool reads_back(const char* text, Number value) {
    Number read{};
    read_value(text, text + std::strlen(text), read);
    return read == value;
}

// `value` is above 0 and finite.
template <typename Number>
Digits shortest_digits(Number value) {
    std::array<char, 40> text{};
    // All texts of so many digits read back equal, if the number is not below the least with all of
    // its bits; two or three digits more tell all numbers apart.
    constexpr int kFewest = std::numeric_limits<Number>::digits10;
    for (int count = value < std::numeric_limits<Number>::min() ? 1 : kFewest;
         count <= std::numeric_limits<Number>::max_digits10; ++count) {
        std::snprintf(text.data(), text.size(), "%.*e", count - 1, static_cast<double>(value));
        if (reads_back(text.data(), value)) break;
    }
    const std::string_view all(text.data());
    const std::size_t mark = all.find('e');
    Digits result;
    for (const char c : all.substr(0, mark)) {
        if (is_decimal_digit(c)) result.digits += c;
    }
    result.digits.resize(std::max(result.digits.find_last_not_of('0') + 1, std::size_t{1}));
    result.exponent = std::atoi(text.data() + mark + 1);
    return result;
}

std::string scientific(const Digits& number) {
    std::array<char, 16> exponent{};
    std::snprintf(exponent.data(), exponent.size(), "e%+03d", number.exponent);
    std::string text = number.digits;
    if (text.size() > 1) text.insert(1, ".");
    return text + exponent.data();
}

std::size_t fixed_size(const Digits& number) {
    const std::size_t count = number.digits.size();
    if (number.exponent < 0) return count + 1 + static_cast<std::size_t>(-number.exponent);
    const auto whole = static_cast<std::size_t>(number.exponent) + 1;
    return count > whole ? count + 1 : whole;
}

// Digits beyond the shortest are those of the number itself.
std::string fixed(const Digits& number, double value) {
    const int after = static_cast<int>(number.digits.size()) - 1 - number.exponent;
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", std::max(after, 0), value);
    return text.data();
}

template <typename Number>
std::string shortest_text(Number value) {
    const std::string sign = std::signbit(value) ? "-" : "";
    if (std::isnan(value)) return sign + "nan";
    if (std::isinf(value)) return sign + "inf";
    if (value == Number{0}) return sign + "0";
    const Digits digits = shortest_digits(std::abs(value));
    const std::string text = scientific(digits);
    if (fixed_size(digits) > text.size()) return sign + text;
    return sign + fixed(digits, static_cast<double>(std::abs(value)));
}

std::to_chars_result put_text(char* first, char* last, const std::string& text) {
    if (static_cast<std::size_t>(last - first) < text.size()) {
        return {last, std::errc::value_too_large};
    }
    return {std::copy(text.begin(), text.end(), first), std::errc()};
}

}  // namespace

std::from_chars_result read_decimal(const char* first, const char* last, double& value) {
    return read_value(first, last, value);
}

std::from_chars_result read_decimal(const char* first, const char* last, float& value) {
    return read_value(first, last, value);
}

std::to_chars_result write_decimal(char* first, char* last, double value) {
    return put_text(first, last, shortest_text(value));
}

std::to_chars_result write_decimal(char* first, char* last, float value) {
    return put_text(first, last, shortest_text(value));
}

}  // namespace lissom
