#include "tests/bench/peers/heap.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

// Before each block stands its size, padded so that the block is aligned as malloc's.
constexpr std::size_t kHeader = alignof(std::max_align_t);
static_assert(kHeader >= sizeof(std::size_t));

std::atomic<std::size_t> in_use{0}, peak{0};

void* allocate(std::size_t size) {
    void* const block = std::malloc(kHeader + size);
    if (!block) throw std::bad_alloc();
    *static_cast<std::size_t*>(block) = size;
    const std::size_t now = in_use.fetch_add(size, std::memory_order_relaxed) + size;
    if (now > peak.load(std::memory_order_relaxed)) peak.store(now, std::memory_order_relaxed);
    return static_cast<char*>(block) + kHeader;
}

void release(void* pointer) {
    if (!pointer) return;
    void* const block = static_cast<char*>(pointer) - kHeader;
    in_use.fetch_sub(*static_cast<std::size_t*>(block), std::memory_order_relaxed);
    std::free(block);
}

}  // namespace

void* operator new(std::size_t size) {
    return allocate(size);
}
void* operator new[](std::size_t size) {
    return allocate(size);
}
void operator delete(void* pointer) noexcept {
    release(pointer);
}
void operator delete[](void* pointer) noexcept {
    release(pointer);
}
void operator delete(void* pointer, std::size_t) noexcept {
    release(pointer);
}
void operator delete[](void* pointer, std::size_t) noexcept {
    release(pointer);
}

namespace lissom::bench {

std::size_t heap_bytes() {
    return in_use.load(std::memory_order_relaxed);
}

std::size_t heap_peak() {
    return peak.load(std::memory_order_relaxed);
}

void restart_heap_peak() {
    peak.store(heap_bytes(), std::memory_order_relaxed);
}

}  // namespace lissom::bench
