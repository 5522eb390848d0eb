/// Rights of a script to read and write files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "bindings/lua/core/state.h"

namespace lissom::lua {

/// Folders as they are when a script asks: links are followed first. Adds up the written bytes.
class FolderRights {
  public:
    /// Only Lua files of the folders `modules` may be read.
    FolderRights(std::vector<std::filesystem::path> read, std::vector<std::filesystem::path> write,
                 std::vector<std::filesystem::path> modules, std::size_t max_bytes)
        : read_(std::move(read)),
          write_(std::move(write)),
          modules_(std::move(modules)),
          max_bytes_(max_bytes) {}

    /// Errors: file_unreadable, file_write_failed: the path is outside of the folders, or enough
    /// was written.
    void check(const std::filesystem::path& path, FileUse use);
    /// Counts `bytes` of other output. Returns false if it is too much.
    bool count_output(std::size_t bytes);

  private:
    void count_written();

    std::vector<std::filesystem::path> read_, write_, modules_;
    // The file or folder that was asked for last, and when: its size is not known before the next
    // question.
    std::filesystem::path pending_;
    std::filesystem::file_time_type asked_ = {};
    std::size_t max_bytes_, bytes_ = 0;
};

}  // namespace lissom::lua
