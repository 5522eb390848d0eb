/// Topology: the immutable connectivity of an oriented 2-manifold polygon mesh, with or without
/// boundary. Meshes share it; regions, paths and handles hold the one they were made for, so that
/// use after a change of topology is recognised.
///
/// Invariants: every face has at least three different vertices; every directed edge belongs to at
/// most one face; the faces around a vertex form one fan. Vertices without faces are allowed.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/core/memory_hold.h"

namespace OpenMesh {
class PolyConnectivity;
}

namespace lissom {

/// Polygons as one flat list: face f has the vertices[offsets[f]] .. vertices[offsets[f + 1] - 1].
struct FaceList {
    std::vector<Index> offsets{0};
    std::vector<Index> vertices;

    Index size() const { return count_of(offsets) - 1; }
    std::span<const Index> operator[](Index f) const {
        return {vertices.data() + offsets[at(f)], vertices.data() + offsets[at(f + 1)]};
    }
    void add(std::span<const Index> face) {
        vertices.insert(vertices.end(), face.begin(), face.end());
        offsets.push_back(count_of(vertices));
    }
    void add(std::initializer_list<Index> face) { add(std::span(face.begin(), face.size())); }
};

class Topology {
  public:
    /// Validates `faces` and builds the connectivity. Faces and vertices keep their order. Errors,
    /// each naming all elements concerned: face_index, face_too_small, repeated_vertex,
    /// duplicate_face, nonmanifold_edge, inconsistent_orientation, nonmanifold_vertex; also
    /// cancelled, memory_limit. Its memory counts on the account of the context, once for any
    /// number of meshes that share it.
    static std::shared_ptr<const Topology> create(Index vertex_count, FaceList faces,
                                                  const Context& context = {});
    /// Returns the same for faces that are known to be a manifold. `twin` pairs the corners: for
    /// each, the one that runs along its edge the other way, or kNoIndex on a boundary.
    static std::shared_ptr<const Topology> create_paired(Index vertex_count, FaceList faces,
                                                         const std::vector<Index>& twin,
                                                         const Context& context = {});
    ~Topology();
    Topology(const Topology&) = delete;
    Topology& operator=(const Topology&) = delete;

    Index vertex_count() const { return vertex_count_; }
    Index face_count() const { return faces_.size(); }
    Index corner_count() const { return count_of(faces_.vertices); }
    Index edge_count() const { return index_of(edges_.size() / 2); }

    const FaceList& faces() const { return faces_; }
    /// Vertices of face `f`, counter-clockwise seen from outside.
    std::span<const Index> face(Index f) const { return faces_[f]; }
    /// First corner of face `f`: corner `first_corner(f) + k` is face f at vertex `face(f)[k]`.
    Index first_corner(Index f) const { return faces_.offsets[at(f)]; }

    /// Returns one-ring of `v`: the vertices joined to it by an edge, counter-clockwise. At a
    /// boundary vertex it starts at the boundary, so that consecutive neighbours share a face with
    /// `v`.
    std::span<const Index> neighbors(Index v) const {
        return {ring_.data() + ring_begin_[at(v)], ring_.data() + ring_begin_[at(v + 1)]};
    }
    /// Faces around `v`, counter-clockwise: the i-th lies between neighbours i and i + 1.
    std::span<const Index> faces_around(Index v) const {
        return {fan_.data() + fan_begin_[at(v)], fan_.data() + fan_begin_[at(v + 1)]};
    }
    Index valence(Index v) const { return ring_begin_[at(v + 1)] - ring_begin_[at(v)]; }
    /// True if `v` lies on an open boundary. Vertices without faces do not.
    bool is_boundary(Index v) const {
        return fan_begin_[at(v + 1)] - fan_begin_[at(v)] < valence(v);
    }
    bool is_isolated(Index v) const { return valence(v) == 0; }
    bool is_closed() const { return boundary_edge_count_ == 0; }
    bool is_triangle_mesh() const { return triangle_mesh_; }

    /// Vertices of edge `e`, in the direction of the first face that uses it.
    std::pair<Index, Index> edge(Index e) const {
        return {edges_[at(2 * e)], edges_[at(2 * e + 1)]};
    }
    Index boundary_edge_count() const { return boundary_edge_count_; }

    /// Open boundaries, each a loop of vertices in the direction of the faces next to it (surface
    /// on the left), starting at its smallest vertex; ordered by that vertex.
    const std::vector<std::vector<Index>>& boundary_loops() const { return boundary_loops_; }

    /// Connected component of every vertex, numbered by smallest vertex; a vertex without faces is
    /// a component of its own.
    const std::vector<Index>& components() const { return components_; }
    Index component_count() const { return component_count_; }

    /// Returns the half-edge structure, for algorithms that walk it. Halfedge 2e runs along
    /// `edge(e)`.
    const OpenMesh::PolyConnectivity& halfedges() const { return *halfedges_; }

    /// Bytes held.
    std::size_t memory_bytes() const;
    /// Returns the account that it counts on, and with it meshes and regions that are made on it.
    const std::shared_ptr<MemoryAccount>& account() const { return hold_.account(); }

  private:
    explicit Topology(MemoryHold hold);

    void build_halfedges(const std::vector<Index>& twin);
    void build_rings();
    void build_boundary_loops();
    void build_components();

    MemoryHold hold_;
    Index vertex_count_ = 0;
    FaceList faces_;
    std::vector<Index> edges_;
    std::vector<Index> ring_begin_, ring_, fan_begin_, fan_;
    std::vector<std::vector<Index>> boundary_loops_;
    std::vector<Index> components_;
    Index component_count_ = 0;
    Index boundary_edge_count_ = 0;
    bool triangle_mesh_ = true;
    std::unique_ptr<OpenMesh::PolyConnectivity> halfedges_;
};

/// Throw out_of_range, naming them, if some of the vertices or faces do not exist.
void require_vertices(const Topology& topology, std::span<const Index> vertices);
void require_faces(const Topology& topology, std::span<const Index> faces);

}  // namespace lissom
