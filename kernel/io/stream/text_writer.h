/// Appends numbers to text, the same in every locale; private to kernel/io.
#pragma once

#include <string>
#include <string_view>

#include "kernel/core/numbers/number_text.h"

namespace lissom {

/// Appends a number; a double in the shortest form that reads back equal.
template <typename Number>
void append_number(std::string& text, Number value) {
    char digits[32];
    const auto [stop, error] = write_number(digits, digits + sizeof(digits), value);
    text.append(digits, stop);
}

/// Appends a blank before each number.
template <typename Numbers>
void append_numbers(std::string& text, const Numbers& values) {
    for (const auto value : values) {
        text += ' ';
        append_number(text, value);
    }
}

/// `name` so that it can stand in one line: line ends and other control characters become '_', as
/// does a backslash at the end, which would join the next line.
std::string one_line(std::string_view name);

}  // namespace lissom
