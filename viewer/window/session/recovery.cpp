#include "viewer/window/session/recovery.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string>
#include <utility>

#include "bindings/cli/process/process_number.h"

namespace lissom::window {
namespace {

namespace fs = std::filesystem;

// recovery-PROCESS.lissom is the copy of a window's scene; unsaved scenes are kept as
// unsaved-PROCESS.lissom and unsaved-PROCESS-2.lissom and so on.
constexpr std::string_view kCopy = "recovery-", kUnsaved = "unsaved-", kSuffix = ".lissom";

// The process whose scene a file is; 0 for other files.
long owner_of(const fs::path& path) {
    std::string name = path.filename().string();
    const bool is_unsaved = name.starts_with(kUnsaved);
    if (!name.ends_with(kSuffix) || !(is_unsaved || name.starts_with(kCopy))) return 0;
    name.resize(name.size() - kSuffix.size());
    name.erase(0, is_unsaved ? kUnsaved.size() : kCopy.size());
    long number = 0;
    const char* const end = name.data() + name.size();
    const auto [read, error] = std::from_chars(name.data(), end, number);
    return error == std::errc() && (read == end || (is_unsaved && *read == '-')) ? number : 0;
}

// The journal of a copy.
fs::path beside(fs::path copy) {
    return copy.replace_extension(".lua");
}

}  // namespace

Recovery::Recovery(fs::path folder) : folder_(std::move(folder)) {}

Recovery::~Recovery() {
    if (std::uncaught_exceptions() == exceptions_) remove(file());
}

fs::path Recovery::file() const {
    std::error_code error;
    fs::create_directories(folder_, error);
    return folder_ /
           (std::string(kCopy) + std::to_string(cli::process_number()) + std::string(kSuffix));
}

fs::path Recovery::journal() const {
    return beside(file());
}

fs::path Recovery::keep() const {
    const std::string name = std::string(kUnsaved) + std::to_string(cli::process_number());
    std::error_code error;
    fs::path kept = folder_ / (name + std::string(kSuffix));
    for (int number = 2; fs::exists(kept, error); ++number) {
        kept = folder_ / (name + "-" + std::to_string(number) + std::string(kSuffix));
    }
    fs::rename(file(), kept, error);
    if (error) return {};
    fs::rename(journal(), beside(kept), error);
    return kept;
}

fs::path Recovery::journal_of(const fs::path& copy) {
    std::error_code error;
    return fs::exists(beside(copy), error) ? beside(copy) : fs::path();
}

void Recovery::remove(const fs::path& copy) {
    std::error_code error;
    fs::remove(copy, error);
    fs::remove(beside(copy), error);
}

std::vector<fs::path> Recovery::left_in(const fs::path& folder) {
    std::vector<std::pair<fs::file_time_type, fs::path>> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const long owner = owner_of(entry.path());
        if (owner == 0 || cli::process_runs(owner)) continue;
        found.emplace_back(entry.last_write_time(error), entry.path());
    }
    std::sort(found.rbegin(), found.rend());
    std::vector<fs::path> paths;
    for (auto& one : found) paths.push_back(std::move(one.second));
    return paths;
}

fs::path state_folder() {
    const char* const state = std::getenv("XDG_STATE_HOME");
    if (state && *state) return fs::path(state) / "lissom";
    const char* const home = std::getenv("HOME");
    if (home && *home) return fs::path(home) / ".local" / "state" / "lissom";
    std::error_code error;
    return fs::temp_directory_path(error) / "lissom";
}

}  // namespace lissom::window
