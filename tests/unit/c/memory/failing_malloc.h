/// Memory that runs out when a test says so: replaces malloc for all of the program, C++ and C.
#pragma once

#include <cstddef>

namespace lissom::test {

/// Lets the allocation number `n` from now on fail, from 0, and those after it if `all`.
void fail_at(long n, bool all);
/// Lets all succeed again. Returns whether one has failed.
bool stop_failing();
/// Returns the number of allocations since the program began, of all threads.
long allocations();
/// Returns the bytes of those.
long allocated_bytes();
/// Returns the number of blocks that were not freed.
long live_blocks();

/// Take and free a block that counts nowhere and never fails.
void* block_aside(std::size_t alignment, std::size_t size);
void free_aside(void* block);

}  // namespace lissom::test
