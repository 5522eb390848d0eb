/// Which points of boundaries meet where the user gives no keys: the offset along the loop under
/// which a similarity fits best.
#pragma once

#include <span>
#include <vector>

#include "kernel/merge/loop/correspondence.h"
#include "kernel/merge/loop/loop.h"

namespace lissom {

/// Two loops to be joined that run the same way around the seam.
struct LoopJoin {
    const Loop* source = nullptr;
    const Loop* target = nullptr;
};

/// A guess for one join.
struct OffsetGuess {
    ParameterPair key;
    /// Cost of the best different offset, in costs of the best one: below 1.5 the guess is a toss.
    double certainty = 1.0;
};

/// Tries 128 offsets of the first join, each with the similarity that fits its samples and, beside
/// them, the centres of all other joins, and takes the one with the least misfit of points and
/// normals; then the best offset of every other join under that similarity.
std::vector<OffsetGuess> guess_offsets(std::span<const LoopJoin> joins);

}  // namespace lissom
