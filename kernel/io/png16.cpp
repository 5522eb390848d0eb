#include "kernel/io/png16.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

#include "kernel/core/error.h"
#include "kernel/io/stream/scalar.h"

#if __has_include(<stb/stb_image_write.h>)
#define LISSOM_HAS_STB_DEFLATE
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
#endif

namespace lissom {
namespace {

constexpr std::size_t kPixelBytes = 6;
constexpr std::size_t kMaxPixelBytes = std::size_t{1} << 30;

// Each row begins with its filter: 2, the difference from the row above.
std::string filtered(std::size_t width, std::size_t height, std::span<const std::uint16_t> rgb) {
    constexpr char kUp = 2;
    const std::size_t row_bytes = kPixelBytes * width;
    std::string above(row_bytes, '\0'), row, result;
    result.reserve((row_bytes + 1) * height);
    for (std::size_t r = 0; r < height; ++r) {
        row.clear();
        for (const std::uint16_t x : rgb.subspan(3 * width * r, 3 * width)) {
            append_number(row, x, Endianness::big);
        }
        result += kUp;
        for (std::size_t i = 0; i < row_bytes; ++i) {
            result += static_cast<char>(row[i] - above[i]);
        }
        above.swap(row);
    }
    return result;
}

#ifdef LISSOM_HAS_STB_DEFLATE

std::string deflated(std::string bytes) {
    constexpr int kQuality = 8;
    int size = 0;
    const std::unique_ptr<unsigned char, decltype(&std::free)> packed(
        stbi_zlib_compress(reinterpret_cast<unsigned char*>(bytes.data()),
                           static_cast<int>(bytes.size()), &size, kQuality),
        &std::free);
    if (!packed) throw std::bad_alloc();
    return {reinterpret_cast<const char*>(packed.get()), static_cast<std::size_t>(size)};
}

#else

std::uint32_t adler32(const std::string& bytes) {
    constexpr std::uint32_t kPrime = 65521;
    std::uint32_t a = 1, b = 0;
    for (const char c : bytes) {
        a = (a + static_cast<unsigned char>(c)) % kPrime;
        b = (b + a) % kPrime;
    }
    return b << 16 | a;
}

// Blocks that are stored as they are.
std::string deflated(const std::string& bytes) {
    constexpr std::size_t kBlock = 65535;
    std::string result = "\x78\x01";
    for (std::size_t first = 0; first < bytes.size(); first += kBlock) {
        const auto size = static_cast<std::uint16_t>(std::min(kBlock, bytes.size() - first));
        result += first + size == bytes.size() ? '\1' : '\0';
        append_number(result, size, Endianness::little);
        append_number(result, static_cast<std::uint16_t>(~size), Endianness::little);
        result.append(bytes, first, size);
    }
    append_number(result, adler32(bytes), Endianness::big);
    return result;
}

#endif

std::uint32_t crc32(std::string_view bytes) {
    constexpr std::uint32_t kPolynomial = 0xedb88320;
    std::uint32_t crc = 0xffffffff;
    for (const char c : bytes) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) ? kPolynomial : 0);
    }
    return ~crc;
}

void add_chunk(std::string& file, std::string_view name, std::string_view bytes) {
    append_number(file, static_cast<std::uint32_t>(bytes.size()), Endianness::big);
    const std::size_t first = file.size();
    file += name;
    file += bytes;
    append_number(file, crc32(std::string_view(file).substr(first)), Endianness::big);
}

}  // namespace

std::string encode_png16(Index width, Index height, std::span<const std::uint16_t> rgb) {
    constexpr std::array<char, 5> kRgb16{16, 2, 0, 0, 0};
    const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
    if (rows > 0 && columns > kMaxPixelBytes / kPixelBytes / rows) {
        throw Error(ErrorCode::file_too_large, "a picture of " + std::to_string(width) + " by " +
                                                   std::to_string(height) + " pixels is too large");
    }
    std::string header;
    append_number(header, static_cast<std::uint32_t>(width), Endianness::big);
    append_number(header, static_cast<std::uint32_t>(height), Endianness::big);
    header.append(kRgb16.data(), kRgb16.size());
    std::string file = "\x89PNG\r\n\x1a\n";
    add_chunk(file, "IHDR", header);
    add_chunk(file, "IDAT", deflated(filtered(columns, rows, rgb)));
    add_chunk(file, "IEND", {});
    return file;
}

}  // namespace lissom
