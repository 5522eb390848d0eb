/// Correspondence of boundaries without keys: the offset along the loop that turns
/// the source least from how it lies, or the one under which a similarity fits best.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/merge/loop/correspondence.h"
#include "kernel/merge/loop/keys.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/merge/loop/loop_fit.h"
#include "kernel/merge/loop/part_shape.h"

namespace lissom {

/// Two loops to be joined that run the same way around the seam.
struct LoopJoin {
    const Loop* source = nullptr;
    const Loop* target = nullptr;
    /// The part behind the loops; null if it is not to count.
    const PartShape* source_part = nullptr;
    const PartShape* target_part = nullptr;
};

/// A guess for one join.
struct OffsetGuess {
    ParameterPair key;
    /// Cost of the best different offset, in costs of the best one: below kClearContrast the guess
    /// is a toss.
    double contrast = 1.0;
};

/// Offsets of this contrast are no toss; and the contrast of one that was not compared.
inline constexpr double kClearContrast = 1.5, kSureContrast = 1e9;

/// Returns, of all turns about the axis of the first loop, the one that rotates the source least
/// from its present place: the similarity that fits the loops then has no twist about the target's
/// axis. With several joins the centres of all loops come together, and the least remaining
/// rotation is taken. The other joins get the best offset under that similarity.
std::vector<OffsetGuess> as_placed_offsets(std::span<const LoopJoin> joins);

/// Returns whether the source must be turned over by more than 150 degrees to meet the target, so
/// that how it lies does not say which way it belongs.
bool is_turned_over(const LoopJoin& join);

/// Returns whether any of the directions lies in the planes of both loops enough to say how the
/// source turns.
bool directions_count(const LoopJoin& join, std::span<const DirectionPair> directions);

/// Tries 128 offsets of the first join, each with the similarity that fits its samples and, beside
/// them, the centres of all other joins, and takes the one with the least misfit of points,
/// normals, `directions` and the shapes of the parts behind the first join; then the best offset of
/// every other join under that similarity. A direction counts as far as it lies in the planes of
/// both loops. Of offsets that are equally good (within a thousandth of the target's radius) the
/// first one counted from the loops' first vertices is taken, so that the place of the source does
/// not decide.
std::vector<OffsetGuess> guess_offsets(std::span<const LoopJoin> joins,
                                       std::span<const DirectionPair> directions = {});

/// A turn that something suggests, and how well the loops fit under it.
struct TurnCandidate {
    double offset = 0.0;
    SimilarityMap fit;
    /// RMS misfit of the loops in radii of the target, and half the mean mismatch of their normals.
    double loop_cost = 0.0;
    /// The sine of the angle between the planes of symmetry, and the cosine between the directions
    /// in which both masses lie beside the axis, less if one lies near to it: 0 if a part has none.
    double mirror = 0.0, mass = 0.0;
};

/// Finds the turns that the loops, the planes of symmetry, the masses and the necks of a join
/// suggest, at most kTurnCandidates and each at least 10 degrees from the others. Returns at least
/// one.
std::vector<TurnCandidate> turn_candidates(const LoopJoin& join);
inline constexpr std::size_t kTurnCandidates = 16;

/// Returns the same for a source that stays in place: each join has the offset under which its
/// loops lie nearest to each other, moved together by their centres, scaled by their radii and
/// turned the shortest way by their axes.
std::vector<OffsetGuess> nearest_offsets(std::span<const LoopJoin> joins);

}  // namespace lissom
