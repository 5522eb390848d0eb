/// Empty folders that are used again: a file system takes longer to make and remove one for each
/// job than to rename it.
#pragma once

#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

namespace lissom::cli {

class SpareFolders {
  public:
    /// Names of spare folders begin so.
    static constexpr std::string_view kName = "spare.";

    /// Keeps the folders in `folder`, which need not exist yet.
    explicit SpareFolders(std::filesystem::path folder) : folder_(std::move(folder)) {}
    /// Removes them.
    ~SpareFolders();
    SpareFolders(const SpareFolders&) = delete;
    SpareFolders& operator=(const SpareFolders&) = delete;

    /// Moves a spare folder to a place where nothing is. Returns false if there is none.
    bool give(const std::filesystem::path& place);
    /// Takes a folder that is empty; returns false for any other.
    bool keep(const std::filesystem::path& empty);

  private:
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> spare_;
};

}  // namespace lissom::cli
