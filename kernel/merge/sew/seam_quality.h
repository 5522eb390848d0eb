/// How well a seam is hidden: angles across it and around it.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Measures of seams; angles in radians. Faces without area do not count in dihedral angles.
struct SeamQuality {
    /// Dihedral angles across the seam's edges: the greatest, and the RMS weighted by edge length.
    double greatest_dihedral = 0.0, rms_dihedral = 0.0;
    /// The greatest dihedral angle among edges with an end on the seam or next to it.
    double greatest_near = 0.0;
    /// Angles of triangles with a vertex on the seam: the smallest, and the 5th percentile of each
    /// triangle's smallest.
    double smallest_angle = 0.0, low_angle = 0.0;
    /// Vertices of the seams, and the mean length of their edges.
    Index vertices = 0;
    double mean_edge = 0.0;
};

/// Measures closed loops of vertices of `mesh` that are joined by edges. The time depends on the
/// size of the seams only.
/// Errors: out_of_range; invalid_argument if two consecutive vertices share no edge.
SeamQuality seam_quality(const Mesh& mesh, std::span<const std::vector<Index>> seams);

}  // namespace lissom
