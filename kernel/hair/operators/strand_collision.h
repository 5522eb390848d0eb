/// Strands and the surface that they must not enter, or that they lie on.
#pragma once

#include <functional>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Signed distance at a point to a body, negative inside; both in metres of the strands. Called on
/// several threads.
using BodyDistance = std::function<double(const Vec3& point)>;

/// Returns the unit gradient of a distance, by differences over a millimetre to each side; zero if
/// it has none.
Vec3 outward_at(const BodyDistance& distance, const Vec3& point);

struct PushOutOptions : StrandOperatorOptions {
    BodyDistance distance;
    /// A distance that costs less and is off by at most `rough_error`: where it leaves no doubt,
    /// `distance` is not asked. Absent: always ask.
    BodyDistance rough = {};
    double rough_error = 0.0;
    /// Metres that points stay off the body, from 0 at the root on up to this at `ramp` metres
    /// along the strand; 0 or more.
    double clearance = 0.0005, ramp = 0.01;
};

/// Moves points that lie in a body out of it, and those around segments that pass through it.
/// Strands outside stay to the bit; the lengths of others are kept to a few per cent. Errors:
/// invalid_argument without a distance or for options out of range; not_finite; memory_limit,
/// cancelled.
void push_out(Strands& strands, const PushOutOptions& options, const Context& context = {});

struct ShrinkwrapOptions : StrandOperatorOptions {
    BodyDistance distance;
    /// Metres above the body that points come to; 0 or more.
    double lift = 0.003;
};

/// Draws strands onto a body: each point moves along the gradient of the distance until it lies the
/// lift above. Errors: as push_out.
void shrinkwrap(Strands& strands, const ShrinkwrapOptions& options, const Context& context = {});

}  // namespace lissom
