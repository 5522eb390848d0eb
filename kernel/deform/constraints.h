/// What holds the vertices of a patch: the handles, the vertex constraints and the rest of the
/// mesh; private to kernel/deform.
#pragma once

#include <map>
#include <vector>

#include "kernel/deform/deformer.h"
#include "kernel/deform/gradients.h"
#include "kernel/deform/patch.h"

namespace lissom {

/// Owners of local vertices other than handles, which count from 0.
inline constexpr Index kFree = -1;
inline constexpr Index kPinned = -2;
inline constexpr Index kConstrained = -3;

/// One handle of a deformer; removed handles leave their place empty.
struct HandleState {
    Region region;
    HandleOptions options;
    Affine transform;
    Vec3 center = Vec3::Zero();
    std::vector<Index> local;
    bool removed = false;
    /// `transform` as the patch sees it: relative to the patch's origin, with digits that the one
    /// above lacks where the mesh lies far from the origin of its coordinates.
    Affine in_patch;
};

/// Constraints of single vertices by local vertex.
using VertexConstraints = std::map<Index, VertexConstraint>;

/// Owner of every local vertex. Outside the region, and without faces, vertices are pinned.
std::vector<Index> find_owners(const Patch& patch, const Rings& rings,
                               const std::vector<HandleState>& handles,
                               const VertexConstraints& constraints);

/// What the owners make known.
Knowledge find_knowledge(const Patch& patch, const Rings& rings, const std::vector<Index>& owner,
                         const std::vector<HandleState>& handles,
                         const VertexConstraints& constraints);

/// Throws `unconstrained` where a connected part with free vertices has no known position, or
/// neither a known gradient nor four known positions that are not in one plane.
void require_constraints(const Patch& patch, const Rings& rings, const Knowledge& known);

}  // namespace lissom
