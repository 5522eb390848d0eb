#include "viewer/window/session/file_watch.h"

#include <system_error>

namespace lissom::window {
namespace {

constexpr auto kEvery = std::chrono::milliseconds(250);
// After a change: how long nothing more must happen.
constexpr auto kSettled = std::chrono::milliseconds(30);

}  // namespace

FileWatch::Seen FileWatch::look(const std::filesystem::path& file) {
    std::error_code error;
    Seen seen;
    seen.time = std::filesystem::last_write_time(file, error);
    if (error) return {};
    seen.size = std::filesystem::file_size(file, error);
    return error ? Seen{} : seen;
}

void FileWatch::set(const std::vector<std::filesystem::path>& files) {
    std::map<std::filesystem::path, Seen> next;
    for (const auto& file : files) {
        const auto known = files_.find(file);
        next.emplace(file, known == files_.end() ? look(file) : known->second);
    }
    files_ = std::move(next);
}

bool FileWatch::changed(Clock::time_point now) {
    if (now - last_look_ < (unsettled_ ? kSettled : kEvery)) return false;
    last_look_ = now;
    bool differs = false;
    for (auto& [file, last] : files_) {
        const Seen seen = look(file);
        if (seen == last) continue;
        last = seen;
        differs = true;
    }
    const bool settled = unsettled_ && !differs;
    unsettled_ = differs;
    return settled;
}

}  // namespace lissom::window
