/// OrderedSystem: a linear system with an order of elimination that is the same for all handles, so
/// that little of its factor changes with one; private to kernel/deform.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/solve/sparse/sparse_matrix.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {

/// The order of a system follows from its rings, from the vertices that are free unless a handle
/// or a constraint holds them, ascending, and from the most rings between two unknowns of one
/// equation. No vertices stand for an order that follows from the matrix.
struct RegionOrder {
    Rings rings;
    std::vector<Index> vertices;
    Index reach = 0;

    /// The order of vertices of the region below `end`. There is none if it is not worth its time:
    /// for few vertices or very many, long rows, or a patch made for one set of handles.
    static RegionOrder of(const WorkingPatch& work, const Rings& rings, Index end, Index reach);

    /// Whether it serves a system of `free` unknowns: with fewer, the rows of all others cost more
    /// than they save.
    bool serves(std::size_t free) const { return !vertices.empty() && 2 * free >= vertices.size(); }
    bool is_same(const RegionOrder& other) const;
    /// The matrix of ones where the systems of the region have entries.
    SymmetricMatrix pattern(const Context& context) const;
    std::size_t bytes() const;
};

/// A factored system.
class OrderedSystem {
  public:
    /// Factors `matrix`, firmly (firm_factor.h); its rows are the vertices `free`, ascending. If
    /// `order` serves, the former factor is used as far as it goes, without a trace in the result.
    /// Returns and errors: as factor_firmly.
    bool factor(SymmetricMatrix& matrix, const std::vector<Index>& free, RegionOrder order,
                const Context& context);

    const SparseSystem& system() const { return system_; }
    /// Costs of the last factor; an analysis that was kept cost nothing.
    FactorStats stats() const;
    /// Whether the factor is of use for the next one.
    bool is_ordered() const { return !order_.vertices.empty(); }

  private:
    SparseSystem system_;
    RegionOrder order_;
    bool is_analysed_ = false;
    MemoryCharge charge_;
};

}  // namespace lissom
