/// Large pages for memory that is written once and at large.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "kernel/core/numbers/bits.h"

namespace lissom {

/// Memory for which the system is asked for large pages.
enum class LargePages : std::uint8_t {
    /// Matrices and factors, which are written at large.
    automatic,
    never,
    /// All large blocks, of libraries that see each.
    always,
};

/// Sets that for this process; `automatic` at first. Thread-safe.
void use_large_pages(LargePages pages) noexcept;
LargePages large_pages() noexcept;

/// Asks the system for large pages in [memory, memory + bytes). Call it before the first write:
/// page faults can take longer than computing the contents. A hint without any other effect;
/// ignored by systems without large pages, for short ranges, and with LargePages::never.
void prefer_large_pages(void* memory, std::size_t bytes);

/// An array that has not been written, with them.
template <typename Value>
std::unique_ptr<Value[]> large_array(std::size_t count) {
    auto array = unfilled<Value[]>(count);
    prefer_large_pages(array.get(), count * sizeof(Value));
    return array;
}

/// The same for the room of a vector.
template <typename Value>
void prefer_large_pages(std::vector<Value>& reserved) {
    prefer_large_pages(reserved.data(), reserved.capacity() * sizeof(Value));
}

}  // namespace lissom
