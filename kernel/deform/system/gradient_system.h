/// The first system (Eq 2.6 to 2.8): positions from transformed Laplacian coordinates under
/// coherence of the deformation gradients; private to kernel/deform.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/extended.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/holds/known_mask.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/ties.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/deform/system/gradients.h"
#include "kernel/deform/system/ordered_system.h"
#include "kernel/solve/sparse/sparse_matrix.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {

/// Weight of a pair of neighbours in the scale-free form of Eq 2.7: the cotangent weight of their
/// edge. Weights below the least have no say but could make the weighted graph fall apart.
inline double scale_free_coherence(double cotangent_weight) {
    constexpr double kMin = 1e-3;
    return std::max(cotangent_weight, kMin);
}

/// Weight of a pair of neighbours in Eq 2.7, which counts every pair from both its ends, in the
/// form that the options ask for; and of a pair two rings apart, which weighs as an edge between
/// equilateral triangles.
inline double edge_coherence(const DeformOptions& options, double cotangent_weight) {
    return options.scale_free ? scale_free_coherence(cotangent_weight) : 2.0;
}
inline double second_ring_coherence(const DeformOptions& options) {
    return options.scale_free ? 0.57735026918962576 : 2.0;
}

class GradientSystem;

/// A system of the same patch and options that ends, with the input of its assembly.
struct FormerAssembly {
    const GradientSystem* system = nullptr;
    const GradientStencils* gradients = nullptr;
    const KnownMask* known = nullptr;
};

/// Normal equations of Eq 2.8 with the known quantities moved to the right-hand side:
/// A x_free = - (known_positions X + known_gradients W). Rows are free vertices; columns of the two
/// couplings are local vertices. Ties add their terms; anchors are known.
class GradientSystem {
  public:
    /// Assembles A row by row, without forming products of sparse matrices. Rows that come out as
    /// in `former`, if there is one, are copied.
    GradientSystem(const WorkingPatch& work, const GradientStencils& gradients,
                   const KnownMask& known, const DeformOptions& options, const Context& context,
                   const FormerAssembly& former = {});

    /// Analyses and factors A, and prepares hard ties. `former` is the result of release() of a
    /// system of the same region. Errors: not_positive_definite with rows as elements;
    /// memory_limit.
    void factor(const Context& context, OrderedSystem former);
    /// The same for a system without a next one, in an order of its own.
    void factor(const Context& context) {
        order_ = {};
        factor(context, {});
    }
    /// Its factor, for the next system; this one is of no more use.
    OrderedSystem release() { return std::move(system_); }

    /// Local vertex of each row.
    const std::vector<Index>& free_vertices() const { return free_; }
    /// Number of rows of A that were not copied.
    Index assembled_rows() const { return assembled_rows_; }
    FactorStats stats() const { return system_.stats(); }

    /// Right-hand side of one column, of length rows: `position(k)` is the coordinate of known
    /// vertex k and `gradient(k)` the row of its known gradient that belongs to that coordinate.
    template <typename Position, typename Gradient>
    void right_hand_side(const Position& position, const Gradient& gradient, Extended* b) const {
        for (std::size_t row = 0; row < free_.size(); ++row) {
            Extended sum = 0.0;
            for (Index e = positions_.begin[row]; e < positions_.begin[row + 1]; ++e) {
                sum -= static_cast<Extended>(positions_.value[e]) * position(positions_.column[e]);
            }
            for (Index e = gradients_begin_[row]; e < gradients_begin_[row + 1]; ++e) {
                const Vec3 known = gradient(gradients_column_[e]);
                for (int d = 0; d < 3; ++d) {
                    sum -= static_cast<Extended>(gradients_value_[at(e)][d]) * known[d];
                }
            }
            b[row] = sum;
        }
        ties_.add_right_hand_side(position, b);
    }

    /// Moves a solution for known coordinates `position(k)` onto the hard ties.
    template <typename Position>
    void enforce_ties(const Position& position, std::span<double> x) const {
        if (!ties_.has_hard()) return;
        add_vertices(x, -1.0);
        ties_.enforce(position, x);
        add_vertices(x, 1.0);
    }

    /// Solves for `columns` right-hand sides, to nearly full precision.
    std::vector<double> solve(std::span<const Extended> b, Index columns) const {
        std::vector<double> x(b.size());
        system_.system().solve_refined(matrix_, b, x, columns);
        const std::size_t rows = free_.size();
        for (Index c = 0; c < columns; ++c)
            add_vertices(std::span(x).subspan(at(c) * rows, rows), 1.0);
        return x;
    }

    /// Solves without refinement, for a system without points beside flat vertices.
    void solve_roughly(std::span<const double> b, std::span<double> x, Index columns) const {
        system_.system().solve(b, x, columns);
    }

    /// Rows of A under construction; private to gradient_system.cpp.
    struct SystemRows;

  private:
    void join_rows(const std::vector<char>& changed, const std::vector<Index>& row_of,
                   const std::vector<SystemRows>& parts, const GradientSystem* former);
    void copy_row(const GradientSystem& former, Index r, const std::vector<Index>& row_of);
    /// Returns the row of each local vertex, or kNoIndex.
    std::vector<Index> assemble(const WorkingPatch& work, const GradientStencils& gradients,
                                const KnownMask& known, const DeformOptions& options,
                                const Context& context, const std::vector<char>& changed,
                                const GradientSystem* former);
    /// Whether its rows may be copied: ties and firm factors change them.
    bool is_as_assembled() const { return ties_.empty() && !is_firm_; }

    /// Adds `sign` times the position of their vertex to points that are unknown relative to it.
    void add_vertices(std::span<double> x, double sign) const {
        for (const auto& [point, vertex] : relative_) x[at(point)] += sign * x[at(vertex)];
    }

    std::vector<Index> free_;
    /// Rows of points beside flat vertices, with the unknown x_p - x_v, and of v: positions
    /// within a plane and distances from it then have no entries in common in A.
    std::vector<std::pair<Index, Index>> relative_;
    SymmetricMatrix matrix_;
    RowMatrix positions_;
    std::vector<Index> gradients_begin_{0}, gradients_column_;
    std::vector<Vec3> gradients_value_;
    TieRows ties_;
    MemoryCharge ties_charge_;
    std::size_t tie_bytes_ = 0;
    Index assembled_rows_ = 0;
    bool is_firm_ = false;
    RegionOrder order_;
    OrderedSystem system_;
};

}  // namespace lissom
