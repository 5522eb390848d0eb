/// Blocks of vertices that a frame works on together; private to kernel/deform.
#pragma once

#include <algorithm>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"

namespace lissom {

/// Vertices evaluated in one piece of a parallel loop of a frame.
inline constexpr Index kFrameGrain = 4096;

/// Vertices whose matrices are worked on while they are in the cache.
inline constexpr Index kFrameBlock = 256;

/// Calls work(begin, end) for pieces of [0, count), in parallel. Takes no memory.
template <typename Work>
void for_each_part(const Context& context, Index count, const Work& work) {
    context.parallel_for(0, count, kFrameGrain,
                         [&work](Index begin, Index end) { work(begin, end); });
}

/// Calls work(begin, end) for blocks of [0, count), in parallel. Takes no memory.
template <typename Work>
void for_each_block(const Context& context, Index count, const Work& work) {
    context.parallel_for(0, count, kFrameGrain, [&](Index begin, Index end) {
        for (Index b = begin; b < end; b += kFrameBlock) work(b, std::min(end, b + kFrameBlock));
    });
}

}  // namespace lissom
