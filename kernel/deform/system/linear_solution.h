/// The solution of the first system as a linear function of the handles' transforms; private to
/// kernel/deform.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/holds/constraint_set.h"
#include "kernel/deform/holds/constraints.h"
#include "kernel/deform/patch/lazy.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/deform/system/gradient_system.h"
#include "kernel/deform/system/gradients.h"

namespace lissom {

/// [linear translation] over a row of zeros: a square matrix, so that products use whole registers.
Mat4 matrix_of(const Affine& transform);

/// (p, 1).
inline Vec4 homogeneous(const Vec3& p) {
    return {p.x(), p.y(), p.z(), 1.0};
}

/// Everything that a solution is built from, and lives as long as that.
struct LinearProblem {
    const Patch& patch;
    const Rings& rings;
    const GradientStencils& gradients;
    const GradientSystem& system;
    const std::vector<Index>& owner;
    const std::vector<std::shared_ptr<const Handle>>& handles;
};

/// The part of vertex constraints in the free vertices; empty if there are none. `fold` is for
/// displaced vertices.
struct FixedPart {
    std::vector<Vec3> value, fold;

    Vec3 at(Index row) const { return value.empty() ? Vec3(Vec3::Zero()) : value[lissom::at(row)]; }
};

/// With T the transform of the base and D_h = T_h - T those of the other handles relative to it, a
/// free vertex whose displaced rest position is v' lies at
///   x' = T v' + fixed + sum over h of D_h weight_h.
/// A displaced vertex comes back by M (v - v') (section 2.4.3), which is linear in the same
/// quantities: `fold` is added to its weights and v' becomes v. The base is the surroundings of the
/// region, with T = I, or the first handle if nothing is fixed. Affine motions of all handles
/// together are then exact. `fixed` is a FixedPart, found apart as it follows the targets. Several
/// threads may read one solution at the same time.
class LinearSolution {
  public:
    /// A solution whose weights are found as they are needed. Memory of all is charged at once.
    LinearSolution(const LinearProblem& problem, const Context& context);

    /// Finds the weights of handles that move beside the base, or of all, several at the same time
    /// if the context has threads. They are found without it too, by the first who asks.
    void find_weights(std::span<const Mat4> differences, const Context& context) const;
    void find_all_weights(const Context& context) const;

    /// Solves for the part that vertex constraints add, for the problem it was made from.
    FixedPart fixed_part(const LinearProblem& problem, const VertexConstraints& constraints) const;

    /// Time that the weights found so far have taken.
    double seconds() const { return 1e-9 * static_cast<double>(nanoseconds_); }
    /// Number of free vertices.
    Index rows() const { return count_of(rest_); }
    /// Returns the handle whose transform is T, or kNoIndex for T = I.
    Index base() const { return base_; }
    /// Handles with weights of their own.
    const std::vector<Index>& handles() const { return handles_; }

    /// Returns sum over h of D_h weight_h, the part of the handles, of free vertices [begin, end).
    void handle_part(std::span<const Mat4> differences, Vec4* x, Index begin, Index end) const;
    /// x' - T v' of the free vertices [begin, end): how far they deviate from the base transform.
    void deviations(std::span<const Mat4> differences, const FixedPart& fixed, Vec4* x, Index begin,
                    Index end) const;
    /// Positions of the free vertices [begin, end), for a base whose transform differs from the
    /// identity by `shift`, relative to `origin`: each to the entry of `out` that `row` says, or
    /// none.
    struct Places {
        Mat4 shift;
        Vec3 origin;
        std::span<const Index> row;
        std::span<Vec3> out;
    };
    void place(std::span<const Mat4> differences, const FixedPart& fixed, const Places& places,
               Index begin, Index end) const;

    /// The weights of handle number h of `handles()` at the free vertices, degenerate ones
    /// displaced; the fourth is that of the translation.
    const std::vector<Vec4>& row_weights(std::size_t h) const { return weights(h).of_rows; }

    /// Weight of handle number h of `handles()` in `positions`, and the part that no handle moves.
    Vec4 weight(std::size_t h, Index row) const {
        const Index f = fold_of_[at(row)];
        const HandleWeights& found = weights(h);
        return f == kNoIndex ? found.of_rows[at(row)]
                             : Vec4(found.of_rows[at(row)] + found.folds[at(f)]);
    }
    Vec3 fixed(const FixedPart& fixed, Index row) const {
        const Index f = fold_of_[at(row)];
        return fixed.value.empty() || f == kNoIndex
                   ? fixed.at(row)
                   : Vec3(fixed.value[at(row)] + fixed.fold[at(f)]);
    }

  private:
    /// Weights of one handle at the free vertices, and the folds of displaced ones.
    struct HandleWeights {
        std::vector<Vec4> of_rows, folds;
    };
    struct Loop;

    /// Bytes of the weights of all handles.
    std::size_t memory_bytes() const;
    void choose_base();
    const HandleWeights& weights(std::size_t h) const;
    HandleWeights solved_weights(Index handle) const;
    void place_folded(std::span<const Mat4> differences, const FixedPart& fixed,
                      const Places& places, Index row) const;

    LinearProblem problem_;
    MemoryCharge charge_;
    Index base_ = kNoIndex;
    std::vector<Index> handles_;
    std::vector<Vec3> rest_;
    std::vector<Lazy<HandleWeights>> weights_;
    mutable std::atomic<std::int64_t> nanoseconds_ = 0;
    /// Place of a displaced free vertex in the folds, and their rows, ascending.
    std::vector<Index> fold_of_, folded_;
};

}  // namespace lissom
