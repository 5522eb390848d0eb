#include <algorithm>
#include <exception>
#include <functional>
#include <mutex>

#include "kernel/core/context_state.h"
#include "kernel/core/error.h"
#include "kernel/core/memory_error.h"

#ifdef LISSOM_HAS_TBB
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace lissom {

#ifdef LISSOM_HAS_TBB
class ThreadArena {
  public:
    // TBB prints a warning when it is asked for more threads than there are.
    explicit ThreadArena(int threads)
        : arena_(std::min(threads, tbb::info::default_concurrency())) {}
    void run(std::size_t count, const std::function<void(std::size_t)>& chunk) {
        arena_.execute([&] {
            tbb::parallel_for(
                std::size_t{0}, count, [&](std::size_t i) { chunk(i); }, tbb::simple_partitioner());
        });
    }

  private:
    tbb::task_arena arena_;
};
#else
class ThreadArena {
  public:
    explicit ThreadArena(int) {}
    void run(std::size_t count, const std::function<void(std::size_t)>& chunk) {
        for (std::size_t i = 0; i < count; ++i) chunk(i);
    }
};
#endif

namespace {

// Keeps the exception of the earliest chunk, so that the reported error does not depend on timing.
class FirstException {
  public:
    void keep(std::size_t chunk, std::exception_ptr exception) {
        const std::lock_guard lock(mutex_);
        if (exception_ && chunk >= chunk_) return;
        chunk_ = chunk;
        exception_ = std::move(exception);
    }
    void rethrow() const {
        if (exception_) std::rethrow_exception(exception_);
    }

  private:
    std::mutex mutex_;
    std::size_t chunk_ = 0;
    std::exception_ptr exception_;
};

}  // namespace

void Context::parallel_for(Index begin, Index end, Index grain,
                           const std::function<void(Index, Index)>& body) const {
    checkpoint();
    if (begin >= end) return;
    grain = std::max<Index>(1, grain);
    const std::size_t count = (std::int64_t{end} - begin + grain - 1) / grain;
    FirstException first;
    const auto guarded = [&](std::size_t i) {
        if (cancelled()) return;
        const auto from = index_of(begin + static_cast<std::int64_t>(i) * grain);
        const auto to = index_of(std::min<std::int64_t>(end, std::int64_t{from} + grain));
        try {
            with_memory_errors([&] { body(from, to); });
        } catch (...) {
            first.keep(i, std::current_exception());
        }
    };
    // By reference: a frame takes no memory for its loops.
    const std::function<void(std::size_t)> chunk = std::cref(guarded);
    if (state_->options.parallel_for) {
        state_->options.parallel_for(count, chunk);
    } else if (threads() > 1 && count > 1) {
        if (!state_->arena) state_->arena = std::make_shared<ThreadArena>(threads());
        state_->arena->run(count, chunk);
    } else {
        for (std::size_t i = 0; i < count; ++i) chunk(i);
    }
    first.rethrow();
    checkpoint();
}

}  // namespace lissom
