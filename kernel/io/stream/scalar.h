/// The number types of files; private to kernel/io.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "kernel/core/numbers/bits.h"
#include "kernel/io/stream/endianness.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

/// Bytes of one number.
std::size_t size_of(ScalarType type);

bool is_integer(ScalarType type);

/// Smallest and largest value of an integer type.
struct ScalarRange {
    double min, max;
};
ScalarRange range_of(ScalarType type);

/// Returns the divisor of a type's integers for a colour between 0 and 1: the largest value of 8
/// bits and of unsigned 16 bits. Files with other integers use them for the values of a byte, so
/// that is 255.
double color_divisor(ScalarType type);

/// Returns the value of an integer type that is nearest to `value`; 0 for NaN.
double rounded_to(ScalarType integer_type, double value);

/// Returns true if `value` is one of a normal 32-bit number or zero.
bool is_float(double value);

/// Returns whether the machine keeps numbers in this order.
inline bool is_native(Endianness order) {
    return (order == Endianness::little) == (std::endian::native == std::endian::little);
}

/// The bytes of a number in a file. Reversed bytes are never held as a number: some processors
/// change a signalling NaN on its way.
template <typename T>
std::array<char, sizeof(T)> to_bytes(T value, Endianness order) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (!is_native(order)) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

/// Returns the number that the next bytes of a file are.
template <typename T>
T from_bytes(const char* next, Endianness order) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), next, sizeof(T));
    if (!is_native(order)) std::reverse(bytes.begin(), bytes.end());
    return bits_as<T>(bytes);
}

/// Appends the bytes of a number in a file.
template <typename T>
void append_number(std::string& bytes, T value, Endianness order) {
    const std::array<char, sizeof(T)> added = to_bytes(value, order);
    bytes.append(added.data(), added.size());
}

/// Calls use(T{}) with T the C++ type of `type`.
template <typename Use>
decltype(auto) with_scalar(ScalarType type, const Use& use) {
    switch (type) {
        case ScalarType::float64:
            return use(double{});
        case ScalarType::int8:
            return use(std::int8_t{});
        case ScalarType::uint8:
            return use(std::uint8_t{});
        case ScalarType::int16:
            return use(std::int16_t{});
        case ScalarType::uint16:
            return use(std::uint16_t{});
        case ScalarType::int32:
            return use(std::int32_t{});
        case ScalarType::uint32:
            return use(std::uint32_t{});
        default:
            return use(float{});
    }
}

}  // namespace lissom
