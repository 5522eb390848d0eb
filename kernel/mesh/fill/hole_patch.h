/// The triangles that close a hole, while they are made; private to kernel/mesh.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// A patch of triangles over vertices of a mesh and new ones, which are numbered after those of the
/// mesh. Invariant: with the mesh's faces, the triangles form a manifold wherever both are
/// complete; no edge is added that the mesh or the patch has.
class HolePatch {
  public:
    explicit HolePatch(const Mesh& mesh) : mesh_(mesh) {}

    const Mesh& mesh() const { return mesh_; }
    const std::vector<Triangle>& triangles() const { return triangles_; }
    Index new_vertex_count() const { return count_of(new_positions_); }
    const std::vector<Vec3>& new_positions() const { return new_positions_; }
    /// Returns the mean that each new vertex was put at, of positions or displacements of the
    /// mesh's vertices: those of the new ones after them.
    std::vector<Vec3> with_middles(std::vector<Vec3> x) const;
    /// Mesh vertices that a new vertex blends, with weights.
    const std::vector<ElementMap::Source>& sources(Index new_vertex) const {
        return sources_[at(new_vertex)];
    }
    const Vec3& position(Index v) const {
        return v < mesh_.vertex_count() ? mesh_.position(v)
                                        : new_positions_[at(v - mesh_.vertex_count())];
    }

    void add_triangle(Index a, Index b, Index c);
    /// A new vertex in the middle of `around`, which may be old and new ones. Returns its id.
    Index add_middle_vertex(std::span<const Index> around);
    /// Returns true if the mesh or the patch has an edge between `a` and `b`.
    bool has_edge(Index a, Index b) const;
    Vec3 normal(Index triangle) const;

    /// Splits triangles at their centers and flips edges until the patch is `density` times as
    /// dense as the mesh around `loop` (Liepa 2003, section 4). Returns false if it stopped at
    /// `maximum_vertices`.
    bool refine(std::span<const Index> loop, double density, Index maximum_vertices,
                const Context& context);

  private:
    bool split_large_triangles(Index maximum_vertices, const Context& context);
    void split(Index triangle);
    void relax(std::vector<std::pair<Index, Index>> edges, const Context& context);
    bool flip_if_better(Index a, Index b);
    void set_triangle(Index triangle, const Triangle& vertices);
    Index triangle_at(Index from, Index to) const;
    double& spacing(Index v) { return spacing_[v]; }
    double mean_edge_length(Index v) const;

    static std::uint64_t key(Index from, Index to) { return pair_key(from, to); }

    const Mesh& mesh_;
    std::vector<Triangle> triangles_;
    std::vector<Vec3> new_positions_;
    // The vertices that each new one is in the middle of.
    std::vector<std::vector<Index>> around_;
    std::vector<std::vector<ElementMap::Source>> sources_;
    // The triangle on the left of each directed edge.
    std::unordered_map<std::uint64_t, Index> left_;
    // Length of edges wanted at a vertex.
    std::unordered_map<Index, double> spacing_;
};

}  // namespace lissom
