/// FileWatch: tells when files have changed, by looking at them now and then. Works on any file
/// system, and for files that are replaced instead of written.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace lissom::window {

class FileWatch {
  public:
    using Clock = std::chrono::steady_clock;

    /// Watches these files from now on, instead of others; files watched already keep their last
    /// seen state.
    void set(const std::vector<std::filesystem::path>& files);
    /// Looks at the files if the last look is a quarter of a second ago or longer. True once after
    /// a change, when nothing has changed any more since the look before.
    bool changed(Clock::time_point now);

  private:
    struct Seen {
        std::filesystem::file_time_type time{};
        std::uintmax_t size = 0;
        bool operator==(const Seen&) const = default;
    };
    static Seen look(const std::filesystem::path& file);

    std::map<std::filesystem::path, Seen> files_;
    Clock::time_point last_look_{};
    bool unsettled_ = false;
};

}  // namespace lissom::window
