/// Numbers of elements.
///
/// Elements are numbered by `Index`, which has a sign, so that "no element" and differences need no
/// care; containers count by std::size_t. One becomes the other by three functions and by nothing
/// else: `at` for the way into a container, `index_of` and `count_of` for the way out. Numbers from
/// a file are compared with their limits first.
#pragma once

#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace lissom {

/// Index of a vertex, face, corner or matrix row; 0-based, never negative in valid data.
using Index = std::int32_t;

/// Stands for "no element" in maps between element sets.
inline constexpr Index kNoIndex = -1;

/// A valid index, or a count of elements, as a position in a container or its size.
constexpr std::size_t at(std::signed_integral auto i) {
    return static_cast<std::size_t>(i);
}

/// A position in a container, or a number of elements, as an index: it must fit.
constexpr Index index_of(std::integral auto position) {
    assert(std::in_range<Index>(position));
    return static_cast<Index>(position);
}

/// Returns the number of elements of a container as an index.
template <typename Container>
constexpr Index count_of(const Container& container) {
    return index_of(container.size());
}

/// Two indices as one number: a key for an edge, that orders pairs.
constexpr std::uint64_t pair_key(Index first, Index second) {
    return std::uint64_t{static_cast<std::uint32_t>(first)} << 32 |
           static_cast<std::uint32_t>(second);
}

}  // namespace lissom
