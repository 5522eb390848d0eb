/// Large pages for memory that is written once and at large.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace lissom {

/// Asks the system for large pages in [memory, memory + bytes), which is to be asked before it is
/// first written: to get it page by page can take longer than to compute what it holds. A hint,
/// without any other effect; nothing where systems know no such thing or the range is short.
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
