/// The second system: positions from the rotations, or rotations and scales, of the deformation
/// gradients (section 2.4.4, Eq 2.10 and 2.11); private to kernel/deform.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/deform/patch/ties.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/deform/system/frame_loops.h"
#include "kernel/deform/system/ordered_system.h"
#include "kernel/solve/sparse/single_factor.h"
#include "kernel/solve/sparse/sparse_matrix.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {

/// Minimises, over the free positions x and on the undisplaced rest shape v,
///   e  sum over edges of w_ij |(x_i - x_j) - (S_i + S_j) (v_i - v_j) / 2|^2
/// + l2 sum over vertices of a_i |D(x)_i - S_i D(v)_i|^2
/// with e = 0, l2 = 1 for `laplacian`; e = 1, l2 = 0 for `poisson`; and e = 1, l2 = (0.06 R)^2, at
/// least (3 h)^2, near held vertices for `blend` (R is the radius of the region's surface, h its
/// mean edge length); away from them l fades to a twelfth. With D = -F C for a diagonal F and the
/// Laplacian C of symmetric coefficients, its matrix is K = W + C G C, the Laplacian of edge
/// weights and that of rows G = l2 A F^2.
class RotationSystem {
  public:
    /// Buffers of a solve, sized as needed; kept by the caller because a frame is short beside the
    /// time to get fresh pages.
    struct Scratch {
        std::vector<Vec4> bending, step, parts;
        std::vector<Vec3> residual, change, correction, forces;
        std::vector<double> columns;
        SingleFactor::Scratch single;
    };

    RotationSystem(const WorkingPatch& work, const std::vector<char>& position_known,
                   const DeformOptions& options, const Context& context);

    /// `former` is the result of release() of a system of the same region. Errors:
    /// not_positive_definite with rows as elements; memory_limit.
    void factor(const Context& context, OrderedSystem former);
    /// The same for a system without a next one, in an order of its own.
    void factor(const Context& context) {
        order_ = {};
        factor(context, {});
    }
    /// Its factor, for the next system; this one is of no more use.
    OrderedSystem release() { return std::move(system_); }
    /// Follows `factor`: keeps the factor in single precision, unless the system is too
    /// ill-conditioned for that. Errors: memory_limit.
    void finish(const Context& context);

    const std::vector<Index>& free_vertices() const { return free_; }
    const FactorStats& stats() const { return stats_; }
    const Rings& rings() const { return rings_; }

    /// Finds the free positions for the transforms S_i of all real vertices. `x` holds the known
    /// positions, those of anchors among them, and a guess of the free ones. Linear in both:
    /// deviations of S_i from one S give deviations of the positions from S v + t. With `draft`,
    /// one correction of the guess, about five digits; else as many as nearly full precision takes.
    /// No transforms stand for zeros. Several threads may solve at the same time, each with scratch
    /// of its own.
    void solve(std::span<const PaddedMat3> transforms, std::span<Vec4> x, bool draft,
               Scratch& scratch, const Context& context) const;
    void solve(std::span<const PaddedMat3> transforms, std::span<Vec4> x, bool draft,
               const Context& context) const {
        Scratch scratch;
        solve(transforms, x, draft, scratch, context);
    }

    /// Goes on from a solution with `draft`, in `x` and as left in `scratch`, to that without, to
    /// the bit. Not for a system with ties.
    void finish_draft(std::span<Vec4> x, Scratch& scratch, const Context& context) const;

    /// Adds to `x`, positions of all local vertices, how the free ones answer to forces on them, to
    /// nearly full precision. `force` has an entry for each free vertex; hard ties hold at zero.
    void answer(std::span<const Vec3> force, std::span<Vec4> x, Scratch& scratch,
                const Context& context) const;

    /// The sum over `vertices` of half the downward gradient of the energy without its ties, at
    /// positions x. Null transforms stand for zeros.
    Vec3 force(const PaddedMat3* transforms, std::span<const Vec4> x,
               std::span<const Index> vertices, Scratch& scratch, const Context& context) const;
    /// Returns `force` of each of several groups of vertices, for one pass over the surface.
    std::vector<Vec3> forces(const PaddedMat3* transforms, std::span<const Vec4> x,
                             std::span<const std::span<const Index>> groups, Scratch& scratch,
                             const Context& context) const;

    /// Coupling of known vertices that move together to the rest.
    struct Response {
        /// Position of each local vertex once `solve` has followed one unit of their motion: 1 at
        /// themselves and 0 at other known ones.
        std::vector<double> answer;
        /// Coefficients of the transforms in the force on them: S_i lever[i] for real vertex i.
        std::vector<Vec4> lever;
        /// And of the position of each known vertex that it depends on.
        std::vector<std::pair<Index, double>> pull;
    };
    /// The responses of `count` groups of known vertices, at most three: coordinate k of x is their
    /// motion and its answer by group k.
    std::vector<Response> responses(std::span<const Vec4> x, Index count, Scratch& scratch,
                                    const Context& context) const;
    /// `force` on the vertices of a response as it were after `solve`, without solving: x holds the
    /// known positions, and its free ones do not matter. The matrix is symmetric: the residual at a
    /// free vertex is nothing, and the right-hand side of the transforms there acts on the group by
    /// the vertex's answer, without the solution. Not for a system with ties.
    Vec3 solved_force(const PaddedMat3* transforms, std::span<const Vec4> x,
                      const Response& response, Scratch& scratch, const Context& context) const;
    bool has_ties() const { return !ties_.empty(); }

    /// The loops over its energy.
    EnergyLoop energy() const;

  private:
    void assemble(const std::vector<char>& position_known, const Context& context);
    void fade_laplacian(const Patch& patch, const std::vector<char>& position_known);
    void add_ties(const WorkingPatch& work);
    void bend(const PaddedMat3* transforms, std::span<const Vec4> x, std::vector<Vec4>& bending,
              const Context& context) const;
    Vec3 bent_force(const PaddedMat3* transforms, std::span<const Vec4> x,
                    std::span<const Index> vertices, Scratch& scratch) const;
    void find_residual(const PaddedMat3* transforms, std::span<const Vec4> x,
                       std::vector<Vec3>& residual, Scratch& scratch, const Context& context) const;
    void correct_further(std::span<Vec4> x, Scratch& scratch, const Context& context) const;
    void find_correction(Scratch& scratch, const Context& context) const;
    void add_correction(const Scratch& scratch, std::span<Vec4> x, const Context& context) const;
    void enforce_ties(std::span<Vec4> x, std::vector<double>& columns) const;
    double measure_contraction(const Context& context) const;

    Rings rings_;
    std::vector<double> coefficient_, edge_weight_, row_weight_;
    std::vector<Vec4> rest_, laplacian_, edge_sum_;
    std::vector<Index> free_;
    Index vertex_count_ = 0;
    SymmetricMatrix matrix_;
    TieRows ties_;
    MemoryCharge ties_charge_;
    std::size_t tie_bytes_ = 0;
    double tie_unit_ = 1.0;
    RegionOrder order_;
    /// The copy in single precision serves if there is one, and the factor itself the next system;
    /// corrections for a solution of nearly full precision.
    SingleFactor single_;
    OrderedSystem system_;
    int corrections_ = 1;
    FactorStats stats_;
};

}  // namespace lissom
