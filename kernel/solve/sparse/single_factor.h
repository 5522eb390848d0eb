/// SingleFactor: a Cholesky factor in single precision, for corrections many times a second.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"

namespace lissom {

/// The factor of a symmetric positive definite matrix, copied to single precision: half the memory
/// to read in a solve. A solution is accurate to about 1e-7 times the condition number, so it
/// serves as a correction: solve for the residual, which the caller takes in double precision, and
/// repeat. Made by SparseSystem::single_factor. Several threads may solve at the same time, each
/// with scratch of its own.
class SingleFactor {
  public:
    /// Buffer of a solve, sized as needed; kept by the caller because a frame is short beside the
    /// time to get fresh pages.
    using Scratch = std::vector<float>;

    SingleFactor() = default;

    Index size() const { return count_of(permutation_); }

    /// Solves A x = b for the three columns of b, one row an unknown; x may be b. Independent parts
    /// of the factor run in parallel; the result does not depend on the number of threads. Errors:
    /// invalid_argument if sizes differ; cancelled.
    void solve(std::span<const Vec3> b, std::span<Vec3> x, Scratch& scratch,
               const Context& context = {}) const;

  private:
    friend class SparseSystem;

    /// Supernode s holds the columns [super[s], super[s + 1])
    /// as one dense column-major block at value[first_value[s]], of the rows [first_row[s],
    /// first_row[s + 1]) of `row`. Its parent, or count(), has all rows below its columns. Values
    /// are divided by `scale`.
    struct Supernodes {
        std::vector<Index> super, first_row, first_value, row, parent;
        std::vector<float> value;
        double scale = 1.0;

        Index count() const { return count_of(super) - 1; }
        Index columns(Index s) const { return super[at(s + 1)] - super[at(s)]; }
        Index height(Index s) const { return first_row[at(s + 1)] - first_row[at(s)]; }
    };

    /// Supernodes [first, last) with columns that no other subtree touches. Each adds to the
    /// columns above it through entries of its own, from `extension` on, one for each of the rows
    /// `above`.
    struct Subtree {
        Index first = 0, last = 0, extension = 0;
        std::vector<Index> above;
        std::size_t work = 0;
    };

    SingleFactor(Supernodes supernodes, std::vector<Index> permutation, const Context& context);

    void split();
    void add_subtree(Index first, Index root, std::size_t work);
    void fill_bins();
    template <typename Pass>
    void for_each_bin(const Context& context, const Pass& pass) const;

    Supernodes nodes_;
    std::vector<Index> permutation_;
    std::vector<Subtree> subtrees_;
    /// Subtrees of each unit of parallel work, and the supernodes above all subtrees.
    std::vector<std::vector<Index>> bins_;
    std::vector<Index> top_;
    /// Entries of a solution with its extensions, and rows of the tallest supernode.
    Index extended_size_ = 0, tallest_ = 0;
    MemoryCharge charge_;
};

}  // namespace lissom
