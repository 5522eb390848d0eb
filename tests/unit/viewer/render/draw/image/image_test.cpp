#include "viewer/render/draw/image/image.h"

#include "tests/unit/support.h"

using namespace lissom;

namespace {

Image pattern(int width, int height, bool opaque) {
    Image image(width, height);
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        image.rgba[i] = static_cast<std::uint8_t>(i * 7 + i / 256);
        if (i % 4 == 3 && opaque) image.rgba[i] = 255;
    }
    return image;
}

// The kind of a PNG file: 2 without alpha, 6 with it.
int color_type(const std::string& png) {
    return png.at(25);
}

}  // namespace

TEST_CASE("a PNG file holds the pixels, and alpha only where it is needed") {
    for (const bool opaque : {true, false}) {
        const Image image = pattern(37, 21, opaque);
        const std::string png = encode_png(image);
        CHECK(decode_png(png) == image);
        CHECK(color_type(png) == (opaque ? 2 : 6));
    }
}

TEST_CASE("the same image gives the same file") {
    CHECK(encode_png(pattern(64, 64, true)) == encode_png(pattern(64, 64, true)));
}

TEST_CASE("an image without pixels is not written") {
    CHECK(test::error_of([] { encode_png(Image()); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("a pasted part replaces its rectangle and nothing else") {
    Image image(6, 5);
    image.paste(pattern(2, 3, true), 3, 1);
    CHECK(image.pixel(3, 1)[0] == 0);
    CHECK(image.pixel(3, 1)[3] == 255);
    CHECK(image.pixel(4, 3)[1] == pattern(2, 3, true).pixel(1, 2)[1]);
    CHECK(image.pixel(2, 1)[3] == 0);
    CHECK(image.pixel(5, 3)[3] == 0);
    CHECK(image.pixel(3, 4)[3] == 0);
}

TEST_CASE("bytes that are no PNG file are refused") {
    const std::string png = encode_png(pattern(64, 64, true));
    for (const std::string& bytes : {std::string(), std::string("text"), png.substr(0, 60)}) {
        CHECK(test::error_of([&] { decode_png(bytes); }).code() == ErrorCode::file_syntax);
    }
}
