/// The band of a surface that seam fairing and transitions bend, and the system that bends it;
/// private to kernel/merge.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/patch/operators.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/mesh/measure/morph_maps.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"
#include "kernel/solve/sparse/sparse_matrix.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {

/// A band takes the shape whose Laplacian coordinates are nearest to wanted ones, in the least
/// squares weighted by area: min over x of sum A_i |L x - d_i|^2, with the pointwise cotangent
/// Laplacian L. All vertices outside the band stay. Its size and work follow the band, not the
/// mesh.
///
/// Local vertices are those of a region and of two rings around it. Rows are those of the region
/// and of one ring around it: vertices with known operators and with terms in the energy.
class BandSystem {
  public:
    /// The vertices of `band`, which must be some of `region`, move; each connected part of them
    /// needs a neighbour that does not.
    BandSystem(const Region& region, const Region& band, std::span<const Vec3> positions);

    /// Adds the morph targets of `mesh`, whose vertices are those of `positions`, as shapes 1, 2,
    /// ... beside the positions, shape 0. The band's steps move all of them by the weights of shape
    /// 0, and `write` and `write_guarded` write them.
    void take_morphs(const Mesh& mesh);
    Index shape_count() const { return 1 + count_of(morphs_); }
    /// Positions relative to a vertex of the band, or displacements.
    const std::vector<Vec3>& shape(Index s) const { return s == 0 ? x_ : morphs_[at(s - 1)].x; }
    void set_shape(Index s, std::vector<Vec3> x) {
        (s == 0 ? x_ : morphs_[at(s - 1)].x) = std::move(x);
    }

    Index vertex_count() const { return patch_.real_count; }
    Index mesh_vertex(Index i) const { return patch_.mesh_vertex[at(i)]; }
    bool moves(Index i) const { return unknown_[at(i)] != kNoIndex; }
    bool is_row(Index i) const { return row_[at(i)] != 0; }
    bool on_boundary(Index i) const { return patch_.on_boundary[at(i)] != 0; }
    std::span<const Index> ring(Index i) const { return rings_.ring(i); }
    /// (cot a + cot b) / 2 of the edge to each vertex of the ring.
    std::span<const double> cotangents(Index i) const {
        return {geometry_.cotangent.data() + rings_.begin[at(i)], at(rings_.count(i))};
    }

    /// Position relative to a vertex of the band. After a change of shape 0, `measure` brings the
    /// operators up to date.
    const Vec3& position(Index i) const { return x_[at(i)]; }

    /// Takes the operators from the present shape.
    void measure();
    /// Laplacian coordinates, unit normal and signed mean curvature (the part of the coordinates
    /// along the normal) of a row in the shape last measured.
    Vec3 coordinates(Index i, Index s = 0) const { return laplacian_.apply(rings_, shape(s), i); }
    const Vec3& normal(Index i) const { return geometry_.normal[at(i)]; }
    double curvature(Index i, Index s = 0) const { return coordinates(i, s).dot(normal(i)); }
    /// Returns, for each shape, the curvature of every row, 0 for other local vertices.
    std::vector<std::vector<double>> curvatures() const;

    /// Moves the band to the wanted coordinates of each shape, one for each local vertex, of which
    /// those of rows count, and measures it.
    /// Errors: not_positive_definite; memory_limit; cancelled: the shape is then as before.
    void bend(std::span<const std::vector<Vec3>> wanted, const Context& context);

    /// Gives the mesh the positions of the band as far as that does no harm to `seams`, with
    /// dihedral angles as great as those of `allowed` (SeamGuard); all others stay to the bit.
    /// "normal" attributes turn with the surface. Returns the part of the way that was kept.
    /// Errors: cancelled; the mesh is then unchanged.
    double write_guarded(Mesh& mesh, std::span<const std::vector<Index>> seams,
                         const SeamQuality& allowed, const Context& context) const;
    /// The same without a guard: all of the way.
    void write(Mesh& mesh) const;

  private:
    struct Morph {
        std::string name;
        std::vector<Vec3> x;
    };

    SymmetricMatrix normal_matrix() const;
    std::vector<Vec3> with_curvatures(Index s, std::span<const Vec3> wanted) const;
    MorphColumns moved_morphs(const Mesh& mesh, std::span<const double> parts) const;

    Patch patch_;
    Rings rings_;
    std::vector<char> row_;
    // Unknown of each local vertex, or kNoIndex; numbered in their order.
    std::vector<Index> unknown_;
    std::vector<Vec3> x_;
    std::vector<Morph> morphs_;
    RingGeometry geometry_;
    Laplacian laplacian_;
    Index unknown_count_ = 0;
    SparseSystem system_;
};

}  // namespace lissom
