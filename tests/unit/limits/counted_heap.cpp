#include "tests/unit/limits/counted_heap.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> used{0}, peak{0};

void* counted(void* memory) {
    if (!memory) return nullptr;
    const std::size_t now = used += malloc_usable_size(memory);
    std::size_t most = peak.load();
    while (most < now && !peak.compare_exchange_weak(most, now)) {
    }
    return memory;
}

void* allocate(std::size_t size) {
    void* memory = counted(std::malloc(size > 0 ? size : 1));
    if (!memory) throw std::bad_alloc();
    return memory;
}

void free_counted(void* memory) {
    if (memory) used -= malloc_usable_size(memory);
    std::free(memory);
}

}  // namespace

namespace lissom::test {

std::size_t heap_used() {
    return used;
}
std::size_t heap_peak() {
    return peak;
}
void begin_heap_peak() {
    peak = used.load();
}

}  // namespace lissom::test

void* operator new(std::size_t size) {
    return allocate(size);
}
void* operator new[](std::size_t size) {
    return allocate(size);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return counted(std::malloc(size > 0 ? size : 1));
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return counted(std::malloc(size > 0 ? size : 1));
}
void operator delete(void* memory) noexcept {
    free_counted(memory);
}
void operator delete[](void* memory) noexcept {
    free_counted(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    free_counted(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    free_counted(memory);
}
