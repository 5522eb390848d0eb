/// Numbers as text and back, the same in every locale.
#pragma once

#include <charconv>
#include <type_traits>

namespace lissom {

/// Reads a decimal number, "inf" or "nan" at the beginning of [first, last), to the nearest value.
/// As std::from_chars: no blank or plus goes before it, the result names the end of what was read,
/// and `value` is left as it is after an error.
std::from_chars_result read_decimal(const char* first, const char* last, double& value);
std::from_chars_result read_decimal(const char* first, const char* last, float& value);

/// Writes a number in the fewest digits that read back equal; of several such texts the nearest,
/// and of fixed and scientific notation the shorter. As std::to_chars: no zero ends the text.
std::to_chars_result write_decimal(char* first, char* last, double value);
std::to_chars_result write_decimal(char* first, char* last, float value);

// libc++ has those of whole numbers alone.
#ifdef __cpp_lib_to_chars
inline constexpr bool kLibraryHasDecimals = true;
#else
inline constexpr bool kLibraryHasDecimals = false;
#endif

/// std::from_chars; for double read_decimal if the C++ library has none.
template <typename Number>
std::from_chars_result read_number(const char* first, const char* last, Number& value) {
    if constexpr (kLibraryHasDecimals || !std::is_floating_point_v<Number>) {
        return std::from_chars(first, last, value);
    } else {
        return read_decimal(first, last, value);
    }
}

/// std::to_chars; for double and float write_decimal if the C++ library has none.
template <typename Number>
std::to_chars_result write_number(char* first, char* last, Number value) {
    if constexpr (kLibraryHasDecimals || !std::is_floating_point_v<Number>) {
        return std::to_chars(first, last, value);
    } else {
        return write_decimal(first, last, value);
    }
}

}  // namespace lissom
