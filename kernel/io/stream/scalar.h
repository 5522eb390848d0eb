/// The number types of files; private to kernel/io.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

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

/// What integers of a type are divided by to give a colour between 0 and 1: the largest value of 8
/// bits and of unsigned 16 bits. Files with other integers use them for the values of a byte, so
/// that is 255.
double color_divisor(ScalarType type);

/// The value of an integer type that is nearest to `value`; 0 for NaN.
double rounded_to(ScalarType integer_type, double value);

/// True where `value` is one of a normal 32-bit number or zero.
bool is_float(double value);

/// Reverses the bytes of a number where `order` is not the machine's.
template <typename T>
T with_byte_order(T value, Endianness order) {
    const bool native =
        (order == Endianness::little) == (std::endian::native == std::endian::little);
    if (native) return value;
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    std::memcpy(&value, bytes, sizeof(T));
    return value;
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
