/// TriangleEditor: a triangle mesh whose edges are collapsed, split and flipped, and that knows at
/// every corner which corners of the mesh as given it goes back to. Private to kernel/mesh.
///
/// The faces around a vertex between two lines (feature_lines.h) form a sector. The corners of a
/// sector share one origin, so that the two sides of a seam are never mixed.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"
#include "kernel/mesh/resample/surface_samples.h"

namespace lissom {

class TriangleEditor {
  public:
    struct Face {
        Triangle vertices{}, sectors{};
        /// Whether the edge from each vertex to the next is on a line.
        std::array<char, 3> lines{};
        /// The face of the mesh as given that it goes back to; kNoIndex once it is gone.
        Index origin = kNoIndex;

        bool alive() const { return origin != kNoIndex; }
    };
    /// Two vertices of an edge with its faces: `left` runs from `a` to `b`. One may be absent.
    struct Edge {
        Index a = kNoIndex, b = kNoIndex, left = kNoIndex, right = kNoIndex;
        bool on_line = false;
    };
    using Sources = std::vector<ElementMap::Source>;

    /// `mesh` consists of triangles; `lines` is a flag for each of its corners.
    TriangleEditor(const Mesh& mesh, const std::vector<char>& lines);

    const std::vector<Face>& faces() const { return faces_; }
    const std::vector<Vec3>& positions() const { return positions_; }
    const Vec3& position(Index v) const { return positions_[at(v)]; }
    /// The vertex goes to a place of its own: its attributes will be those of the nearest point of
    /// the surface as given.
    void move(Index v, const Vec3& position);
    /// Faces around a vertex, in no order; empty once the vertex is gone.
    const std::vector<Index>& fan(Index v) const { return fans_[at(v)]; }
    Index face_count() const { return face_count_; }
    Index sector_count() const { return count_of(sector_sources_); }
    Index corner_of_sector(Index sector) const { return sector_sources_[at(sector)][0].element; }

    /// Vertices held in place: they neither move nor vanish.
    void hold(Index v) { held_[at(v)] = 1; }
    /// Holds the vertices that have a face outside a region.
    void hold_outside(const Region& region);
    bool is_held(Index v) const { return held_[at(v)] != 0; }
    /// True if a vertex is on no line.
    bool is_inner(Index v) const { return line_counts_[at(v)] == 0 && !is_held(v); }
    /// True if one line passes through a vertex: it may vanish along the line.
    bool is_on_line(Index v) const { return line_counts_[at(v)] == 2 && !is_held(v); }

    /// For each face of the mesh as given, its part between lines.
    const std::vector<Index>& charts() const { return charts_; }

    Edge edge(Index a, Index b) const;
    /// Distinct vertices joined with `v` by an edge, in no order.
    void neighbors(Index v, std::vector<Index>& result) const;
    static Index place_of(const Face& face, Index v);

    /// True if the surface and its lines stay the same when `edge.b` merges into `edge.a`.
    bool can_collapse(const Edge& edge) const;
    /// Merges `edge.b` into `edge.a`, which stays where it is. Only if `can_collapse`.
    void collapse(const Edge& edge);
    /// True if a face of `v` without `other` turned by more than 78 degrees, or became a sliver,
    /// with `v` at `place`.
    bool turns_faces(Index v, Index other, const Vec3& place) const;
    /// Adds a vertex in the middle of an edge and returns it.
    Index split(const Edge& edge);
    /// True if the edge between two triangles may be turned into their other diagonal.
    bool can_flip(const Edge& edge) const;
    void flip(const Edge& edge);
    Index opposite(Index face, const Edge& edge) const;

    /// A mesh, and the sources of its elements.
    struct Result {
        Mesh mesh;
        MeshMap map;
    };
    /// Returns the mesh made; `source` is the mesh as given, and `samples` are of its charts.
    Result result(const Mesh& source, const SurfaceSamples& samples, const Context& context) const;

  private:
    Edge edge_from(Index a, Index b) const;
    Index sector_at(Index face, Index v) const;
    void make_sectors();
    void find_charts();
    void merge_lines(Index removed, const Edge& edge);
    void retarget(Index face, Index from, Index to, Index sector);
    void remove_from_fan(Index v, Index face);
    void split_face(Index face, const Edge& edge, Index middle, Index sector);
    Index split_sector(Index face, const Edge& edge);
    Sources blended(const Sources& a, const Sources& b) const;

    std::vector<Vec3> positions_;
    std::vector<char> moved_, held_;
    std::vector<Index> line_counts_;
    std::vector<Face> faces_;
    std::vector<std::vector<Index>> fans_;
    // Of vertices and sectors that have not moved.
    std::vector<Sources> vertex_sources_, sector_sources_;
    std::vector<Index> charts_;
    Index face_count_ = 0;
    mutable std::vector<Index> scratch_a_, scratch_b_;
};

}  // namespace lissom
