#include "kernel/core/numbers/number_text.h"

#include <doctest/doctest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <random>
#include <string>
#include <string_view>

using lissom::read_decimal;
using lissom::write_decimal;

namespace {

template <typename Number>
std::string written(Number value) {
    char text[64];
    const auto [end, error] = write_decimal(text, text + sizeof text, value);
    REQUIRE(error == std::errc());
    return {text, end};
}

template <typename Number>
std::string written_by_library(Number value) {
    char text[64];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

// Finite numbers of all sizes, and those near 1 that models are made of.
template <typename Number, typename Bits>
void compare_texts(int trials) {
    std::mt19937_64 random(7);
    for (int i = 0; i < trials; ++i) {
        auto value = std::bit_cast<Number>(static_cast<Bits>(random()));
        if (i % 2 == 0) value = static_cast<Number>(std::ldexp(double(random()), -64) - 0.5);
        if (i % 10 == 0) value = static_cast<Number>(std::int64_t(random()) >> (random() % 63));
        if (!std::isfinite(value)) continue;
        CHECK(written(value) == written_by_library(value));
    }
}

template <typename Number, typename Bits>
void compare_reads_as(std::string_view text) {
    Number ours = 3, theirs = 3;
    const char* const last = text.data() + text.size();
    const auto [our_end, our_error] = read_decimal(text.data(), last, ours);
    const auto [their_end, their_error] = std::from_chars(text.data(), last, theirs);
    CAPTURE(text);
    CHECK(our_error == their_error);
    CHECK(our_end == their_end);
    CHECK((std::isnan(theirs) ? std::isnan(ours)
                              : std::bit_cast<Bits>(ours) == std::bit_cast<Bits>(theirs)));
}

void compare_reads(std::string_view text) {
    compare_reads_as<double, std::uint64_t>(text);
    compare_reads_as<float, std::uint32_t>(text);
}

}  // namespace

#ifdef __cpp_lib_to_chars
TEST_CASE("number text: doubles and floats are written as by the C++ library") {
    compare_texts<double, std::uint64_t>(20000);
    compare_texts<float, std::uint32_t>(20000);
    for (const double value : {0.0, -0.0, 1.0, 0.1, 1e22, 1e23, 5e-324, 1.7976931348623157e308,
                               123456789012345677.0, 100000.0, 1e5, 1e-5, 0.001}) {
        CHECK(written(value) == written_by_library(value));
        CHECK(written(-value) == written_by_library(-value));
    }
}

TEST_CASE("number text: doubles and floats are read as by the C++ library") {
    std::mt19937_64 random(11);
    for (int i = 0; i < 20000; ++i) {
        const auto value = std::bit_cast<double>(random());
        if (std::isfinite(value)) compare_reads(written_by_library(value) + " 1");
        // More digits than a double holds, and halves between two doubles.
        compare_reads("-0." + std::to_string(random()) + std::to_string(random()));
        compare_reads(std::to_string(random()) + "e-" + std::to_string(random() % 30));
    }
    for (const char* text : {"",
                             "-",
                             ".",
                             "-.",
                             "+1",
                             " 1",
                             "1.",
                             ".5",
                             "-.5",
                             "1e",
                             "1e+",
                             "1e5",
                             "1E-5x",
                             "0x10",
                             "1.2.3",
                             "inf",
                             "-inf",
                             "Infinity",
                             "nan",
                             "-NaN",
                             "in",
                             "1e400",
                             "-1e400",
                             "9007199254740993",
                             "2.2250738585072011e-308",
                             "4.9e-324",
                             "00000000000000000000000001",
                             "0.00000000000000000000000000000000000001e38",
                             "1e99999999999999999999",
                             "e5"}) {
        compare_reads(text);
    }
}
#endif

TEST_CASE("number text: what is written reads back equal, and too little room is an error") {
    for (const double value : {0.1, -1.0 / 3.0, 6.02214076e23, 5e-324, 1e100, 12345.678}) {
        const std::string text = written(value);
        double read = 0.0;
        CHECK(read_decimal(text.data(), text.data() + text.size(), read).ptr ==
              text.data() + text.size());
        CHECK(read == value);
        char small[2];
        CHECK(write_decimal(small, small + 2, value).ec == std::errc::value_too_large);
    }
}

TEST_CASE("number text: a value is left as it is after an error") {
    double value = 4.0;
    for (const std::string_view text : {"x", "", "1e999"}) {
        CHECK(read_decimal(text.data(), text.data() + text.size(), value).ec != std::errc());
        CHECK(value == 4.0);
    }
}
