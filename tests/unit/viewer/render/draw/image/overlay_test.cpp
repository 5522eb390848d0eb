#include "viewer/render/draw/image/overlay.h"

#include <string>

#include "tests/unit/viewer/viewer_support.h"

using namespace lissom;

namespace {

constexpr Color kBlack{};

Image white(int width, int height) {
    Image image(width, height);
    fill_rectangle(image, 0, 0, width, height, kWhite);
    return image;
}

double ink(const Image& image) {
    double sum = 0.0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) sum += 1.0 - test::brightness(image.color(x, y));
    }
    return sum;
}

}  // namespace

TEST_CASE("every printable character but the backquote and a few signs has a letter of its own") {
    const TextStrokes box = lay_out_text("\x01", 14.0);
    for (const char c : std::string("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                    ".,:;-_+=/\\()[]%*'\"#<>!?|^")) {
        CAPTURE(c);
        const TextStrokes letter = lay_out_text(std::string(1, c), 14.0);
        CHECK(!letter.strokes.empty());
        CHECK(letter.strokes != box.strokes);
    }
}

TEST_CASE("letters stay between the lowest and highest line and scale with their height") {
    const TextStrokes text = lay_out_text("Qgpy|(08%", 28.0);
    for (const Stroke& stroke : text.strokes) {
        for (const Vec2& p : stroke) {
            CHECK(p.y() >= -10.0);
            CHECK(p.y() <= 33.0);
            CHECK(p.x() >= -2.0);
            CHECK(p.x() <= text.width + 1.0);
        }
    }
    CHECK(lay_out_text("width", 28.0).width ==
          doctest::Approx(2.0 * lay_out_text("width", 14.0).width));
}

TEST_CASE("the first letter keeps its distance even where it has no width") {
    const TextStrokes text = lay_out_text("ii", 14.0);
    CHECK(text.strokes.front().front().x() == 0.0);
    CHECK(text.strokes.back().front().x() > 1.0);
}

TEST_CASE("a character of several bytes is one box") {
    CHECK(lay_out_text("\xC3\xA4", 14.0).strokes.size() == 1);
}

TEST_CASE("a stroke covers its length times its width") {
    Image image = white(100, 40);
    draw_strokes(image, {{Vec2(10.0, 20.0), Vec2(90.0, 20.0)}}, 6.0, kBlack);
    CHECK(ink(image) == doctest::Approx(80.0 * 6.0 + kPi * 9.0).epsilon(0.01));
}

TEST_CASE("strokes that cross paint their crossing once") {
    const Color gray{0.5, 0.5, 0.5};
    Image image = white(41, 41);
    draw_strokes(image, {{Vec2(0, 20), Vec2(41, 20)}, {Vec2(20, 0), Vec2(20, 41)}}, 8.0, gray);
    CHECK(image.color(20, 20) == image.color(5, 20));
}

TEST_CASE("drawing beyond the image is cut off") {
    Image image = white(20, 20);
    draw_text(image, "0000000000", -15.0, 12.0, 10.0, kBlack);
    draw_strokes(image, {{Vec2(-100, -100), Vec2(-50, -50)}}, 5.0, kBlack);
    fill_rectangle(image, 15, 15, 50, 50, kBlack);
    CHECK(image.color(19, 19) == kBlack);
    CHECK(image.color(14, 19) == kWhite);
}

TEST_CASE("ink on nothing becomes opaque in its own colour") {
    Image image(20, 20);
    draw_strokes(image, {{Vec2(0, 10), Vec2(20, 10)}}, 6.0, parse_color("#ff0000"));
    CHECK(image.pixel(10, 10)[0] == 255);
    CHECK(image.pixel(10, 10)[3] == 255);
    CHECK(image.pixel(10, 2)[3] == 0);
}
