/// Smoothing of the places near seams at which the surface folds or crosses itself; private to
/// kernel/merge.
#pragma once

#include <span>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/sew/sew.h"

namespace lissom {

/// Rings around a fault that are smoothed at most: first one, then twice as many, if it stays.
inline constexpr Index kRelaxRings = 4;

/// Smooths, within one radius of the seams, the vertices of edges at which the surface folds back
/// by more than 135 degrees, and of the faces `crossing`, with `rings` rings around them. Those of
/// `firm`, ascending, that are more than two rings from the seams stay, and those on open
/// boundaries. Morph targets and normals follow. The quality of the seams in the report is measured
/// anew. Returns false, and changes nothing, if there are no such places, or if they are more than
/// a third of the band. Errors: cancelled.
bool relax_faults(Sewn& sewn, std::span<const Index> crossing, std::span<const Index> firm,
                  Index rings, const Context& context);

}  // namespace lissom
