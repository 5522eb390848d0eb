#include "kernel/io/stream/file.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <random>
#include <system_error>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/core/nearest.h"
#include "kernel/io/stream/file_error.h"
#include "kernel/io/stream/open_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#ifdef _WIN32
#include <io.h>
#else
#include <sys/file.h>
#include <unistd.h>
#endif

namespace lissom {
namespace {

namespace fs = std::filesystem;

// Between two pieces of this size, reading and writing can be cancelled.
constexpr std::size_t kPieceBytes = std::size_t{8} << 20;

[[noreturn]] void refuse(ErrorCode code, const fs::path& path, const std::string& what) {
    const std::string file = display_name(path);
    throw FileError(code, file, file + ": " + what);
}

[[noreturn]] void refuse_write(const fs::path& path, const std::error_code& reason) {
    refuse(ErrorCode::file_write_failed, path,
           "could not be written: " + reason.message() + "; the old content is untouched");
}

std::error_code last_error() {
    return {errno, std::generic_category()};
}

std::FILE* open_new(const fs::path& path) {
#ifdef _WIN32
    // The older C library there does not know the mode "x".
    const int descriptor =
        _wopen(path.c_str(), _O_CREAT | _O_EXCL | _O_WRONLY | _O_BINARY, _S_IREAD | _S_IWRITE);
    return descriptor < 0 ? nullptr : _fdopen(descriptor, "wb");
#else
    return std::fopen(path.c_str(), "wbx");
#endif
}

bool flush_to_disk(std::FILE* file) {
    if (std::fflush(file) != 0) return false;
#ifdef _WIN32
    return _commit(_fileno(file)) == 0;
#else
    return fsync(fileno(file)) == 0;
#endif
}

// A path with a zero byte would name another file: the system reads it up to there.
void require_no_zero(ErrorCode code, const fs::path& path) {
    if (path.native().find(fs::path::value_type{}) == fs::path::string_type::npos) return;
    const std::string name = display_name(path);
    throw Error(code, "the path has a zero byte after '" + name.substr(0, name.find('\0')) +
                          "'; remove it");
}

void require_name(ErrorCode code, const fs::path& path) {
    require_no_zero(code, path);
    if (path.empty()) throw Error(code, "the path is empty; name a file");
}

// Makes a rename in `folder` durable. Not every file system can; the new content is in place
// anyway.
void flush_folder([[maybe_unused]] const fs::path& folder) {
#ifndef _WIN32
    const int descriptor = open(folder.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return;
    fsync(descriptor);
    close(descriptor);
#endif
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// Returns whether a path lies below a folder; both are from the root on, without links.
bool is_within(const fs::path& path, const fs::path& folder) {
    const auto [rest, path_rest] =
        std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return rest == folder.end() || (rest->empty() && std::next(rest) == folder.end());
}

constexpr std::string_view kTemporaryBegin = ".lissom-", kTemporaryEnd = ".tmp";

bool is_temporary_name(const std::string& name) {
    if (!name.starts_with(kTemporaryBegin) || !name.ends_with(kTemporaryEnd)) return false;
    const std::size_t begin = kTemporaryBegin.size(), end = name.size() - kTemporaryEnd.size();
    return begin < end && name.find_first_not_of("0123456789", begin) == end;
}

#ifndef _WIN32

// Marks the file as one being written: the lock ends with the process. False if the file was taken
// for a left over one before. Not every file system has locks.
bool lock_new(std::FILE* file) {
    if (flock(fileno(file), LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
    struct stat status {};
    return fstat(fileno(file), &status) == 0 && status.st_nlink > 0;
}

// Holds the lock of a file on, when the file is closed.
class HeldLock {
  public:
    explicit HeldLock(std::FILE* file) : descriptor_(fcntl(fileno(file), F_DUPFD_CLOEXEC, 0)) {}
    HeldLock(const HeldLock&) = delete;
    HeldLock& operator=(const HeldLock&) = delete;
    ~HeldLock() {
        if (descriptor_ >= 0) close(descriptor_);
    }

  private:
    int descriptor_;
};

// Returns whether the file belongs to this user and no process writes it: a leftover of a killed
// process.
bool is_left_over(int descriptor) {
    struct stat status {};
    return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
           status.st_uid == geteuid() && flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

void remove_left_over(const fs::path& path) {
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0) return;
    std::error_code ignored;
    if (is_left_over(descriptor)) fs::remove(path, ignored);
    close(descriptor);
}

#else

bool lock_new(std::FILE*) {
    return true;
}

struct HeldLock {
    explicit HeldLock(std::FILE*) {}
    ~HeldLock() {}
};

// An open file cannot be removed there.
void remove_left_over(const fs::path& path) {
    std::error_code ignored;
    fs::remove(path, ignored);
}

#endif

// A new file next to the one it replaces. Unless it has replaced it, it is removed in the end.
class TemporaryFile {
  public:
    explicit TemporaryFile(const fs::path& target) : target_(target) {
        constexpr int kAttempts = 16;
        std::error_code reason;
        for (int i = 0; i < kAttempts && !file_; ++i) {
            if (!open_file(reason)) refuse_write(target_, reason);
        }
        if (!file_) refuse_write(target_, reason);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (file_) std::fclose(file_);
        std::error_code ignored;
        if (!replaced_) fs::remove(path_, ignored);
    }

    void write(std::string_view bytes) {
        if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(last_error());
    }

    void take_permissions(fs::perms permissions) {
        std::error_code error;
#ifdef _WIN32
        fs::permissions(path_, permissions, error);
#else
        // By the open file: a sandbox refuses the change of rights by names.
        if (fchmod(fileno(file_), static_cast<mode_t>(permissions)) != 0) error = last_error();
#endif
        if (error) fail(error);
    }

    void replace_target() {
        if (!flush_to_disk(file_)) fail(last_error());
        // Until it has its name, it must not look as if it were left over.
        const HeldLock lock(file_);
        if (std::fclose(std::exchange(file_, nullptr)) != 0) fail(last_error());
        std::error_code error;
        fs::rename(path_, target_, error);
        if (error) fail(error);
        replaced_ = true;
        flush_folder(folder_of(target_));
    }

  private:
    // Tries one name; false if no other can do better.
    bool open_file(std::error_code& reason) {
        std::random_device random;
        path_ = folder_of(target_) / (std::string(kTemporaryBegin) + std::to_string(random()) +
                                      std::string(kTemporaryEnd));
        file_ = open_new(path_);
        reason = last_error();
        if (!file_) return reason == std::errc::file_exists;
        if (!lock_new(file_)) std::fclose(std::exchange(file_, nullptr));
        return true;
    }

    [[noreturn]] void fail(const std::error_code& reason) const {
        refuse_write(target_, reason);
    }

    fs::path target_, path_;
    std::FILE* file_ = nullptr;
    bool replaced_ = false;
};

std::uintmax_t size_of_file(const fs::path& path) {
    std::error_code error;
    const auto size = fs::file_size(path, error);
    if (error) refuse(ErrorCode::file_unreadable, path, "cannot be read: " + error.message());
    return size;
}

// The file that `path` stands for once symbolic links are followed; it need not exist.
fs::path follow_links(fs::path path) {
    constexpr int kMaximumLinks = 40;
    std::error_code error;
    for (int i = 0; i < kMaximumLinks; ++i) {
        if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
        const fs::path target = fs::read_symlink(path, error);
        if (error) refuse_write(path, error);
        path = target.is_absolute() ? target : path.parent_path() / target;
    }
    refuse_write(path, std::make_error_code(std::errc::too_many_symbolic_link_levels));
}

void require_replaceable(const fs::path& path, const fs::file_status& status) {
    if (fs::is_directory(status)) {
        refuse(ErrorCode::file_is_directory, path, "is a folder; add the file's name");
    }
    if (!fs::is_regular_file(status)) {
        refuse(ErrorCode::file_write_failed, path, "is not a regular file, so it is not replaced");
    }
    constexpr fs::perms kAnyWrite =
        fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write;
    if ((status.permissions() & kAnyWrite) == fs::perms::none) {
        refuse(ErrorCode::file_write_failed, path, "is read-only, so it is not replaced");
    }
}

// Returns the names of files, or of folders only; at most the first of a very large folder.
std::vector<std::string> names_in(const fs::path& folder, bool folders) {
    constexpr std::size_t kMaxNames = 20000;
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        std::error_code unknown;
        if (at->is_directory(unknown) != folders) continue;
        names.push_back(display_name(at->path().filename()));
        if (names.size() == kMaxNames) break;
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::string nearest_in(const fs::path& path, bool folders) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const std::vector<std::string> names = names_in(folder, folders);
    const std::string_view nearest = nearest_name(
        display_name(path.filename()), std::vector<std::string_view>(names.begin(), names.end()));
    if (nearest.empty()) return "";
    return ", did you mean '" +
           display_name(path.parent_path() / std::u8string(nearest.begin(), nearest.end())) + "'?";
}

// Content that the host gives piece by piece is charged first, each time that the room doubles.
FileContent read_by_host(const fs::path& path, const Context& context) {
    context.checkpoint();
    FileContent content;
    const auto take = [&](std::string_view piece) {
        const std::size_t size = content.bytes.size() + piece.size();
        if (size > content.bytes.capacity()) {
            const std::size_t room = std::max(size, 2 * content.bytes.size());
            content.charge = context.charge(room, "reading " + display_name(path));
            content.bytes.reserve(room);
        }
        content.bytes.append(piece);
    };
    if (!context.files().read(display_name(path), take)) {
        refuse(ErrorCode::file_not_found, path, "the host has no such file");
    }
    if (content.bytes.empty()) refuse(ErrorCode::file_empty, path, "the file is empty");
    return content;
}

void write_by_host(const fs::path& path, std::string_view bytes, const Context& context) {
    context.checkpoint();
    if (context.files().write(display_name(path), bytes)) return;
    refuse(ErrorCode::file_write_failed, path, "the host cannot write the file");
}

}  // namespace

std::string missing_file_text(const fs::path& path) {
    std::error_code error;
    if (fs::is_symlink(path, error)) {
        return "is a link to '" + display_name(fs::read_symlink(path, error)) +
               "', which is not there";
    }
    const fs::path folder = path.parent_path();
    if (folder.empty() || fs::exists(folder, error)) {
        return "there is no such file" + nearest_in(path, false);
    }
    return "there is no folder '" + display_name(folder) + "'" + nearest_in(folder, true);
}

std::string display_name(const fs::path& path) {
    const auto utf8 = path.u8string();
    return {utf8.begin(), utf8.end()};
}

void require_file(const fs::path& path, const Context& context) {
    require_name(ErrorCode::file_not_found, path);
    if (context.files().read) return;
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) {
        refuse(ErrorCode::file_not_found, path, missing_file_text(path));
    }
    if (fs::is_directory(status)) {
        refuse(ErrorCode::file_is_directory, path, "is a folder; add the file's name");
    }
    if (error) refuse(ErrorCode::file_unreadable, path, "cannot be read: " + error.message());
    if (!fs::is_regular_file(status)) {
        refuse(ErrorCode::file_unreadable, path, "is not a regular file");
    }
    if (size_of_file(path) == 0) refuse(ErrorCode::file_empty, path, "the file is empty");
}

void require_folder_of(const fs::path& path, const Context& context) {
    require_name(ErrorCode::file_write_failed, path);
    if (context.files().write) return;
    std::error_code error;
    const fs::path folder = folder_of(path);
    if (fs::is_directory(folder, error)) return;
    const bool is_file = fs::exists(folder, error);
    refuse(ErrorCode::file_write_failed, path,
           "could not be written: " + std::string(is_file ? "'" : "there is no folder '") +
               display_name(folder) + (is_file ? "' is not a folder" : "'; make it first"));
}

void make_folder(const fs::path& path) {
    require_no_zero(ErrorCode::file_write_failed, path);
    std::error_code error;
    if (path.empty() || fs::is_directory(path, error)) return;
    fs::create_directories(path, error);
    if (!error && fs::is_directory(path, error)) return;
    refuse(ErrorCode::file_write_failed, path,
           "the folder cannot be made: " +
               (error ? error : std::make_error_code(std::errc::file_exists)).message());
}

fs::path path_within(const fs::path& folder, const fs::path& name) {
    require_no_zero(ErrorCode::unsafe_path, name);
    std::error_code failed;
    const fs::path real = fs::weakly_canonical(fs::absolute(folder / name, failed), failed);
    const fs::path base = fs::weakly_canonical(fs::absolute(folder, failed), failed);
    if (!failed && is_within(real, base)) return real;
    refuse(ErrorCode::unsafe_path, folder / name,
           "leads out of its folder; copy the file that it stands for into the folder");
}

std::ifstream open_to_read(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    if (stream) return stream;
    refuse(ErrorCode::file_unreadable, path, "cannot be read: " + last_error().message());
}

std::size_t addressable_size(const fs::path& path) {
    const std::uintmax_t size = size_of_file(path);
    if (size > std::string().max_size()) {
        refuse(ErrorCode::file_too_large, path,
               "has " + std::to_string(size) +
                   " bytes, more than a program of 32 bits can address; use one of 64 bits");
    }
    return static_cast<std::size_t>(size);
}

FileContent read_file(const fs::path& path, const Context& context) {
    require_file(path, context);
    if (context.files().read) return read_by_host(path, context);
    std::ifstream stream = open_to_read(path);
    const std::size_t size = addressable_size(path);
    FileContent content;
    content.charge = context.charge(size, "reading " + display_name(path));
    content.bytes.resize(size);
    for (std::size_t done = 0; done < size;) {
        context.checkpoint();
        const std::size_t piece = std::min(kPieceBytes, size - done);
        if (!stream.read(content.bytes.data() + done, static_cast<std::streamsize>(piece))) {
            refuse(ErrorCode::file_unreadable, path, "reading stopped before the end of the file");
        }
        done += piece;
    }
    return content;
}

void remove_left_overs(const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const fs::path& path = entry->path();
        if (is_temporary_name(display_name(path.filename()))) remove_left_over(path);
    }
}

void write_file_atomically(const fs::path& path, std::string_view bytes, const Context& context) {
    require_no_zero(ErrorCode::file_write_failed, path);
    if (context.files().write) return write_by_host(path, bytes, context);
    const fs::path target = follow_links(path);
    require_folder_of(target);
    std::error_code ignored;
    const fs::file_status status = fs::status(target, ignored);
    const bool exists = fs::exists(status);
    if (exists) require_replaceable(path, status);

    // Permissions come first: private content shall not be open to others while it is written.
    TemporaryFile file(target);
    if (exists) file.take_permissions(status.permissions());
    Progress progress(context, "write file");
    for (std::size_t done = 0; done < bytes.size(); done += kPieceBytes) {
        progress.update(done, bytes.size());
        file.write(bytes.substr(done, kPieceBytes));
    }
    progress.update(1.0);
    file.replace_target();
    remove_left_overs(folder_of(target));
}

}  // namespace lissom
