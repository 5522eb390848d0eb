/// Large pages for memory that is written once and at large.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace lissom {

/// Asks the system for large pages in [memory, memory + bytes). Call it before the first write:
/// page faults can take longer than computing the contents. A hint without any other effect;
/// ignored by systems without large pages and for short ranges.
void prefer_large_pages(void* memory, std::size_t bytes);

/// An array that has not been written, with them.
template <typename Value>
std::unique_ptr<Value[]> large_array(std::size_t count) {
    auto array = std::make_unique_for_overwrite<Value[]>(count);
    prefer_large_pages(array.get(), count * sizeof(Value));
    return array;
}

/// The same for the room of a vector.
template <typename Value>
void prefer_large_pages(std::vector<Value>& reserved) {
    prefer_large_pages(reserved.data(), reserved.capacity() * sizeof(Value));
}

}  // namespace lissom
