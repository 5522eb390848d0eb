/// Other programs of the system.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lissom::cli {

/// End of a command.
struct CommandEnd {
    int status = 0;
    /// Text of its standard output and of its errors.
    std::string output, errors;
};

/// Runs a program that is found by PATH, with nothing to read, and waits for its end. Returns
/// nothing if there is no such program.
std::optional<CommandEnd> run_command(const std::vector<std::string>& words);

}  // namespace lissom::cli
