/// A heap of a host, which counts, and checks what comes back.
#pragma once

#include <atomic>
#include <cstddef>

#include "bindings/c/lissom.h"

namespace lissom::test {

class HostHeap {
  public:
    HostHeap() = default;
    HostHeap(const HostHeap&) = delete;
    HostHeap& operator=(const HostHeap&) = delete;

    /// Returns options with this heap, for blocks of at least `min_bytes`.
    lissom_memory_options options(std::size_t min_bytes = 0);

    /// Blocks that were not given back; bytes of all blocks so far; blocks so far.
    long live() const { return live_; }
    std::size_t bytes() const { return bytes_; }
    long made() const { return made_; }
    /// Returns the number of blocks that came back with another size or alignment, or to the wrong
    /// heap.
    long wrong() const { return wrong_; }
    std::size_t smallest() const { return smallest_; }
    /// Lets the allocation number `n` from now on fail, from 0. Negative: none.
    void fail_at(long n) { left_ = n; }

  private:
    void* allocate(std::size_t size, std::size_t alignment);
    void release(void* block, std::size_t size, std::size_t alignment);

    std::atomic<long> live_{0}, made_{0}, wrong_{0}, left_{-1};
    std::atomic<std::size_t> bytes_{0}, smallest_{~std::size_t{0}};
};

}  // namespace lissom::test
