/// Memory that runs out, as an error of the kernel.
#pragma once

#include <new>
#include <stdexcept>

namespace lissom {

/// Throws memory_limit because the process is out of memory.
[[noreturn]] void throw_out_of_memory();

/// Runs `work` and returns its result: the body of an operation that needs much memory (loading and
/// saving, subdividing, cutting, deforming, merging, growing hair, loops of a context). If memory
/// runs out (std::bad_alloc, or a size too large for a vector), throws memory_limit instead, so
/// that a host has one type of exception to catch.
template <typename Work>
decltype(auto) with_memory_errors(const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        throw_out_of_memory();
    } catch (const std::length_error&) {
        throw_out_of_memory();
    }
}

}  // namespace lissom
