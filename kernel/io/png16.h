/// PNG files with 16 bits a channel; private to kernel/io and not installed.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "kernel/core/index.h"

namespace lissom {

/// Returns a PNG file of red, green and blue, row after row from the top, without a profile: the
/// numbers are linear. Without stb_image_write at build time the file is not compressed.
/// Errors: file_too_large for more than 2^30 bytes of pixels.
std::string encode_png16(Index width, Index height, std::span<const std::uint16_t> rgb);

}  // namespace lissom
