/// The elimination tree of a symmetric matrix, and the sizes of its factor's columns; private to
/// kernel/solve.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/solve/sparse/adjacency.h"

namespace lissom {

/// An order of elimination with its tree: the parent of column j is the row of the first entry
/// below the diagonal of column j of the factor (Liu, The role of elimination trees in sparse
/// factorization, 1990); kNoIndex at a root.
struct EliminationTree {
    /// The unknown of each column.
    std::vector<Index> order;
    std::vector<Index> parent;
    /// Entries of each column of the factor, the diagonal one included.
    std::vector<Index> count;

    Index size() const { return count_of(order); }
};

/// Returns the tree of `graph` for the order of elimination that `order` and a postorder of its
/// tree give, which has the same fill. Children of a column ascend by count of entries, so that the
/// greatest is next to it; ties follow `order`. Counts are found as Gilbert, Ng and Peyton do (An
/// efficient algorithm to compute row and column counts for sparse Cholesky factorization, 1994),
/// in nearly linear time. Errors: cancelled, between the stages.
EliminationTree elimination_tree(const Adjacency& graph, std::vector<Index> order,
                                 const Context& context = {});

/// Bytes that it takes while it runs, its result included.
std::size_t elimination_tree_bytes(std::size_t unknowns);

/// Returns the position of each element of a permutation.
std::vector<Index> inverse_permutation(const std::vector<Index>& permutation);

}  // namespace lissom
