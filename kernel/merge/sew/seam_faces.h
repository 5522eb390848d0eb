/// The faces around seams while they are sewn; private to kernel/merge.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// A corner of a face of the patch. It comes from the corner `first` of the mesh, or lies `t` of
/// the way from there to the corner `second`.
struct SeamCorner {
    Index vertex = kNoIndex;
    Index first = kNoIndex, second = kNoIndex;
    double t = 0.0;
};

/// A face of the patch, which is or was cut out of the face `origin` of the mesh. A removed one has
/// no corners.
struct SeamFace {
    std::vector<SeamCorner> corners;
    Index origin = kNoIndex;
};

/// The faces of a mesh within a few rings of its seams, with the edges between them. The mesh is
/// the target and after it the source, not yet connected. Invariant: each directed edge has at most
/// one face on each side.
class SeamFaces {
  public:
    /// Vertices at most this many edges away from a loop have all of their faces here.
    static constexpr Index kRings = 2;

    /// Those of `mesh` around `loop_vertices`; faces from `first_source_face` on are the source's.
    /// The mesh must outlive them.
    SeamFaces(const Mesh& mesh, Index first_source_face, std::span<const Index> loop_vertices);

    const Mesh& mesh() const { return *mesh_; }
    const std::vector<SeamFace>& faces() const { return faces_; }
    /// Faces of the mesh that these stand for, ascending.
    const std::vector<Index>& origins() const { return origins_; }
    bool is_source(const SeamFace& face) const { return face.origin >= first_source_face_; }

    const Vec3& position(Index v) const;
    void move(Index v, const Vec3& to) { moved_[v] = to; }
    const std::unordered_map<Index, Vec3>& moved() const { return moved_; }

    /// Adds a face and returns its number.
    Index add(SeamFace face);
    /// Gives a face other corners; none to remove it.
    void replace(Index face, std::vector<SeamCorner> corners);
    /// Two at once, whose edges may change places.
    void replace_both(Index face, std::vector<SeamCorner> corners, Index other,
                      std::vector<SeamCorner> other_corners);
    /// Makes triangles of a face that is none.
    void triangulate(Index face);
    /// A vertex that no face has any more.
    void forget(Index v) { faces_at_.erase(v); }

    /// The face on the left of a directed edge, or kNoIndex: on either side, of the target (0) or
    /// of the source (1).
    Index left_of(Index from, Index to) const;
    Index left_of(Index from, Index to, std::size_t side) const;
    bool has_edge(Index a, Index b) const;
    /// Whether all faces at a vertex of the mesh are here.
    bool is_complete(Index v) const { return complete_.contains(v); }
    /// 0 for a vertex of the target, 1 for one of the source.
    std::size_t side_of(Index v) const;
    /// The faces at a vertex, in the order they came to it.
    std::vector<Index> faces_at(Index v) const;
    /// Vertices joined to `v` by an edge, ascending.
    std::vector<Index> neighbors(Index v) const;
    Vec3 area_vector(const SeamFace& face) const;
    /// Whether all corner attributes have the same values at two corners, up to rounding.
    bool same_values(const SeamCorner& p, const SeamCorner& q) const;

  private:
    static std::uint64_t key(Index from, Index to) { return pair_key(from, to); }
    std::unordered_map<std::uint64_t, Index>& edges_of(const SeamFace& face) {
        return edges_[is_source(face) ? 1 : 0];
    }
    void enter(Index face);
    void leave(Index face);

    const Mesh* mesh_;
    Index first_source_face_;
    std::vector<SeamFace> faces_;
    std::vector<Index> origins_;
    // The face on the left of each directed edge: of the target, of the source.
    std::array<std::unordered_map<std::uint64_t, Index>, 2> edges_;
    std::unordered_map<Index, std::vector<Index>> faces_at_;
    std::unordered_set<Index> complete_;
    std::unordered_map<Index, Vec3> moved_;
};

}  // namespace lissom
