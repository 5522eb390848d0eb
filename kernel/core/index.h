/// Numbers of elements.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lissom {

/// Index of a vertex, face, corner or matrix row; 0-based, never negative in valid data.
using Index = std::int32_t;

/// Stands for "no element" in maps between element sets.
inline constexpr Index kNoIndex = -1;

/// A valid index as the position in a container.
constexpr std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

}  // namespace lissom
