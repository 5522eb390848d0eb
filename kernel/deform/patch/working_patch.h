/// The patch that a preparation works on, with its operators; private to kernel/deform.
#pragma once

#include <vector>

#include "kernel/core/index.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/operators.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/deform/patch/ties.h"

namespace lissom {

/// One-rings of real vertices alone, and their geometry.
struct SurfaceRings {
    Rings rings;
    RingGeometry geometry;
};

/// A patch and the operators of its shape and the options. A preparation may work on a patch with
/// more vertices than the one that a Deformer was made with: its real vertices, which come first,
/// are the same in both.
struct WorkingPatch {
    WorkingPatch(Patch from, const DeformOptions& options);

    Patch patch;
    Rings rings;
    RingGeometry geometry;
    Laplacian laplacian;
    /// RMS distance of the surface to its centroid.
    double radius = 0.0;

    /// Stiffness of each local vertex, or empty if all are 1. The weights of `laplacian` include
    /// it.
    std::vector<double> stiffness;

    /// Soft constraints and constraints of points, beside held vertices. For each anchor its owner
    /// (constraints.h) and the number of its point constraint, or kNoIndex.
    Ties ties;
    std::vector<GradientTie> gradient_ties;
    std::vector<Index> anchor_owner, anchor_point;

    /// The rings without virtual vertices and normal points, over the mesh's own triangles.
    SurfaceRings surface_rings() const;

    /// Mean stiffness of two vertices.
    double stiffness_between(Index a, Index b) const {
        return stiffness.empty() ? 1.0 : 0.5 * (stiffness[at(a)] + stiffness[at(b)]);
    }

    /// Weight of a tie of weight 1 in the first system, for squared distances and for squared
    /// differences of gradients.
    double position_unit() const;
    double gradient_unit() const;
};

}  // namespace lissom
