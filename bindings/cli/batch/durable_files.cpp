#include "bindings/cli/batch/durable_files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>

#include "bindings/cli/process/process_number.h"
#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path) {
    throw Error(ErrorCode::file_write_failed, display_name(path) + ": " + std::strerror(errno));
}

bool write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(descriptor, text.data(), text.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return false;
        text.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
}

}  // namespace

FileIdentity file_identity(const fs::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
    const std::int64_t seconds = status.st_mtim.tv_sec;
    return {true, static_cast<std::uint64_t>(status.st_size),
            seconds * 1000000000 + status.st_mtim.tv_nsec, status.st_ino};
}

void flush_to_disk(const fs::path& path) {
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) fail(path);
    const bool is_flushed = fsync(descriptor) == 0;
    close(descriptor);
    if (!is_flushed) fail(path);
}

std::string process_name() {
    char host[256] = {};
    const bool has_name = gethostname(host, sizeof host - 1) == 0 && host[0];
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto started = std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
    return std::string(has_name ? host : "host") + "." + std::to_string(process_number()) + "." +
           std::to_string(started);
}

GrowingFile::~GrowingFile() {
    if (descriptor_ >= 0) close(descriptor_);
}

void GrowingFile::append(std::string_view text) {
    if (descriptor_ < 0) {
        descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    }
    if (descriptor_ < 0 || !write_all(descriptor_, text) || fdatasync(descriptor_) != 0) {
        fail(path_);
    }
}

FileLock::FileLock(const fs::path& path) {
    const int opened = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (opened < 0) fail(path);
    // Above the numbers that a process has for its channels (see ChildProcess).
    descriptor_ = fcntl(opened, F_DUPFD_CLOEXEC, 10);
    const int error = errno;
    close(opened);
    errno = error;
    if (descriptor_ < 0) fail(path);
}

FileLock::~FileLock() {
    close(descriptor_);
}

bool FileLock::take() {
    return flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
}

bool FileLock::share() {
    return flock(descriptor_, LOCK_SH | LOCK_NB) == 0;
}

void FileLock::write(std::string_view text) const {
    if (ftruncate(descriptor_, 0) == 0) write_all(descriptor_, text);
}

}  // namespace lissom::cli
