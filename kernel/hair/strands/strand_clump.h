/// Clump: strands gather around guides.
#pragma once

#include <cstdint>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Clusters of strands and their guides.
struct ClumpOptions {
    /// Number of guides: the strands of the lowest ids. These are spread over the scalp, so any
    /// part of the hair that has them gathers as the whole does. 0: the guides that the strands
    /// have (Strands::guides), or 900, but at most one for eight strands.
    Index clumps = 0;
    /// Part of the way to the guide that tips move; 0 to 1.
    double strength = 0.7;
    /// The strength of each clump is up to this fraction higher or lower, at random; 0 to 1.
    double variation = 0.5;
    /// The pull grows with t^shape; positive.
    double shape = 1.0;
    /// Strands rooted further than this from their guide stay, those nearer are pulled the less the
    /// further they are; metres, positive. Infinite: no limit.
    double radius = 0.03;
    /// The nearest guide counts; its distance includes that of the combed middles of the strands,
    /// times this: a strand gathers with those of its own side of a parting. 0 or more.
    double apart = 0.5;
    /// Random distance in metres by which the tips of a clump miss their guide; 0 or more.
    double tip_spread = 0.001;
    /// Random distance in metres by which the tip of a whole clump moves; 0 or more.
    double offset = 0.0;
    /// Strands gather around guides of their own group only.
    bool within_groups = true;
    /// Segments keep their lengths; without it, strands become shorter or longer as their guide is.
    bool keep_length = true;
    std::uint64_t seed = 1;
    /// Its factor, mask and profile count, besides the options above.
    StrandOperatorOptions effect = {};
};

/// Pulls each strand towards its guide G: with (a, b, c) the offset of the roots in the guide's
/// root frame (N, B, T), which runs along it with the least twist, and s = t^shape, a point moves s
/// * strength * falloff of the way to G(t) + (1 - s) (a N + b B + c T) + s (tip_spread random of
/// the strand + offset random of the clump). Guarantees of all operators: strand_operators.h; a
/// prefix is one only if it holds all guides. Errors: invalid_argument for options out of range;
/// not_finite; memory_limit, cancelled.
void clump(Strands& strands, const ClumpOptions& options = {}, const Context& context = {});

}  // namespace lissom
