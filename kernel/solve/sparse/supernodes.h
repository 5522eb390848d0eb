/// Supernodes: the pattern of a supernodal Cholesky factor; private to kernel/solve.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/solve/sparse/elimination_tree.h"
#include "kernel/solve/sparse/sparse_matrix.h"

namespace lissom {

/// Supernode s holds the columns [super[s], super[s + 1]) of the factor as one dense column-major
/// block at first_value[s], of the rows [first_row[s], first_row[s + 1]) of `row`. These ascend;
/// the first are the columns themselves.
struct Supernodes {
    std::vector<Index> super, first_row, first_value, row;
    /// The unknown of each row of the factor.
    std::vector<Index> permutation;

    Index count() const { return count_of(super) - 1; }
    Index size() const { return count_of(permutation); }
    Index columns(Index s) const { return super[at(s + 1)] - super[at(s)]; }
    Index height(Index s) const { return first_row[at(s + 1)] - first_row[at(s)]; }
    std::size_t value_count() const { return at(first_value.back()); }
    /// Returns the supernode of each column, and the one that holds the first row below the columns
    /// of each supernode (count() if there is none).
    std::vector<Index> nodes_of_columns() const;
    std::vector<Index> parents() const;
};

/// Returns the supernodes of a tree, without their rows: columns of equal pattern, joined further
/// to their parents if that stores few zeros. Errors: memory_limit if there are more rows or values
/// than an Index counts.
Supernodes join_columns(EliminationTree tree);

/// Orders the unknowns by approximate minimum degree, postorders the elimination tree and joins
/// columns of similar pattern. Memory for the stages is charged before it is allocated, and
/// released at the end. May run in several threads at the same time. Errors: memory_limit, also if
/// the factor is too large for its indices; cancelled, in the ordering and between the stages.
Supernodes analyze_supernodes(const SymmetricMatrix& matrix, const Context& context = {});

}  // namespace lissom
