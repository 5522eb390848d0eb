/// Kinds of seams, and measures of them: how well a seam is hidden, and how it was sewn.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// The side of a seam that a face comes from.
enum class SeamSide : char { target, source };

/// Form in which two meshes meet at a seam.
enum class SeamKind {
    /// The seam runs along the target's loop: vertices of either loop are inserted into the faces
    /// of the other side.
    conform,
    /// Like `conform`; the caller bends the surface around the seam afterwards.
    fair,
    /// One band of target faces along the loop is replaced by triangles of least area between the
    /// rest of the target and the source's loop, which becomes the seam (the thesis's).
    band,
};

/// Measures of seams; angles in radians. Faces without area do not count in dihedral angles.
struct SeamQuality {
    /// Dihedral angles across the seam's edges: the greatest, and the RMS weighted by edge length.
    double max_dihedral = 0.0, rms_dihedral = 0.0;
    /// The greatest dihedral angle among edges with an end on the seam or next to it.
    double max_near = 0.0;
    /// Angles of triangles with a vertex on the seam: the smallest, and the 5th percentile of each
    /// triangle's smallest.
    double smallest_angle = 0.0, low_angle = 0.0;
    /// The smallest angle that the polygons with a vertex on the seam have once they are divided;
    /// 0 without any.
    double polygon_angle = 0.0;
    /// Vertices of the seams, and the mean length of their edges.
    Index vertices = 0;
    double mean_edge = 0.0;
};

/// Measures of sewing two meshes.
struct SewReport {
    /// Vertices of the source's loops that were inserted into faces of the target, and the other
    /// way round, over all joins.
    Index inserted_into_target = 0, inserted_into_source = 0;
    /// Vertices of the source's loops that became one with a vertex of the target, and that were
    /// drawn into another of the source, because they were close.
    Index snapped = 0, collapsed = 0;
    Index flipped = 0;
    /// Umbrella steps that were made.
    Index smoothed = 0;
    /// Faces of the target that `band` removed, and those it made.
    Index band_removed = 0, band_added = 0;
    /// Faces that collars took the place of, and the triangles of the collars.
    Index collar_removed = 0, collar_added = 0;
    /// The seam before and after smoothing.
    SeamQuality before, after;
};

/// Measures closed loops of vertices of `mesh` that are joined by edges. The time depends on the
/// size of the seams only.
/// Errors: out_of_range; invalid_argument if two consecutive vertices share no edge.
SeamQuality seam_quality(const Mesh& mesh, std::span<const std::vector<Index>> seams);

}  // namespace lissom
