/// Local detail of strands, first the simple operators; clump, noise and trim have files of their
/// own (strand_clump.h, strand_noise.h, strand_trim.h).
///
/// Guarantees of all of them: roots never move, and the result of a strand depends on it, its id,
/// the seed and its guide alone - not on the number of threads, the order of the strands, or their
/// count. So the first n of all results are the results of the first n strands, and the count can
/// change while the look stays. `t` is the arc length along a strand as a fraction of the whole, 0
/// at the root, 1 at the tip. Strands with a coordinate that is not finite stay as they are. An
/// operator that throws has changed nothing.
#pragma once

#include <functional>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Widths are multiplied by 1 from the root to `start`, and from there on by a factor that goes
/// from 1 to `tip` as t^shape.
struct TaperOptions {
    /// Width of the tip as a fraction of that without taper; positive.
    double tip = 0.2;
    /// `t` at the start of the taper, 0 to below 1.
    double start = 0.0;
    /// Exponent, positive: 1 is a cone, 2 stays wide for longer.
    double shape = 1.0;
};

/// Makes strands thinner towards their tips: multiplies the profile of the widths. Points do not
/// move. Errors: invalid_argument for options out of range.
void taper(Strands& strands, const TaperOptions& options = {});

/// Amount of smoothing of strands.
struct StrandSmoothOptions {
    /// Number of passes, 0 or more.
    Index iterations = 3;
    /// Fraction of the way to the middle of its neighbours that a point moves in a pass; above 0,
    /// at most 1.
    double strength = 0.5;
    /// Its factor, mask and profile; segments keep their lengths if only a part is smoothed.
    StrandOperatorOptions effect = {};
};

/// Evens out kinks along each strand; roots and tips stay. Errors: invalid_argument for options out
/// of range; memory_limit, cancelled.
void smooth(Strands& strands, const StrandSmoothOptions& options = {}, const Context& context = {});

/// Moves the points of every strand that is finite, has a length, and that the mask of `effect`
/// holds: `move(strand, old, made)` is called on several threads and writes the columns of `made`,
/// which begin as the old points; the factor, mask and profile of `effect` let points go a part of
/// the way. The root is put back. Errors: as change_strands.
void move_points(
    Strands& strands, const StrandOperatorOptions& effect,
    const std::function<void(Index strand, const StrandView& old, StrandEdit& made)>& move,
    const Context& context);

/// Makes the segments of `made` as long as those of `old`, from the root on, in their present
/// directions; a segment without a direction takes the old one.
void restore_lengths(const StrandView& old, StrandEdit& made);

}  // namespace lissom
