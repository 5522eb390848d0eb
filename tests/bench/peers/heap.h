/// Heap: what a benchmark program has allocated with operator new, which it replaces.
#pragma once

#include <cstddef>

namespace lissom::bench {

/// Bytes that are allocated now.
std::size_t heap_bytes();

/// The most bytes allocated at one time since `restart_heap_peak` was called.
std::size_t heap_peak();
void restart_heap_peak();

/// Greatest growth of the heap while `action` runs, in bytes.
template <typename Action>
double heap_growth(const Action& action) {
    restart_heap_peak();
    const std::size_t before = heap_bytes();
    action();
    return static_cast<double>(heap_peak() - before);
}

}  // namespace lissom::bench
