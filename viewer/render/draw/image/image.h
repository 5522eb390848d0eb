/// A picture in memory and as a PNG file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/index.h"
#include "viewer/render/draw/image/color.h"

namespace lissom {

/// Pixels from the top left, row by row, four bytes each: red, green, blue in sRGB, and alpha,
/// which the colours are not multiplied by.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;

    Image() = default;
    /// Makes a transparent black image.
    Image(int image_width, int image_height);

    std::uint8_t* pixel(int x, int y) { return rgba.data() + offset(x, y); }
    const std::uint8_t* pixel(int x, int y) const { return rgba.data() + offset(x, y); }
    Color color(int x, int y) const;
    bool is_opaque() const;

    /// Copies `part` to the position (x, y) of its top left pixel; it must lie inside.
    void paste(const Image& part, int x, int y);

    bool operator==(const Image&) const = default;

  private:
    std::size_t offset(int x, int y) const { return 4 * (at(y) * width + x); }
};

/// Returns a share of `b`, the rest `a`, in linear light: two images of one size.
Image mixed(const Image& a, const Image& b, double share);

/// Returns the bytes of a PNG file; without an alpha channel if every pixel is opaque. The same
/// image gives the same bytes. Errors: invalid_argument for an image without pixels; memory_limit.
std::string encode_png(const Image& image);

/// Returns the image of a PNG file. Errors: file_syntax for bytes that are none; memory_limit.
Image decode_png(std::string_view bytes);

}  // namespace lissom
