/// A host that cancels at any moment it can.
#pragma once

#include <functional>
#include <string_view>

#include "kernel/core/context.h"

namespace lissom::test {

/// A context that counts the moments at which a host may cancel, and cancels at one of them: each
/// report of progress and each chunk of a loop.
class Interrupter {
  public:
    explicit Interrupter(int stop) : stop_(stop) {
        ContextOptions options;
        options.progress = [this](std::string_view, double) { tick(); };
        options.parallel_for = [this](std::size_t count,
                                      const std::function<void(std::size_t)>& chunk) {
            for (std::size_t i = 0; i < count; ++i) {
                tick();
                chunk(i);
            }
            tick();
        };
        context_ = Context(options);
    }
    Interrupter(const Interrupter&) = delete;
    Interrupter& operator=(const Interrupter&) = delete;

    const Context& context() const { return context_; }
    int moments() const { return moments_; }

  private:
    void tick() {
        if (moments_++ == stop_) context_.cancel();
    }

    int stop_, moments_ = 0;
    Context context_;
};

}  // namespace lissom::test
