/// State of a recording that is played, as the window sees it.
#pragma once

#include <atomic>
#include <cstddef>

namespace lissom::window {

struct Playing {
    /// Events are taken: until the last, a failure or a stop.
    std::atomic<bool> goes_on{false};
    /// Number of events that are done.
    std::atomic<std::size_t> events{0};
};

}  // namespace lissom::window
