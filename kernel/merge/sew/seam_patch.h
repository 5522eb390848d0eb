/// The faces around seams before and after both sides are connected; private to kernel/merge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/sew/seam_faces.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {

/// Target and source, whose loops get each other's vertices until they are the same. `close` makes
/// it a ClosedPatch.
class SplitPatch {
  public:
    /// Takes the arguments of SeamFaces.
    SplitPatch(const Mesh& mesh, Index first_source_face, std::span<const Index> loop_vertices)
        : faces_(mesh, first_source_face, loop_vertices) {}

    /// Puts a vertex elsewhere.
    void move(Index v, const Vec3& to) { faces_.move(v, to); }
    /// Inserts vertices, in order, between the ends of a boundary edge of the mesh, at the given
    /// fractions of it. Its face becomes a fan of triangles.
    void split_edge(Index from, Index to, std::span<const Index> vertices,
                    std::span<const double> fractions);
    /// Takes away the faces that stand for those of the mesh in `origins`.
    void remove(const std::set<Index>& origins);
    void add(SeamFace face) { faces_.add(std::move(face)); }
    /// Puts vertex `into` of the target in the place of vertex `v` of the source.
    void merge_vertex(Index v, Index into);
    /// Contracts the boundary edge between two vertices to `kept`; the face along it loses a corner
    /// or, being a triangle, vanishes. Returns false, and changes nothing, if the result would not
    /// be a manifold or a face would turn over.
    bool collapse(Index gone, Index kept);

    const SeamFaces& faces() const { return faces_; }
    /// Returns the faces for `close`.
    SeamFaces take() && { return std::move(faces_); }

  private:
    bool can_collapse(Index face, Index gone, Index kept) const;

    SeamFaces faces_;
};

/// One surface. Only its edges change: those of the seams stay.
class ClosedPatch {
  public:
    /// `seams` are closed loops of vertices whose edges have a face on each side.
    /// Errors: nonmanifold_edge if both sides join two seam vertices by an inner edge and neither
    /// can do without it.
    ClosedPatch(SeamFaces faces, std::span<const std::vector<Index>> seams);

    const SeamFaces& faces() const { return faces_; }

    /// Leaves the edges within two rings of these vertices as they are in `flip_edges`.
    void keep_edges_near(std::span<const Index> vertices);

    /// Flips edges between triangles of one side if that makes the smallest angle greater, but
    /// makes no dihedral angle greater than `allowed_dihedral` (radians), the greatest of the
    /// patch, and the greatest of the edges concerned; angles across the seam count by themselves.
    /// Edges with different corner attributes or labels on their sides stay. Nothing is flipped if
    /// faces of the patch would run through one another that did not. Returns how many flips there
    /// were.
    Index flip_edges(double allowed_dihedral, const Context& context);

  private:
    // An edge from a to c with a triangle on its left, which has d, and on its right, which has b.
    struct Diagonal {
        Index left, right;
        SeamCorner a, b, c, d;
    };
    // Greatest dihedral angles, across the seams and elsewhere.
    struct Dihedrals {
        double seam = 0.0, other = 0.0;
    };

    bool is_on_seam(Index a, Index b) const;
    void separate_inner_edges();
    bool find_diagonal(Index a, Index c, std::size_t side, Diagonal& diagonal) const;
    bool can_flip(const Diagonal& diagonal) const;
    bool is_kept(const Diagonal& diagonal) const;
    std::vector<FacePair> crossings(const Context& context) const;
    Dihedrals max_dihedrals() const;
    void add_dihedral(Index from, Index to, const Vec3& normal, Dihedrals& greatest) const;
    bool improves(const Diagonal& diagonal, const Dihedrals& allowed) const;
    void flip(const Diagonal& diagonal);
    Index flip_all_once(const Dihedrals& allowed);
    bool same_chart(const Diagonal& diagonal) const;

    SeamFaces faces_;
    std::unordered_set<std::uint64_t> seam_edges_;
    // Ascending.
    std::vector<Index> seam_vertices_;
    std::unordered_set<Index> kept_;
};

/// Ends the splitting. Errors: as ClosedPatch.
inline ClosedPatch close(SplitPatch&& split, std::span<const std::vector<Index>> seams) {
    return {std::move(split).take(), seams};
}

}  // namespace lissom
