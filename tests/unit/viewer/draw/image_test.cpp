#include "viewer/draw/image.h"

#include "tests/unit/support.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

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

// The pixels of a PNG file and its number of channels.
Image decode(const std::string& png, int& channels) {
    Image image;
    stbi_uc* const pixels = stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(png.data()),
                                                  static_cast<int>(png.size()), &image.width,
                                                  &image.height, &channels, 4);
    REQUIRE(pixels);
    image.rgba.assign(pixels, pixels + 4 * static_cast<std::size_t>(image.width) * image.height);
    stbi_image_free(pixels);
    return image;
}

}  // namespace

TEST_CASE("a PNG file holds the pixels, and alpha only where it is needed") {
    for (const bool opaque : {true, false}) {
        const Image image = pattern(37, 21, opaque);
        int channels = 0;
        CHECK(decode(encode_png(image), channels) == image);
        CHECK(channels == (opaque ? 3 : 4));
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
