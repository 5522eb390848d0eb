/// Properties of the program's terminal.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

namespace lissom::cli {

/// Return whether the standard error, or the standard input, is a terminal.
bool error_is_terminal();
bool input_is_terminal();

/// Returns whether keys can be read one by one here (not on Windows), and whether the terminal
/// knows the escape sequences of a VT100.
bool terminal_sends_keys();
bool terminal_moves_cursor();

/// Returns the cells of a row of the terminal; 80 if it does not say.
std::size_t terminal_columns();

/// While it lives, keys are read as they are pressed and are not shown. Ctrl-C stays a signal.
class RawTerminal {
  public:
    RawTerminal();
    ~RawTerminal();
    RawTerminal(const RawTerminal&) = delete;
    RawTerminal& operator=(const RawTerminal&) = delete;

  private:
    struct State;
    std::unique_ptr<State> before_;
};

/// Input from the terminal: a byte, nothing in time, or its end.
struct TypedByte {
    std::optional<char> byte = {};
    bool ended = false;
};

/// Returns the next byte, waiting for it at most so long.
TypedByte read_terminal(int milliseconds);

}  // namespace lissom::cli
