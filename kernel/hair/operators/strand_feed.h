/// Feed-in braids: strands that join a braid along its way, as in crown braids, cornrows and French
/// braids.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/operators/strand_braid.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

struct FeedBraidOptions : StrandOperatorOptions {
    /// The middle of the braid in metres of the strands; smoothed. At least two points that differ.
    std::vector<Vec3> spine;
    /// Direction across the braid at its beginning, as BraidOptions::across.
    Vec3 across = Vec3::UnitX();
    /// Metres: of each of the three tubes; positive.
    double radius = 0.0085;
    /// Metres from the spine to the middle of a tube, across and towards the viewer; 0: 1.25 and .8
    /// radii.
    double wide = 0.0, high = 0.0;
    /// Metres of one turn of a tube; 0: 7 radii.
    double wavelength = 0.0;
    /// A strand joins where it first comes so near to the spine, else at its nearest point if that
    /// is within 2.5 times of it; positive.
    double reach = 0.01;
    /// Strands join within this part of the spine; above 0, at most 1. A ring whose end lies on its
    /// beginning closes without a gap with less than 1.
    double joined = 1.0;
    /// Metres over which a strand comes into its tube; positive.
    double blend = 0.02;
    /// Metres that a strand runs in the braid, at random from `min_run` to `max_run`; positive.
    double min_run = 0.06, max_run = 0.12;
    /// Part of the strands that run to the end of the spine, 0 to 1.
    double tail = 0.0;
    /// Size of the braid at its beginning and at its end, as parts of that between; above 0.
    double begin = 1.0, end = 1.0;
    /// Part of the strands that lie loosely around their tube; 0 to 1.
    double loose = 0.02;
    /// Metres between points; positive.
    double step = 0.002;
    /// Removes the strands that come nowhere near the spine; those that the mask leaves out stay.
    bool drop_others = false;
};

/// Braids strands along a spine: each is cut where it joins, leaves its course towards the spine
/// without a kink, comes into one of three tubes at random and runs on in it for a while, hidden at
/// its end. Other strands stay to the bit; the factor does not count, and a mask is one from .5 on.
/// Errors: invalid_argument for options out of range, and if no strand comes near the spine;
/// not_finite; memory_limit, cancelled.
BraidReport feed_braid(Strands& strands, const FeedBraidOptions& options,
                       const Context& context = {});

}  // namespace lissom
