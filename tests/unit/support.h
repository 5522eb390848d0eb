/// Helpers shared by the unit tests.
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "kernel/core/error.h"

namespace lissom::test {

/// Says that a test does nothing because `what` is absent; a failure where the environment has
/// `requirement`, as where everything that tests need is known to be there.
inline void skip(const char* requirement, const std::string& what) {
    if (std::getenv(requirement))
        FAIL(std::string(requirement) << " is set, and this is absent: " << what);
    MESSAGE("skipped: " << what);
}

/// Path of a real mesh below the test data, or nothing where the data is absent: the test then says
/// so and returns, or fails where LISSOM_REQUIRE_DATA is set.
///
///     const auto path = data_file("models/lion.off");
///     if (!path) return;
inline std::optional<std::filesystem::path> data_file(const std::string& name) {
    const char* root = std::getenv("LISSOM_TEST_DATA");
    const std::filesystem::path path = std::filesystem::path(root ? root : ".") / name;
    if (root && std::filesystem::exists(path)) return path;
    skip("LISSOM_REQUIRE_DATA", "test data " + path.string());
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
