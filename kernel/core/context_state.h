/// The state behind a Context; private to kernel/core.
#pragma once

#include <atomic>
#include <memory>
#include <utility>

#include "kernel/core/context.h"

namespace lissom {

/// Threads that a context with `threads > 1` runs its loops on.
class ThreadArena;

struct Context::State {
    explicit State(ContextOptions given)
        : options(std::move(given)),
          memory(options.memory ? options.memory
                                : std::make_shared<MemoryAccount>(options.memory_limit)) {}

    ContextOptions options;
    std::shared_ptr<MemoryAccount> memory;
    std::atomic<bool> cancelled{false};
    std::shared_ptr<ThreadArena> arena;

    // The part of [0, 1] that the next Progress fills, and the greatest fraction reported so far.
    int progress_depth = 0;
    double window_begin = 0.0, window_end = 1.0, reported = 0.0;
};

}  // namespace lissom
