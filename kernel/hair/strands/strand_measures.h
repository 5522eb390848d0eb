/// Measures of strands: lengths, extents, statistics, and a hash of their content.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Length of a strand in metres; 0 for one point.
double length(const StrandView& strand);

/// Arc length at each point as a fraction of the whole: 0 at the root, 1 at the tip. If the strand
/// has no length, the points are spread evenly. `t` is resized to the points.
void arc_fractions(const StrandView& strand, std::vector<double>& t);

/// Diameters in metres at the points of a strand, its profile included. `widths` is resized.
void widths_of(const Strands& strands, Index strand, std::vector<float>& widths);

/// Smallest box around all finite points.
Box bounds(const Strands& strands);

struct StrandStatisticsOptions {
    /// Signed distance in metres to the head at a point, negative inside; empty: penetration is not
    /// measured. Called on several threads.
    std::function<double(const Vec3&)> distance;
    /// A strand penetrates if a point is deeper than this, in metres.
    double depth = 0.0;
    /// A turn counts as sharp above this angle between two segments, in radians.
    double sharp_turn = kPi / 2.0;
};

/// Segments without length are passed over when turns are measured; strands with a point that is
/// not finite count in `not_finite` only.
struct StrandStatistics {
    Index strands = 0, points = 0;
    Index min_points = 0, max_points = 0;
    /// Metres; the least length over all strands.
    double min_length = 0.0, mean_length = 0.0, max_length = 0.0;
    /// Greatest angle between successive segments, in radians, and the strand that has it.
    double max_turn = 0.0;
    Index max_turn_strand = kNoIndex;
    /// Numbers of strands: with a sharp turn; without length; with a segment without length; with a
    /// coordinate that is NaN or infinite.
    Index sharp = 0, zero_length = 0, zero_segments = 0, not_finite = 0;
    /// Strands with a point deeper than asked, and the depth of the deepest point in metres.
    Index penetrating = 0;
    double deepest = 0.0;
};

/// Measures all strands. The same for any number of threads. Errors: cancelled.
StrandStatistics strand_statistics(const Strands& strands,
                                   const StrandStatisticsOptions& options = {},
                                   const Context& context = {});

/// 64-bit hash of everything the strands hold, points to the bit. The same on every platform; equal
/// strands have equal hashes.
std::uint64_t hash(const Strands& strands);

}  // namespace lissom
