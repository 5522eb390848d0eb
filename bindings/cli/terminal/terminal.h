/// What the program knows of its terminal.
#pragma once

namespace lissom::cli {

/// Whether the standard error, or the standard input, is a terminal.
bool error_is_terminal();
bool input_is_terminal();

}  // namespace lissom::cli
