#include "viewer/render/draw/image/color.h"

#include "tests/unit/support.h"
#include "viewer/render/draw/image/colormap.h"

using namespace lissom;

TEST_CASE("colours are read from names and from hexadecimal digits") {
    CHECK(parse_color("white") == Color{1.0, 1.0, 1.0});
    CHECK(parse_color("#ff0080") == Color{1.0, 0.0, 128.0 / 255.0});
    CHECK(parse_color("#F08") == parse_color("#ff0088"));
    CHECK(parse_color("blue") == kRegionColor);
}

TEST_CASE("every name of the list is a colour") {
    std::string_view names = color_names();
    int count = 0;
    while (!names.empty()) {
        const std::size_t comma = std::min(names.find(", "), names.size());
        CHECK_NOTHROW(parse_color(names.substr(0, comma)));
        names.remove_prefix(std::min(comma + 2, names.size()));
        ++count;
    }
    CHECK(count > 10);
}

TEST_CASE("what is not a colour is refused with what is accepted") {
    for (const char* text : {"", "#", "#12", "#12345", "#gggggg", "blau", "#ffffff "}) {
        const Error error = test::error_of([&] { parse_color(text); });
        CHECK(error.code() == ErrorCode::invalid_argument);
        CHECK(error.message().find("#rrggbb") != std::string::npos);
    }
}

TEST_CASE("sRGB and linear values are inverse, and meet at both ends") {
    for (const double value : {0.0, 0.001, 0.04, 0.05, 0.5, 1.0}) {
        CHECK(linear_to_srgb(srgb_to_linear(value)) == doctest::Approx(value));
    }
    CHECK(srgb_to_linear(1.0) == doctest::Approx(1.0));
    CHECK(srgb_to_linear(0.5) == doctest::Approx(0.21404).epsilon(1e-4));
}

TEST_CASE("the colour scale becomes lighter all the way, in even steps") {
    double last = lightness(colormap(0.0));
    for (int i = 1; i <= 20; ++i) {
        const double now = lightness(colormap(i / 20.0));
        CHECK(now - last > 0.015);
        CHECK(now - last < 0.065);
        last = now;
    }
}

TEST_CASE("the colour scale ends where its range does") {
    CHECK(colormap(-3.0) == colormap(0.0));
    CHECK(colormap(7.0) == colormap(1.0));
}

TEST_CASE("colours of numbered things differ and repeat") {
    CHECK_FALSE(category_color(0) == category_color(1));
    CHECK(category_color(2) == category_color(10));
}
