#include "viewer/render/draw/image/image_difference.h"

#include <algorithm>
#include <cmath>

#include "tests/unit/support.h"

using namespace lissom;

namespace {

void set(Image& image, int x, int y, int level, int alpha = 255) {
    std::uint8_t* const p = image.pixel(x, y);
    p[0] = p[1] = p[2] = static_cast<std::uint8_t>(level);
    p[3] = static_cast<std::uint8_t>(alpha);
}

// Black left of a slanted edge and white right of it, with pixels between them by their share.
Image edge(double offset) {
    Image image(60, 40);
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 60; ++x) {
            const double share = std::clamp(x + 0.5 - (20.0 + offset + 0.3 * y), 0.0, 1.0);
            set(image, x, y, static_cast<int>(std::lround(255.0 * share)));
        }
    }
    return image;
}

Image plain(int level, int alpha = 255) {
    Image image(60, 40);
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 60; ++x) set(image, x, y, level, alpha);
    }
    return image;
}

double fraction(const Image& a, const Image& b, double tolerance = 0.05) {
    CHECK(compare_images(a, b, tolerance).fraction == compare_images(b, a, tolerance).fraction);
    return compare_images(a, b, tolerance).fraction;
}

}  // namespace

TEST_CASE("an edge that lies half a pixel elsewhere is no difference, two pixels are") {
    CHECK(fraction(edge(0.0), edge(0.0), 0.0) == 0.0);
    for (const double offset : {0.1, 0.3, 0.5}) CHECK(fraction(edge(0.0), edge(offset)) == 0.0);
    CHECK(fraction(edge(0.0), edge(2.5)) > 0.02);
}

TEST_CASE("one missing line is a difference on both sides") {
    Image lined = plain(255);
    for (int y = 0; y < 40; ++y) set(lined, 30, y, 0);
    CHECK(fraction(lined, plain(255)) == doctest::Approx(1.0 / 60.0));
}

TEST_CASE("a colour differs by more than the tolerance, and alpha counts") {
    CHECK(fraction(plain(100), plain(112)) == 0.0);
    CHECK(fraction(plain(100), plain(113)) == 1.0);
    CHECK(fraction(plain(100), plain(113), 0.06) == 0.0);
    CHECK(fraction(plain(100, 255), plain(100, 200)) == 1.0);
    CHECK(fraction(plain(0, 0), plain(255, 0)) == 0.0);
}

TEST_CASE("the greatest difference is named, and all is shown side by side") {
    Image picture = plain(200);
    set(picture, 7, 9, 100);
    set(picture, 50, 30, 40);
    const ImageDifference found = compare_images(picture, plain(200), 0.05);
    CHECK(found.fraction == doctest::Approx(2.0 / 2400.0));
    CHECK(found.greatest == doctest::Approx(160.0 / 255.0));
    CHECK(found.x == 50);
    CHECK(found.y == 30);
    CHECK(found.shown.width == 3 * 60 + 2 * 8);
    CHECK(found.shown.height == 40);
    CHECK(found.shown.pixel(68 + 7, 9)[0] == 100);
    const std::uint8_t* const marked = found.shown.pixel(2 * 68 + 7, 9);
    CHECK((marked[0] > 200 && marked[1] < 50));
    CHECK(found.shown.pixel(2 * 68 + 8, 9)[1] > 200);
}

TEST_CASE("pixels that differ and touch are one patch, scattered ones are not") {
    Image scattered = plain(200), bulge = plain(200);
    for (int i = 0; i < 12; ++i) {
        set(scattered, 4 * i + 2, 3 * (i % 3) + 5, 0);
        // A line that turns, also over corners.
        set(bulge, 10 + i, 20 + std::abs(i - 6), 0);
    }
    const ImageDifference noise = compare_images(scattered, plain(200), 0.05);
    const ImageDifference shape = compare_images(bulge, plain(200), 0.05);
    CHECK(noise.fraction == shape.fraction);
    CHECK(noise.patch == 1);
    CHECK(shape.patch == 12);
    CHECK(shape.patch_x == 16);
    CHECK(shape.patch_y == 20);
    CHECK(compare_images(plain(0), plain(200), 0.05).patch == 60 * 40);
    CHECK(compare_images(plain(0), plain(0), 0.05).patch == 0);
}
