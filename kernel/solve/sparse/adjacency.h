/// Adjacency: the graph of a symmetric matrix; private to kernel/solve.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/solve/sparse/sparse_matrix.h"

namespace lissom {

/// The unknowns that share an entry off the diagonal with each unknown, ascending: those of i are
/// neighbor[begin[i]] to neighbor[begin[i + 1] - 1].
struct Adjacency {
    std::vector<Index> begin{0};
    std::vector<Index> neighbor;

    explicit Adjacency(const SymmetricMatrix& matrix);

    Index size() const { return count_of(begin) - 1; }
    Index degree(Index i) const { return begin[at(i + 1)] - begin[at(i)]; }

    /// Calls use(neighbor of i) for each.
    template <typename Use>
    void for_each(Index i, const Use& use) const {
        for (Index k = begin[at(i)]; k < begin[at(i + 1)]; ++k) use(neighbor[at(k)]);
    }

    /// Entries and bytes that the graph of `matrix` takes.
    static std::size_t entries(const SymmetricMatrix& matrix);
    static std::size_t bytes(const SymmetricMatrix& matrix);
};

}  // namespace lissom
