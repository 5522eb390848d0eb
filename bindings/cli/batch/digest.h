/// Digests of contents: 128 bits that differ for contents that differ (XXH3).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <tuple>

namespace lissom::cli {

/// A file as it was when its content was read.
struct FileStamp {
    std::string path;
    std::uint64_t size = 0;
    /// Of its last change, in nanoseconds.
    std::int64_t time = 0;
    std::uint64_t inode = 0;
    /// 32 hexadecimal digits; empty for a file that cannot be read.
    std::string digest;
};

/// Returns the digest of a text.
std::string text_digest(std::string_view text);

/// Digests of files. A file whose size, time and inode are known is not read again.
class FileDigests {
  public:
    /// Tells a digest that was found before.
    void know(const FileStamp& stamp);
    /// Returns the stamp of a file as it is now.
    FileStamp stamp(const std::filesystem::path& file);

  private:
    using Identity = std::tuple<std::string, std::uint64_t, std::int64_t, std::uint64_t>;
    std::map<Identity, std::string> known_;
};

}  // namespace lissom::cli
