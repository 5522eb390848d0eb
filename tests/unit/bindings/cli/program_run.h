/// Runs the program within a test.
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "bindings/cli/program.h"

namespace lissom::test {

struct Ended {
    int status;
    std::string out, err;
};

/// Runs the program in this process with its streams caught.
inline Ended run_program(std::vector<std::string> words) {
    words.insert(words.begin(), "lissom");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    std::ostringstream out, err;
    std::streambuf* const old_out = std::cout.rdbuf(out.rdbuf());
    std::streambuf* const old_err = std::cerr.rdbuf(err.rdbuf());
    const int status =
        cli::run_program(static_cast<int>(argv.size()), argv.data(), cli::kernel_parts());
    std::cout.rdbuf(old_out);
    std::cerr.rdbuf(old_err);
    return {status, out.str(), err.str()};
}

/// A folder that goes with the test.
class ProgramFolder {
  public:
    ProgramFolder() : path_(std::filesystem::temp_directory_path() / unique_name()) {
        std::filesystem::create_directories(path_);
    }
    ProgramFolder(const ProgramFolder&) = delete;
    ProgramFolder& operator=(const ProgramFolder&) = delete;
    ~ProgramFolder() { std::filesystem::remove_all(path_); }

    /// Writes a file, and the folders that it needs; returns its path.
    std::string write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << text;
        return (path_ / name).string();
    }
    std::string path(const std::string& name) const { return (path_ / name).string(); }
    bool has(const std::string& name) const { return std::filesystem::exists(path_ / name); }

  private:
    static std::string unique_name() {
        return "lissom_program_test_" +
               std::to_string(std::chrono::steady_clock::now().time_since_epoch().count());
    }
    std::filesystem::path path_;
};

}  // namespace lissom::test
