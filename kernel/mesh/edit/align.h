/// Alignment of one surface to another.
#pragma once

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// The start of the search.
enum class AlignStart {
    /// As the meshes lie.
    placed,
    /// By centroids, sizes and principal axes: the best of the 24 ways to put the axes on each
    /// other
    /// without a mirror, each tried with a few steps.
    axes,
};

struct AlignOptions {
    AlignStart start = AlignStart::placed;
    /// Whether the mesh is scaled too.
    bool scale = false;
    /// Part of the points that have a counterpart on the other surface, above 0, at most 1: those
    /// farthest from it do not count.
    double overlap = 1.0;
    /// Points on each surface that are used.
    Index samples = 2000;
    /// Greatest number of steps.
    Index iterations = 60;
};

struct AlignReport {
    /// The similarity that puts the mesh onto the target.
    Affine transform;
    double scale = 1.0;
    /// RMS distance of the points that count from the other surface, at the start and now; and the
    /// greatest now.
    double residual_before = 0.0, residual = 0.0, greatest = 0.0;
    Index iterations = 0;
    /// Whether the last step moved the mesh by less than a millionth of its size.
    bool converged = false;
};

/// Returns the rigid motion, or similarity, that brings `mesh` nearest to `target`, by iterated
/// closest points (Besl and McKay 1992) with distances to tangent planes (Chen and Medioni 1992).
/// Points of either surface look for the other, so that a scaled mesh does not shrink into a part
/// of the target; with an overlap below 1 only the best of them count (Chetverikov et al. 2002).
/// The surfaces should start within a part of their size, or with the axes. Errors: mesh_empty if a
/// surface has no faces; invalid_argument for options out of range or a surface without area;
/// memory_limit; cancelled.
AlignReport align(const Mesh& mesh, const Mesh& target, const AlignOptions& options = {},
                  const Context& context = {});

}  // namespace lissom
