#include "bindings/cli/batch/staging.h"

#include <algorithm>
#include <fstream>
#include <set>

#include "bindings/cli/batch/durable_files.h"
#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

bool was_written(const JobRecord* before, const fs::path& file) {
    return before &&
           std::any_of(before->outputs.begin(), before->outputs.end(),
                       [&](const FileStamp& stamp) { return stamp.path == file.string(); });
}

void move_file(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error) {
        throw Error(ErrorCode::file_write_failed, display_name(to) + ": " + error.message());
    }
}

// Files of the job's last run that this one has not made.
void remove_others(const JobRecord* before, const std::vector<FileStamp>& made) {
    if (!before) return;
    std::set<std::string> kept;
    for (const FileStamp& stamp : made) kept.insert(stamp.path);
    for (const FileStamp& stamp : before->outputs) {
        std::error_code ignored;
        if (!kept.contains(stamp.path)) fs::remove(stamp.path, ignored);
    }
}

}  // namespace

Staging::Staging(fs::path work, const fs::path& output, bool makes_folder, SpareFolders& spares)
    : work_(std::move(work)), output_(output), spares_(spares) {
    std::error_code ignored;
    fs::remove_all(work_, ignored);
    if (!spares_.give(work_)) make_folder(work_);
    if (makes_folder) make_folder(this->output());
}

Staging::~Staging() {
    if (is_published_ && spares_.keep(work_)) return;
    std::error_code ignored;
    fs::remove_all(work_, ignored);
}

std::vector<fs::path> Staging::files() const {
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(work_)) {
        if (!entry.is_regular_file()) continue;
        const bool is_held =
            entry.file_size() == 0 && held_.contains(entry.path().lexically_relative(work_));
        if (!is_held) found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    // The output is last: if it is there, all that belongs to it is.
    std::stable_partition(found.begin(), found.end(),
                          [this](const fs::path& file) { return file != output(); });
    return found;
}

void Staging::require_output() const {
    std::error_code error;
    const bool is_made = fs::is_directory(output(), error) ? !fs::is_empty(output(), error)
                                                           : fs::is_regular_file(output(), error);
    if (is_made) return;
    throw Error(ErrorCode::file_not_found,
                "the script ended well and made no " + output_.filename().string() +
                    ": it must write to the path that its parameter gives");
}

void Staging::hold(const std::set<fs::path>& names) {
    held_ = names;
    for (const fs::path& name : names) {
        make_folder((work_ / name).parent_path());
        std::ofstream(work_ / name, std::ios::binary).flush();
    }
}

fs::path Staging::place_of(const fs::path& staged) const {
    const fs::path folder = output_.parent_path().empty() ? "." : output_.parent_path();
    return (folder / staged.lexically_relative(work_)).lexically_normal();
}

bool Staging::is_taken(const fs::path& staged, const JobRecord* before,
                       FileDigests& digests) const {
    std::error_code error;
    const fs::path place = place_of(staged);
    if (fs::is_directory(place, error)) {
        throw Error(ErrorCode::file_is_directory,
                    display_name(place) + " is a folder: remove it, or choose another --out");
    }
    const bool is_own = place == output_ || was_written(before, place) ||
                        place.string().starts_with(output_.string() + "/");
    if (is_own || !fs::exists(place, error)) return false;
    return digests.stamp(place).digest != digests.stamp(staged).digest;
}

void Staging::require_places(const std::vector<fs::path>& staged, const JobRecord* before,
                             FileDigests& digests) {
    for (const fs::path& file : staged) {
        if (is_taken(file, before, digests)) taken_.insert(file.lexically_relative(work_));
    }
    if (taken_.empty()) return;
    throw Error(ErrorCode::file_write_failed,
                display_name(place_of(work_ / *taken_.begin())) +
                    " exists with other content, of another job or not of this "
                    "batch: give each job a folder, as --out 'out/{n}/FILE'");
}

std::vector<FileStamp> Staging::publish(const JobRecord* before, FileDigests& digests,
                                        std::set<fs::path>& folders) {
    require_output();
    std::vector<FileStamp> made;
    const std::vector<fs::path> staged = files();
    require_places(staged, before, digests);
    for (const fs::path& file : staged) {
        const fs::path place = place_of(file);
        const fs::path place_folder = place.parent_path().empty() ? "." : place.parent_path();
        if (!folders.contains(place_folder)) make_folder(place_folder);
        flush_to_disk(file);
        move_file(file, place);
        folders.insert(place_folder);
        made.push_back(digests.stamp(place));
    }
    remove_others(before, made);
    is_published_ = true;
    return made;
}

}  // namespace lissom::cli
