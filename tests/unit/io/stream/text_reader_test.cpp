#include "kernel/io/stream/text_reader.h"

#include <cmath>

#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

double number_in(std::string_view text) {
    return TextReader(text, {}).number();
}

}  // namespace

TEST_CASE("numbers are read to the nearest double") {
    CHECK(number_in("0.1") == 0.1);
    CHECK(number_in("-1e-3") == -0.001);
    CHECK(number_in(".5") == 0.5);
    CHECK(number_in("5.") == 5.0);
    CHECK(number_in("17976931348623157e292") == 17976931348623157e292);
    CHECK(number_in("2.2250738585072011e-308") == 2.2250738585072011e-308);
    CHECK(std::signbit(number_in("-0")));
}

TEST_CASE("a leading plus is read, but not two signs") {
    CHECK(number_in("+2.5") == 2.5);
    CHECK(TextReader("+7", {}).integer() == 7);
    CHECK(error_of([] { number_in("+-2"); }).code() == ErrorCode::file_syntax);
    CHECK(error_of([] { number_in("+"); }).code() == ErrorCode::file_syntax);
}

TEST_CASE("numbers out of range become infinity or zero") {
    CHECK(number_in("1e400") == INFINITY);
    CHECK(number_in("-1e400") == -INFINITY);
    CHECK(number_in("1e-400") == 0.0);
    CHECK(number_in("1e99999999999999999999") == INFINITY);
    CHECK(number_in("1e-99999999999999999999") == 0.0);
    CHECK(number_in(std::string(400, '9')) == INFINITY);
    CHECK(number_in("0." + std::string(400, '0') + "1") == 0.0);
    CHECK(number_in("0." + std::string(400, '0') + "1e800") == INFINITY);
}

TEST_CASE("words that only begin as numbers are refused") {
    for (const char* text : {"1.5x", "x", "1,5", "1.#QNAN", "0x10", "--1", "", "\n1"}) {
        CAPTURE(text);
        CHECK(error_of([&] { number_in(text); }).code() == ErrorCode::file_syntax);
    }
}

TEST_CASE("whole numbers beyond 64 bits are the nearest") {
    CHECK(TextReader("99999999999999999999", {}).integer() == INT64_MAX);
    CHECK(TextReader("-99999999999999999999", {}).integer() == INT64_MIN);
    CHECK(error_of([] { TextReader("1.0", {}).integer(); }).code() == ErrorCode::file_syntax);
}

TEST_CASE("lines end with LF, CR LF or CR and are counted") {
    TextReader text("a\nb\r\nc\rd", {});
    for (std::size_t line = 0; line < 4; ++line) {
        CHECK(text.line() == line);
        CHECK(text.word() == std::string(1, static_cast<char>('a' + line)));
        CHECK(text.at_line_end());
        text.skip_line();
    }
    CHECK(text.at_end());
}

TEST_CASE("a continued line is one line to its reader, and two in the count") {
    TextReader text("1 \\\n2 3\\\r\n 4\n5", {.comment = '\0', .continuation = true});
    for (int i = 1; i <= 4; ++i) CHECK(text.integer() == i);
    CHECK(text.at_line_end());
    CHECK(text.line() == 2);
    CHECK(text.next_integer() == 5);
}

TEST_CASE("comments end with their line, even after a backslash") {
    TextReader text("# one \\\n1 # two\n#three\n2#four", {.comment = '#', .continuation = true});
    CHECK(text.next_integer() == 1);
    CHECK(text.at_line_end());
    CHECK(text.next_integer() == 2);
    CHECK(text.at_end());
}

TEST_CASE("an early end names what was found of what was announced") {
    TextReader text("1 2", {});
    text.tally = {"vertices", 1, 5};
    text.next_number();
    text.next_number();
    const Error error = error_of([&] { text.next_number(); });
    CHECK(error.code() == ErrorCode::file_truncated);
    CHECK(error.message().find("1 of 5 vertices") != std::string::npos);
}

TEST_CASE("words in messages are short and printable") {
    CHECK(in_quotes("a\x01z") == "'a?z'");
    CHECK(in_quotes(std::string(100, 'x')).size() < 50);
}
