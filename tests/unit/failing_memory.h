/// Memory that runs out when a test says so: replaces the allocation functions of the program.
#pragma once

#include <atomic>

namespace lissom::test {

/// Allocations until one fails with std::bad_alloc; those after it succeed. Negative: none fails.
extern std::atomic<long> allocations_left;

}  // namespace lissom::test
