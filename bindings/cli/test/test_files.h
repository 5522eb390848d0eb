/// Finds files of tests.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lissom::cli {

/// Returns the test files that `paths` name, each once, in the order of the paths and sorted below
/// a folder. In a folder and below it these are *_test.lua, and below a folder called `scenes`
/// every script that calls `test`: others there are recordings. Skips hidden files and folders.
/// Throws Error file_not_found for a missing path.
std::vector<std::filesystem::path> find_test_files(const std::vector<std::string>& paths);

}  // namespace lissom::cli
