/// Limits of a script's run: everything that can take long asks for them.
#pragma once

#include <atomic>

#include "kernel/core/context.h"

namespace lissom::lua {

/// Thrown, in C++ only, by work that was stopped.
struct Stopped {};

/// Set once by the watch over the limits, or by the cancel of the context that it follows; read on
/// the thread of the script.
class Stop {
  public:
    bool asked() const { return asked_.load(std::memory_order_relaxed) || context_.cancelled(); }
    /// Takes a cancel of `context` for a stop from now on. To be called on the thread of the
    /// script.
    void follow(const Context& context) { context_ = context; }
    void ask() { asked_.store(true, std::memory_order_relaxed); }
    void clear() { asked_.store(false, std::memory_order_relaxed); }

    /// Throws Stopped if it was asked for, each time that `ticks` has counted some thousand
    /// steps.
    void tick(unsigned& ticks, unsigned steps = 1) const {
        ticks += steps;
        if (ticks < kSteps) return;
        ticks = 0;
        if (asked()) throw Stopped{};
    }

  private:
    static constexpr unsigned kSteps = 4096;

    std::atomic<bool> asked_ = false;
    Context context_;
};

}  // namespace lissom::lua
