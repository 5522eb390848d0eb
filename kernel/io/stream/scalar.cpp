#include "kernel/io/stream/scalar.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/core/numbers/bits.h"

namespace lissom {

std::size_t size_of(ScalarType type) {
    return with_scalar(type, [](auto zero) { return sizeof(zero); });
}

bool is_integer(ScalarType type) {
    return type != ScalarType::float32 && type != ScalarType::float64;
}

ScalarRange range_of(ScalarType type) {
    return with_scalar(type, [](auto zero) {
        using Limits = std::numeric_limits<decltype(zero)>;
        return ScalarRange{static_cast<double>(Limits::lowest()),
                           static_cast<double>(Limits::max())};
    });
}

double color_divisor(ScalarType type) {
    switch (type) {
        case ScalarType::float32:
        case ScalarType::float64:
            return 1.0;
        case ScalarType::int8:
            return 127.0;
        case ScalarType::uint16:
            return 65535.0;
        default:
            return 255.0;
    }
}

double rounded_to(ScalarType integer_type, double value) {
    if (std::isnan(value)) return 0.0;
    const ScalarRange range = range_of(integer_type);
    return std::clamp(std::round(value), range.min, range.max);
}

// By the bits that a float lacks: gcc 12's optimizer removes conversions to float and back from
// some vectorized code.
bool is_float(double value) {
    constexpr std::uint64_t kBitsBeyondFloat = (std::uint64_t{1} << 29) - 1;
    if ((bits_as<std::uint64_t>(value) & kBitsBeyondFloat) != 0) return false;
    const double magnitude = std::abs(value);
    return magnitude == 0.0 || (magnitude >= std::numeric_limits<float>::min() &&
                                magnitude <= std::numeric_limits<float>::max());
}

}  // namespace lissom
