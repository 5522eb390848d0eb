/// Which files hold tests.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lissom::cli {

/// The files of tests that `paths` name, each once, in the order of the paths and sorted below a
/// folder. In a folder and those below it these are *_test.lua, and below a folder called `scenes`
/// every script that calls `test`: others there are recordings. Hidden files and folders are passed
/// over. Throws Error file_not_found for paths that do not exist.
std::vector<std::filesystem::path> find_test_files(const std::vector<std::string>& paths);

}  // namespace lissom::cli
