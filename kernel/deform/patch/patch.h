/// Patch: the piece of a mesh that one deformation works on, with numbers of its own; private to
/// kernel/deform. Its size follows the region, not the mesh.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/patch/sparse_row.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// One-rings of a triangle list as flat arrays: ring(i) are the neighbours of i, ascending.
struct Rings {
    std::vector<Index> begin, neighbor;

    std::span<const Index> ring(Index i) const {
        return {neighbor.data() + begin[at(i)], neighbor.data() + begin[at(i + 1)]};
    }
    Index count(Index i) const { return begin[at(i + 1)] - begin[at(i)]; }
    Index size() const { return count_of(begin) - 1; }
    /// Position of neighbour j of i in the flat arrays.
    Index entry(Index i, Index j) const;
};

/// Triangles and how much each counts. A convex quad appears as the two triangles of either
/// diagonal, each counting one half, so that operators do not favour one diagonal; all others count
/// one. The four of a quad follow each other, before all others: the k-th has corners k, k + 1 and
/// k + 2 of the quad.
struct WeightedTriangles {
    std::vector<Triangle> triangle;
    std::vector<double> weight;
    /// The face that each is part of.
    std::vector<Index> face;

    std::size_t size() const { return triangle.size(); }
    void add(const Triangle& t, double w, Index part_of) {
        triangle.push_back(t);
        weight.push_back(w);
        face.push_back(part_of);
    }
};

/// The triangles of the given faces.
WeightedTriangles weighted_triangles(const Topology& topology, std::span<const Vec3> positions,
                                     std::span<const Index> faces);

Rings build_rings(Index vertex_count, const WeightedTriangles& triangles);

/// The region and as many rings around it as the stencils of free vertices reach.
///
/// Local vertices [0, mesh_count()) are vertices of the mesh. Up to `real_count` follow
/// those that a local refinement inserted (boundary_refinement.h), and up to `first_normal_point()`
/// virtual ones at the midpoint of the edge opposite a boundary vertex of valence 2 (section
/// 2.4.3), which exist in `split_triangles` only. Up to `surface_count` follow the points beside
/// flat vertices (normal_points.h) and, up to `vertex_count`, a preparation may add anchors
/// (ties.h); no triangle uses either.
struct Patch {
    Index real_count = 0, surface_count = 0, vertex_count = 0;
    /// Mesh vertex of each local vertex that the mesh has.
    std::vector<Index> mesh_vertex;
    /// For each vertex of a refinement, the vertices of the mesh that it is the mean of.
    std::vector<SparseRow> inserted;
    std::vector<char> in_region, on_boundary;
    /// Rest positions relative to `origin`, virtual vertices included.
    std::vector<Vec3> rest;
    Vec3 origin = Vec3::Zero();
    /// Triangles of the mesh's polygons, and the same with virtual vertices inserted.
    WeightedTriangles triangles, split_triangles;
    /// The flat vertex that each normal point belongs to.
    std::vector<Index> normal_points;
    /// Local number of each vertex of the region, in the region's order.
    std::vector<Index> of_region;
    /// Mesh vertices of the region all of whose faces have no area, and the number of zero-area
    /// faces.
    Elements zero_area_vertices{ElementKind::vertex, 0, {}};
    Index zero_area_faces = 0;

    Index mesh_count() const { return count_of(mesh_vertex); }
    Index first_normal_point() const { return surface_count - count_of(normal_points); }
    /// Whether the region has no virtual vertices.
    bool is_plain() const { return first_normal_point() == real_count; }
};

/// Mesh vertices of a patch in an order in which neighbours are near each other, so that loops over
/// one-rings find them in the cache: by breadth first. It follows from the faces alone.
std::vector<Index> near_order(const Region& region, Index rings);

/// Cuts the patch of `region` out of its mesh, `rings` rings wider than the region. Only the
/// positions of its vertices need to be right. They are numbered as in `order`, all of them, or
/// else ascending.
Patch build_patch(const Region& region, std::span<const Vec3> positions, Index rings,
                  std::vector<Index> order = {});

/// Makes `split_triangles` of `triangles`, with the virtual vertices behind the real ones.
void insert_virtual_vertices(Patch& patch);
inline Patch build_patch(const Mesh& mesh, const Region& region, Index rings) {
    return build_patch(region, mesh.positions(), rings);
}

}  // namespace lissom
