/// Trimming: a jagged open boundary becomes a smooth one.
#pragma once

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/path.h"

namespace lissom {

struct TrimOptions {
    /// Smoothness: standard deviation of the Gaussian that smooths the loop, as a fraction of its
    /// length; above 0, at most 0.1. Halved, up to three times, if a loop with sharp turns has no
    /// smooth line beside it.
    double smoothing = 0.04;
    /// Distance of the new boundary from the innermost vertex of the old one, in mean edge lengths
    /// there; at least 0.
    double margin = 0.15;
    /// Same as CutOptions::slide.
    double slide = 0.25;
};

struct Trim {
    Mesh mesh;
    MeshMap map;
    /// The new boundary, with the surface on its left.
    Path boundary;
    /// Mean turn of the boundary before and after, in radians.
    double turn_before = 0.0, turn_after = 0.0;
    /// The smoothing that was used.
    double smoothing = 0.0;
    /// Old faces that are gone and that were divided.
    Index removed_faces = 0, divided_faces = 0;
};

/// Cuts a thin strip off along an open boundary. The loop is smoothed; the new boundary is the line
/// on the surface at a constant distance from the smooth loop, so far inside that it meets no
/// vertex of the old one. The rest is as after `cut`. Errors: topology_mismatch; not_a_boundary;
/// invalid_argument for options out of range; boundary_conflict if the strip meets another boundary
/// or leaves nothing; nonmanifold_edge; cancelled.
Trim trim(const Mesh& mesh, const Path& boundary, const TrimOptions& options = {},
          const Context& context = {});

/// Mean angle, in radians, by which a path turns at its points: near 0 for a smooth one, 0.5 and
/// more for one along the edges of triangles. 0 for a path without a turn.
/// Errors: topology_mismatch.
double mean_turn(const Mesh& mesh, const Path& path);

}  // namespace lissom
