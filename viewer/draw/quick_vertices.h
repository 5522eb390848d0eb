/// Vertices of a surface that moves, made fast: normals are summed over faces, weighted by their
/// area, in single precision, and creases stay where they were.
#pragma once

#include <span>
#include <vector>

#include "viewer/draw/surface_arrays.h"

namespace lissom {

/// Entries of surface_vertices that have one normal in common.
struct NormalGroups {
    std::vector<Index> of_entry;
    Index count = 0;
};

/// Of flat shading the entries of each face; else those at one vertex whose normals are the same in
/// `vertices`, made by surface_vertices of `triangles`.
NormalGroups normal_groups(const SurfaceTriangles& triangles,
                           std::span<const SurfaceVertex> vertices, Shading shading);

/// What surface_vertices makes of `mesh` where the picture has it, but for the way normals are
/// weighted.
void quick_surface_vertices(const Mesh& mesh, const Affine& to_picture,
                            const SurfaceTriangles& triangles, const NormalGroups& groups,
                            std::vector<SurfaceVertex>& result);

}  // namespace lissom
