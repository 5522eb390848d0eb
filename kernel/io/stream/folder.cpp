#include "kernel/io/stream/folder.h"

#include <algorithm>
#include <system_error>

#include "kernel/io/stream/file.h"
#include "kernel/io/stream/file_error.h"
#include "kernel/io/stream/open_file.h"

namespace lissom {
namespace {

namespace fs = std::filesystem;

// Folder of new files until all are written, and from then on until they have their names.
constexpr const char* kUnfinished = ".lissom-new";
constexpr const char* kFinished = ".lissom-ready";

[[noreturn]] void refuse_entry(const fs::path& path, const std::string& what) {
    const std::string file = display_name(path);
    throw FileError(ErrorCode::file_write_failed, file, file + ": " + what);
}

void require_done(const std::error_code& error, const fs::path& path) {
    if (error) refuse_entry(path, "could not be written: " + error.message());
}

// Throws for files that must not be replaced: files of others, and folders.
void require_place(const fs::path& folder, const std::string& name, const FolderChange& change) {
    std::error_code error;
    const fs::path path = folder / name;
    const fs::file_status status = fs::symlink_status(path, error);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        refuse_entry(path, "is not a regular file, so it is not replaced");
    }
    if (fs::exists(status) && !change.before.contains(name)) {
        refuse_entry(path,
                     "is there already and no part of the scene; move it away, or take "
                     "another folder");
    }
    for (fs::path above = path.parent_path(); above != folder; above = above.parent_path()) {
        const fs::file_status status_above = fs::symlink_status(above, error);
        if (fs::exists(status_above) && !fs::is_directory(status_above)) {
            refuse_entry(above, "is not a folder; move it away, or take another folder");
        }
    }
}

bool holds(const fs::path& path, const std::string& bytes) {
    std::error_code error;
    if (!fs::is_regular_file(path, error) || fs::file_size(path, error) != bytes.size() || error) {
        return false;
    }
    try {
        return bytes.empty() || read_file(path).bytes == bytes;
    } catch (const Error&) {
        return false;
    }
}

// Names below `folder`, with '/' between them.
std::vector<std::string> files_below(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_directory()) {
            names.push_back(entry.path().lexically_relative(folder).generic_string());
        }
    }
    return names;
}

// Returns whether the folder has a finished change; a link in its place is none.
bool has_finished(const fs::path& folder) {
    std::error_code error;
    return fs::is_directory(fs::symlink_status(folder / kFinished, error));
}

// The place of a file of the folder, if need be among those of a finished change.
fs::path place_in(const fs::path& folder, const std::string& name) {
    std::error_code error;
    const fs::path ready = fs::path(kFinished) / name;
    const bool is_ready = has_finished(folder) && fs::exists(folder / ready, error);
    return is_ready ? ready : fs::path(name);
}

// Gives the files of a finished change their names. Failures are left for the next time: readers
// see the new files all the same.
void settle(const fs::path& folder) {
    std::error_code error;
    const fs::path from = folder / kFinished;
    if (!has_finished(folder)) return;
    for (const std::string& name : files_below(from)) {
        path_within(folder, fs::path(name).parent_path());
        fs::create_directories((folder / name).parent_path(), error);
        fs::rename(from / name, folder / name, error);
        require_done(error, folder / name);
    }
    fs::remove_all(from, error);
}

void remove_with_empty_folders(const fs::path& folder, const std::string& name) {
    std::error_code error;
    fs::path path = folder / name;
    if (!fs::is_regular_file(fs::symlink_status(path, error))) return;
    fs::remove(path, error);
    for (path = path.parent_path(); path != folder && !error; path = path.parent_path()) {
        if (!fs::is_empty(path, error) || !fs::remove(path, error)) return;
    }
}

// Removes an unfinished change.
class Unfinished {
  public:
    explicit Unfinished(const fs::path& folder) : folder_(folder) {
        std::error_code error;
        made_ = fs::create_directory(folder, error);
        require_done(error, folder);
        fs::remove_all(path(), error);
        fs::create_directory(path(), error);
        if (error && made_) fs::remove(folder_);
        require_done(error, folder);
    }
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;
    ~Unfinished() {
        std::error_code ignored;
        if (!finished_) fs::remove_all(path(), ignored);
        if (!finished_ && made_) fs::remove(folder_, ignored);
    }

    fs::path path() const { return folder_ / kUnfinished; }
    void finish() {
        std::error_code error;
        fs::rename(path(), folder_ / kFinished, error);
        require_done(error, folder_);
        finished_ = true;
    }

  private:
    fs::path folder_;
    bool made_ = false, finished_ = false;
};

}  // namespace

void replace_in_folder(const fs::path& given, const FolderChange& change, const Context& context) {
    std::error_code error;
    const fs::path folder = given.has_filename() ? given : given.parent_path();
    require_folder_of(folder);
    if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
        refuse_entry(folder, "is a file; name a folder");
    }
    settle(folder);
    for (const auto& [name, bytes] : change.files) require_place(folder, name, change);
    Unfinished next(folder);
    for (const auto& [name, bytes] : change.files) {
        context.checkpoint();
        if (holds(folder / name, bytes)) continue;
        make_folder((next.path() / name).parent_path());
        write_file_atomically(next.path() / name, bytes, context);
    }
    next.finish();
    try {
        settle(folder);
    } catch (const Error&) {
        return;
    }
    for (const std::string& name : change.before) {
        if (!change.files.contains(name)) remove_with_empty_folders(folder, name);
    }
}

FileContent read_from_folder(const fs::path& folder, const std::string& name,
                             const Context& context) {
    const fs::path place = place_in(folder, name);
    path_within(folder, place);
    return read_file(folder / place, context);
}

bool has_in_folder(const fs::path& folder, const std::string& name) {
    std::error_code error;
    return fs::exists(folder / place_in(folder, name), error);
}

}  // namespace lissom
