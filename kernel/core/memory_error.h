/// Memory that runs out, as an error of the kernel.
#pragma once

#include <new>
#include <stdexcept>

namespace lissom {

/// Throws memory_limit: what an operation throws where the process has no more memory.
[[noreturn]] void throw_out_of_memory();

/// Runs `work`: what operations that need much memory do (loading and saving, subdividing, cutting,
/// deforming, merging, growing hair, loops of a context). Where memory runs out (std::bad_alloc, or
/// a size that no vector can have) throws memory_limit instead, so that a host has one type of
/// exception to catch.
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
