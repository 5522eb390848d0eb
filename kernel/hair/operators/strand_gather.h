/// Operators of locks: strands that gather around a guide, turn about it, or are pinched to it.
///
/// The guides are those that strands have (Strands::guides). If they have none, or `guides` is not
/// 0, that many are assigned first; they stay with the strands, so that later operators work on the
/// same locks. Guides themselves do not move.
#pragma once

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Number of guides of strands that have none.
inline constexpr Index kUsualGuides = 400;

struct GatherOptions : StrandOperatorOptions {
    GatherOptions() { keep_length = false; }

    /// Number of guides to assign; 0: those that strands have, or kUsualGuides.
    Index guides = 0;
    /// Length in metres from the root over which strands come to their guide; 0 or more.
    double ramp = 0.02;
    /// Distance in metres, about, of strands from their guide; 0 or more.
    double spread = 0.001;
};

/// Gathers strands around their guide G: a point at the arc a of a strand of the length L moves to
/// G(a l / L) + spread * random, l being its guide arc, from nothing at the root to all of the way
/// at the end of the ramp. Errors: invalid_argument for options out of range; not_finite;
/// memory_limit, cancelled.
void gather(Strands& strands, const GatherOptions& options = {}, const Context& context = {});

struct TwistOptions : StrandOperatorOptions {
    TwistOptions() { keep_length = false; }
    /// Same as GatherOptions::guides.
    Index guides = 0;
    /// Length in metres of the guide over which strands turn about it once; negative turns the
    /// other way. Not 0.
    double wavelength = 0.05;
    /// Length in metres from the root over which the turning begins; 0 or more.
    double ramp = 0.02;
};

/// Turns strands about their guide, as hair twisted to a rope. Errors: as gather.
void twist(Strands& strands, const TwistOptions& options = {}, const Context& context = {});

struct PinchOptions : StrandOperatorOptions {
    PinchOptions() { keep_length = false; }
    /// Same as GatherOptions::guides.
    Index guides = 0;
    /// The place that is pinched, 0 at the root and 1 at the tip, and the part of the length to
    /// both sides over which the effect falls off; positive.
    double place = 0.5, width = 0.15;
};

/// Pulls strands to their guide at one place along them, as a tie does: by exp(-((t - place) /
/// width)^2) of the way. Errors: as gather.
void pinch(Strands& strands, const PinchOptions& options = {}, const Context& context = {});

}  // namespace lissom
