/// The faces around seams while they are sewn; private to kernel/merge.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {

/// A corner of a face of the patch. It comes from the corner `first` of the mesh, or lies `t` of
/// the way from there to the corner `second`.
struct SeamCorner {
    Index vertex = kNoIndex;
    Index first = kNoIndex, second = kNoIndex;
    double t = 0.0;
};

/// A face of the patch, which is or was cut out of the face `origin` of the mesh. Without corners
/// where it was removed.
struct SeamFace {
    std::vector<SeamCorner> corners;
    Index origin = kNoIndex;
};

/// The faces of a mesh within a few rings of its seams. The mesh is the target and after it the
/// source, not yet connected. Invariant: each directed edge has at most one face on each side.
class SeamPatch {
  public:
    /// Vertices at most this many edges away from a loop have all of their faces in the patch.
    static constexpr Index kRings = 2;

    /// The patch of `mesh` around `loop_vertices`; faces from `first_source_face` on are the
    /// source's. The mesh must outlive the patch.
    SeamPatch(const Mesh& mesh, Index first_source_face, std::span<const Index> loop_vertices);

    const Mesh& mesh() const { return mesh_; }
    const std::vector<SeamFace>& faces() const { return faces_; }
    /// Faces of the mesh that the patch stands for, ascending.
    const std::vector<Index>& origins() const { return origins_; }
    bool is_source(const SeamFace& face) const { return face.origin >= first_source_face_; }

    const Vec3& position(Index v) const;
    void move(Index v, const Vec3& to) { moved_[v] = to; }
    const std::unordered_map<Index, Vec3>& moved() const { return moved_; }

    /// Inserts vertices, in order, between the ends of a boundary edge of the mesh, at the given
    /// fractions of it. Its face becomes a fan of triangles.
    void split_edge(Index from, Index to, std::span<const Index> vertices,
                    std::span<const double> fractions);
    /// Takes away the faces that stand for those of the mesh in `origins`.
    void remove(const std::set<Index>& origins);
    /// Adds a face and returns its number.
    Index add(SeamFace face);
    /// The face on the left of a directed edge, or kNoIndex.
    Index left_of(Index from, Index to) const;
    /// Puts vertex `into` of the target in the place of vertex `v` of the source.
    void merge_vertex(Index v, Index into);
    /// Contracts the boundary edge between two vertices to `kept`; the face along it loses a corner
    /// or, being a triangle, vanishes. False, and nothing is changed, where the result would not be
    /// a manifold or a face would turn over.
    bool collapse(Index gone, Index kept);
    /// Ends the splitting: `seams` are closed loops of vertices whose edges now have a face on each
    /// side.
    /// Errors: nonmanifold_edge where both sides join two seam vertices by an inner edge and
    /// neither can do without it.
    void close(std::span<const std::vector<Index>> seams);

    /// Flips edges between triangles of one side where that makes the smallest angle greater, but
    /// makes no dihedral angle greater than `allowed_dihedral` (radians), the greatest of the
    /// patch, and the greatest of the edges concerned; angles across the seam count by themselves.
    /// Edges with different corner attributes or labels on their sides stay. Nothing is flipped
    /// where faces of the patch would run through one another that did not. Returns how many flips
    /// there were.
    Index flip_edges(double allowed_dihedral, const Context& context);

    /// The vertices of all seams, ascending.
    const std::vector<Index>& seam_vertices() const { return seam_vertices_; }
    /// Vertices joined to `v` by an edge, ascending.
    std::vector<Index> neighbors(Index v) const;
    /// True where `v` lies on a boundary that stays open.
    bool is_open(Index v) const;

  private:
    // An edge from a to c with a triangle on its left, which has d, and on its right, which has b.
    struct Diagonal {
        Index left, right;
        SeamCorner a, b, c, d;
    };

    static std::uint64_t key(Index from, Index to) {
        return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(from)) << 32) |
               static_cast<std::uint32_t>(to);
    }
    std::unordered_map<std::uint64_t, Index>& edges_of(const SeamFace& face) {
        return edges_[is_source(face) ? 1 : 0];
    }
    Index left_of(Index from, Index to, std::size_t side) const;
    bool has_edge(Index a, Index b) const;
    bool is_complete(Index v) const;
    // 0 for a vertex of the target, 1 for one of the source.
    std::size_t side_of(Index v) const;

    void enter(Index face);
    void leave(Index face);
    void replace(Index face, std::vector<SeamCorner> corners);
    void triangulate(Index face);

    bool can_collapse(Index face, Index gone, Index kept) const;
    void separate_inner_edges();
    bool find_diagonal(Index a, Index c, std::size_t side, Diagonal& diagonal) const;
    bool can_flip(const Diagonal& diagonal) const;
    // Greatest dihedral angles, across the seams and elsewhere.
    struct Dihedrals {
        double seam = 0.0, other = 0.0;
    };
    std::vector<FacePair> crossings(const Context& context) const;
    Dihedrals greatest_dihedrals() const;
    void add_dihedral(Index from, Index to, const Vec3& normal, Dihedrals& greatest) const;
    bool improves(const Diagonal& diagonal, const Dihedrals& allowed) const;
    void flip(const Diagonal& diagonal);
    Index flip_all_once(const Dihedrals& allowed);
    bool same_chart(const Diagonal& diagonal) const;
    bool same_values(const SeamCorner& p, const SeamCorner& q) const;
    Vec3 area_vector(const SeamFace& face) const;

    const Mesh& mesh_;
    Index first_source_face_;
    std::vector<SeamFace> faces_;
    std::vector<Index> origins_;
    // The face on the left of each directed edge: of the target, of the source.
    std::array<std::unordered_map<std::uint64_t, Index>, 2> edges_;
    std::unordered_map<Index, std::vector<Index>> faces_at_;
    std::unordered_set<Index> complete_;
    std::unordered_map<Index, Vec3> moved_;
    std::unordered_set<std::uint64_t> seam_edges_;
    std::vector<Index> seam_vertices_;
};

}  // namespace lissom
