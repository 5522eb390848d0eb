/// Properties of the program's terminal.
#pragma once

#include <cstddef>
#include <optional>

namespace lissom::cli {

/// Return whether the standard error, or the standard input, is a terminal.
bool error_is_terminal();
bool input_is_terminal();

/// Returns the cells of a row of the terminal; 80 if it does not say.
std::size_t terminal_columns();

/// Input from the terminal: a byte, nothing in time, or its end.
struct TypedByte {
    std::optional<char> byte = {};
    bool ended = false;
};

/// Returns the next byte, waiting for it at most so long.
TypedByte read_terminal(int milliseconds);

}  // namespace lissom::cli
