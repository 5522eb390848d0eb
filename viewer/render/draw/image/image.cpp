#include "viewer/render/draw/image/image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "kernel/core/error.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace lissom {
namespace {

// The encoder counts bytes in an int and doubles its buffer while it grows.
constexpr std::size_t kMaximumBytes = std::numeric_limits<int>::max() / 2 + 1;

std::vector<std::uint8_t> without_alpha(const Image& image) {
    std::vector<std::uint8_t> rgb(image.rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
        std::copy_n(image.rgba.data() + 4 * i, 3, rgb.data() + 3 * i);
    }
    return rgb;
}

void append(void* target, void* bytes, int count) {
    static_cast<std::string*>(target)->append(static_cast<const char*>(bytes), count);
}

}  // namespace

Image::Image(int image_width, int image_height)
    : width(image_width), height(image_height), rgba(4 * at(image_width) * image_height) {}

Color Image::color(int x, int y) const {
    const std::uint8_t* const p = pixel(x, y);
    return {p[0] / 255.0, p[1] / 255.0, p[2] / 255.0};
}

bool Image::is_opaque() const {
    for (std::size_t i = 3; i < rgba.size(); i += 4) {
        if (rgba[i] != 255) return false;
    }
    return true;
}

void Image::paste(const Image& part, int x, int y) {
    for (int row = 0; row < part.height; ++row) {
        std::copy_n(part.pixel(0, row), 4 * at(part.width), pixel(x, y + row));
    }
}

Image mixed(const Image& a, const Image& b, double share) {
    Image image = a;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const double from = (1.0 - share) * a.rgba[i + 3], to = share * b.rgba[i + 3];
        image.rgba[i + 3] = static_cast<std::uint8_t>(std::lround(from + to));
        if (from + to == 0.0) continue;
        for (std::size_t k = i; k < i + 3; ++k) {
            const double light =
                from * srgb_to_linear(a.rgba[k] / 255.0) + to * srgb_to_linear(b.rgba[k] / 255.0);
            image.rgba[k] =
                static_cast<std::uint8_t>(std::lround(255.0 * linear_to_srgb(light / (from + to))));
        }
    }
    return image;
}

std::string encode_png(const Image& image) {
    if (image.rgba.empty()) {
        throw Error(ErrorCode::invalid_argument, "an image without pixels cannot be written");
    }
    const int channels = image.is_opaque() ? 3 : 4;
    const std::size_t row = at(image.width) * channels + 1;
    if (row * image.height > kMaximumBytes) {
        throw Error(ErrorCode::memory_limit,
                    "the picture is too large for a PNG file; make it smaller");
    }
    const std::vector<std::uint8_t> rgb =
        channels == 3 ? without_alpha(image) : std::vector<std::uint8_t>();
    const std::uint8_t* const pixels = channels == 3 ? rgb.data() : image.rgba.data();
    std::string bytes;
    const int written = stbi_write_png_to_func(append, &bytes, image.width, image.height, channels,
                                               pixels, image.width * channels);
    if (!written) {
        throw Error(ErrorCode::memory_limit, "there is not enough memory to write the picture");
    }
    return bytes;
}

Image decode_png(std::string_view bytes) {
    if (bytes.size() > at(std::numeric_limits<int>::max())) {
        throw Error(ErrorCode::memory_limit, "the picture is too large");
    }
    Image image;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                              index_of(bytes.size()), &image.width, &image.height, &channels, 4),
        stbi_image_free);
    if (!pixels) {
        throw Error(ErrorCode::file_syntax,
                    std::string("the bytes are no PNG picture (") + stbi_failure_reason() + ")");
    }
    image.rgba.assign(pixels.get(), pixels.get() + 4 * at(image.width) * image.height);
    return image;
}

}  // namespace lissom
