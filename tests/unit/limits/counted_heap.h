/// The memory that the program has taken: replaces its allocation functions.
#pragma once

#include <cstddef>

namespace lissom::test {

/// Bytes in use now, and at most since the last `begin_heap_peak`, of all threads.
std::size_t heap_used();
std::size_t heap_peak();
void begin_heap_peak();

}  // namespace lissom::test
