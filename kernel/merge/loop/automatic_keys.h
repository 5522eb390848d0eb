/// Which points of boundaries meet where the user gives no keys: the offset along the loop under
/// which a similarity fits best.
#pragma once

#include <span>
#include <vector>

#include "kernel/merge/loop/correspondence.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/merge/loop/part_shape.h"

namespace lissom {

/// Two loops to be joined that run the same way around the seam.
struct LoopJoin {
    const Loop* source = nullptr;
    const Loop* target = nullptr;
    /// What lies behind the loops; null where that is not to count.
    const PartShape* source_part = nullptr;
    const PartShape* target_part = nullptr;
};

/// A guess for one join.
struct OffsetGuess {
    ParameterPair key;
    /// Cost of the best different offset, in costs of the best one: below kCertain the guess is a
    /// toss.
    double certainty = 1.0;
};

/// Tries 128 offsets of the first join, each with the similarity that fits its samples and, beside
/// them, the centres of all other joins, and takes the one with the least misfit of points,
/// normals, `directions` and the shapes of the parts behind the first join; then the best offset of
/// every other join under that similarity. A direction counts as far as it lies in the planes of
/// both loops. Of offsets that are equally good (within a thousandth of the target's radius) the
/// first one counted from the loops' first vertices is taken, so that where the source lies does
/// not decide.
std::vector<OffsetGuess> guess_offsets(std::span<const LoopJoin> joins,
                                       std::span<const DirectionPair> directions = {});

/// The same for a source that stays where it was put: each join has the offset under which its
/// loops lie nearest to each other, moved together by their centres, scaled by their radii and
/// turned the shortest way by their axes.
std::vector<OffsetGuess> nearest_offsets(std::span<const LoopJoin> joins);

}  // namespace lissom
