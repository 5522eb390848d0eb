/// The bits of numbers, and memory that is not filled, where the C++ library has neither yet.
#pragma once

#include <bit>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace lissom {

/// Returns the object of type To that has the bits of `from`, as std::bit_cast, which libc++ lacks
/// before version 14.
template <typename To, typename From>
requires(sizeof(To) == sizeof(From)) constexpr To bits_as(const From& from) noexcept {
#ifdef __cpp_lib_bit_cast
    return std::bit_cast<To>(from);
#else
    return __builtin_bit_cast(To, from);
#endif
}

/// Returns `count` numbers that nothing is written to yet, as std::make_unique_for_overwrite, which
/// libc++ lacks before version 16.
template <typename Array>
requires std::is_unbounded_array_v<Array> std::unique_ptr<Array> unfilled(std::size_t count) {
    return std::unique_ptr<Array>(new std::remove_extent_t<Array>[count]);
}

}  // namespace lissom
