/// Vertices of a surface that moves, made fast: normals are summed over faces, weighted by their
/// angle, in single precision, and creases stay in place.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "viewer/render/draw/surface_arrays.h"

namespace lissom {

/// Entries of surface_vertices that have one normal in common.
struct NormalGroups {
    std::vector<Index> of_entry;
    Index count = 0;
};

/// Returns groups of entries: for flat shading those of each face; else those at one vertex with
/// equal normals in `vertices`, made by surface_vertices of `triangles`.
NormalGroups normal_groups(const SurfaceTriangles& triangles,
                           std::span<const SurfaceVertex> vertices, Shading shading);

/// A corner of a triangle; its normal is packed as GL_INT_2_10_10_10_REV, ten bits a part.
struct QuickVertex {
    std::array<float, 3> position;
    std::uint32_t normal;
};

/// Writes the vertices of surface_vertices for `mesh` in the picture, with normals in single
/// precision.
void quick_surface_vertices(const Mesh& mesh, const Affine& to_picture,
                            const SurfaceTriangles& triangles, const NormalGroups& groups,
                            std::vector<QuickVertex>& result);

}  // namespace lissom
