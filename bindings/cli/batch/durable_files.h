/// Files that outlive a process that is killed, and locks that do not. All code of the platform
/// that a batch needs is in durable_files.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace lissom::cli {

/// Size, time of the last change in nanoseconds, and inode of a file.
struct FileIdentity {
    bool is_file = false;
    std::uint64_t size = 0;
    std::int64_t time = 0;
    std::uint64_t inode = 0;
};

FileIdentity file_identity(const std::filesystem::path& file);

/// Waits until the content of a file, or the names in a folder, are on the disk. Errors:
/// file_write_failed.
void flush_to_disk(const std::filesystem::path& path);

/// Name of this process among those of all machines: "HOST.PROCESS.STARTED".
std::string process_name();

/// A file that grows by whole texts, each on the disk when `append` returns.
class GrowingFile {
  public:
    /// The file is made by the first text.
    explicit GrowingFile(std::filesystem::path path) : path_(std::move(path)) {}
    ~GrowingFile();
    GrowingFile(const GrowingFile&) = delete;
    GrowingFile& operator=(const GrowingFile&) = delete;

    /// Errors: file_write_failed.
    void append(std::string_view text);

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
};

/// A lock on a file, which is made if it is missing. It holds until this object is destroyed and
/// every process has ended that was started with its descriptor.
class FileLock {
  public:
    /// Errors: file_write_failed.
    explicit FileLock(const std::filesystem::path& path);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

    /// Takes the lock if nobody has it.
    bool take();
    /// Takes a part of the lock, if nobody has all of it.
    bool share();
    /// Replaces the text in the file, which tells others who has the lock.
    void write(std::string_view text) const;
    int descriptor() const { return descriptor_; }

  private:
    int descriptor_ = -1;
};

}  // namespace lissom::cli
