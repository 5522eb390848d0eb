#include "bindings/lua/sandbox/folder_rights.h"

#include <chrono>
#include <string>
#include <system_error>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"
#include "kernel/io/stream/file_error.h"

namespace lissom::lua {
namespace {

namespace fs = std::filesystem;

// The path from the root on, with links followed as far as it exists; empty if it fails.
fs::path real_path(const fs::path& path) {
    std::error_code failed;
    const fs::path whole = path.empty() ? fs::path() : fs::absolute(path, failed);
    if (failed || whole.empty()) return {};
    const fs::path real = fs::weakly_canonical(whole, failed);
    return failed ? fs::path() : real;
}

bool is_below(const fs::path& real, const fs::path& folder) {
    const fs::path place = real.lexically_relative(real_path(folder));
    return !place.empty() && *place.begin() != "..";
}

bool is_below_any(const fs::path& path, const std::vector<fs::path>& folders) {
    const fs::path real = real_path(path);
    if (real.empty()) return false;
    for (const fs::path& folder : folders) {
        if (is_below(real, folder)) return true;
    }
    return false;
}

// Times of files may lag behind the clock by this.
constexpr auto kClockStep = std::chrono::milliseconds(20);

// Bytes of the files below a folder that were written since `time`.
std::size_t bytes_since(const fs::path& folder, fs::file_time_type time) {
    std::size_t bytes = 0;
    std::error_code failed, unknown;
    for (fs::recursive_directory_iterator at(folder, failed), end; !failed && at != end;
         at.increment(failed)) {
        const bool is_new = at->is_regular_file(unknown) && at->last_write_time(unknown) >= time;
        if (is_new && !unknown) bytes += static_cast<std::size_t>(at->file_size(unknown));
    }
    return bytes;
}

// A link to a file that is not there yet leads anywhere.
bool is_open_link(const fs::path& path) {
    std::error_code failed;
    return fs::is_symlink(fs::symlink_status(path, failed)) && !fs::exists(path, failed);
}

}  // namespace

void FolderRights::check(const fs::path& path, FileUse use) {
    const bool reads = use == FileUse::read;
    if (reads && path.extension() == ".lua" && is_below_any(path, modules_)) return;
    const std::vector<fs::path>& folders = reads ? read_ : write_;
    if (!is_below_any(path, folders) || (!reads && is_open_link(path))) {
        const std::string file = display_name(path);
        throw FileError(reads ? ErrorCode::file_unreadable : ErrorCode::file_write_failed, file,
                        file + ": the script may not " + (reads ? "read" : "write") +
                            " here; the host says below which folders it may");
    }
    if (reads) return;
    count_written();
    if (max_bytes_ != 0 && bytes_ > max_bytes_) {
        throw Error(ErrorCode::file_write_failed,
                    display_name(path) + ": the script has written as much as it may, " +
                        std::to_string(max_bytes_) + " bytes");
    }
    pending_ = path;
    asked_ = std::filesystem::file_time_type::clock::now() - kClockStep;
}

void FolderRights::count_written() {
    std::error_code failed;
    const fs::path path = std::exchange(pending_, {});
    if (path.empty()) return;
    if (fs::is_directory(path, failed)) {
        bytes_ += bytes_since(path, asked_);
        return;
    }
    const auto size = fs::file_size(path, failed);
    if (!failed) bytes_ += static_cast<std::size_t>(size);
}

bool FolderRights::count_output(std::size_t bytes) {
    bytes_ += bytes;
    return max_bytes_ == 0 || bytes_ <= max_bytes_;
}

}  // namespace lissom::lua
