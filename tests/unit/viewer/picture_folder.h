/// A folder for the pictures of one test, and whether this machine can draw any.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "tests/unit/viewer/viewer_support.h"

namespace lissom::test {

class PictureFolder {
  public:
    PictureFolder() {
        path_ = std::filesystem::temp_directory_path() /
                ("lissom-picture-" + std::to_string(std::random_device{}()));
        std::filesystem::create_directories(path_);
    }
    PictureFolder(const PictureFolder&) = delete;
    PictureFolder& operator=(const PictureFolder&) = delete;
    ~PictureFolder() { std::filesystem::remove_all(path_); }

    std::string path(const std::string& name) const { return (path_ / name).generic_string(); }

    std::string read(const std::string& name) const {
        std::ifstream file(path_ / name, std::ios::binary);
        std::ostringstream bytes;
        bytes << file.rdbuf();
        return bytes.str();
    }

    std::vector<std::string> names() const {
        std::vector<std::string> list;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) {
            list.push_back(entry.path().filename().string());
        }
        std::sort(list.begin(), list.end());
        return list;
    }

  private:
    std::filesystem::path path_;
};

/// Says so, by the test's name, where this machine cannot draw.
inline bool can_draw() {
    return make_renderer() != nullptr;
}

}  // namespace lissom::test
