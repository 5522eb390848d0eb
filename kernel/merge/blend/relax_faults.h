/// Smoothing of the places near seams at which the surface folds or crosses itself; private to
/// kernel/merge.
#pragma once

#include <span>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/sew/sew.h"

namespace lissom {

/// Rings around a fault that are smoothed at most: first one, then twice as many, if it stays.
inline constexpr Index kRelaxRings = 4;

/// Faults that smoothing may take away, and vertices that it keeps.
struct RelaxPlaces {
    /// Faces that run through others.
    std::span<const Index> crossing = {};
    /// Vertices, ascending, that stay if they are more than two rings from the seams.
    std::span<const Index> firm = {};
    /// Place of each vertex of the mesh on the source at rest, NaN for a vertex that was not on it;
    /// empty if none is known.
    std::span<const Vec3> rest = {};
};

/// Smooths, within one radius of the seams, the vertices of edges at which the surface folds back
/// by more than 135 degrees, and of the faces that cross others, with `rings` rings around them;
/// and within half a radius the thorns and pits that the source did not have (pinches). Firm
/// vertices stay, and those on open boundaries. Morph targets and normals follow. The quality of
/// the seams in the report is measured anew. Returns false, and changes nothing, if there are no
/// such places, or if they are more than a third of the band. Errors: cancelled.
bool relax_faults(Sewn& sewn, const RelaxPlaces& places, Index rings, const Context& context);

}  // namespace lissom
