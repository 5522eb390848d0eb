/// Lines that were typed, kept in a file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace lissom::cli {

/// The last thousand lines, the oldest first. The file has a line each; several programs may add to
/// it. Lines that cannot be written are kept for this run.
class History {
  public:
    static constexpr std::size_t kMaxLines = 1000;

    /// Reads the file; an empty path is no file.
    explicit History(std::filesystem::path file);

    std::size_t size() const { return lines_.size(); }
    const std::string& line(std::size_t i) const { return lines_[i]; }

    /// Adds a line, to the file as well, unless it is empty or that before it: then returns false.
    bool add(const std::string& line);
    /// Shortens the file to the lines that are kept.
    void shorten_file() const;

  private:
    std::filesystem::path file_;
    std::vector<std::string> lines_;
};

}  // namespace lissom::cli
