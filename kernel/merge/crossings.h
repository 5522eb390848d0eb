/// Self-intersections of a merged mesh: the new pairs of faces, and their places; private to
/// kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/merge.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {

/// Holds pairs of faces of a merged mesh.
struct Crossings {
    /// Pairs that come from faces that did not run through one another, ascending.
    std::vector<FacePair> pairs;
    /// Pairs of deformed or made faces that come from faces that did.
    Index known = 0;
};

/// Finds the pairs of faces of `sewn` that run through one another and come from faces of the
/// opened target and of the source at rest that did not. If both faces are the source's and belong
/// to separate parts of it, or lie more than one radius from every seam, the line along which the
/// surfaces cross may slide over to the next faces: those count as known. So do those of the target
/// with a part of the source without a joined boundary that ran through another part at rest.
Crossings new_crossings(const Mesh& target, const Mesh& source, const Sewn& sewn,
                        const Context& context);

/// Sorts pairs of faces by place: near a seam, else by the sides that they are on; and by whether
/// the surface hides them from outside. Those of a group are shallow if they part when both
/// surfaces draw back by a hundredth of the smallest radius of a seam.
std::vector<CrossingGroup> crossing_groups(const Sewn& sewn, std::span<const FacePair> pairs,
                                           const Context& context);

}  // namespace lissom
