/// Helpers shared by the unit tests.
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "kernel/core/error.h"

namespace lissom::test {

/// Path of a real mesh below the test data, or nothing where the data is absent: the test then says
/// so and returns.
///
///     const auto path = data_file("models/lion.off");
///     if (!path) return;
inline std::optional<std::filesystem::path> data_file(const std::string& name) {
    const char* root = std::getenv("LISSOM_TEST_DATA");
    const std::filesystem::path path = std::filesystem::path(root ? root : ".") / name;
    if (root && std::filesystem::exists(path)) return path;
    MESSAGE("skipped: test data " << name << " is absent");
    return std::nullopt;
}

/// Runs `action` and returns the error it throws; fails where it throws none.
template <typename Action>
Error error_of(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error;
    }
    FAIL("no error was thrown");
    return {ErrorCode::internal, ""};
}

}  // namespace lissom::test
