#include "kernel/solve/sparse/adjacency.h"

#include <numeric>

namespace lissom {

std::size_t Adjacency::entries(const SymmetricMatrix& matrix) {
    return 2 * (matrix.row.size() - at(matrix.size()));
}

std::size_t Adjacency::bytes(const SymmetricMatrix& matrix) {
    return (entries(matrix) + at(matrix.size()) + 1) * sizeof(Index);
}

// Column j comes before all greater neighbors of any unknown, so the lists ascend.
Adjacency::Adjacency(const SymmetricMatrix& matrix) : begin(matrix.begin.size(), 0) {
    const Index n = matrix.size();
    for (Index j = 0; j < n; ++j) {
        begin[at(j + 1)] += matrix.begin[j + 1] - matrix.begin[j] - 1;
        for (Index k = matrix.begin[j] + 1; k < matrix.begin[j + 1]; ++k) {
            ++begin[at(matrix.row[k] + 1)];
        }
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    neighbor.resize(at(begin.back()));
    std::vector<Index> next(begin.begin(), begin.end() - 1);
    for (Index j = 0; j < n; ++j) {
        for (Index k = matrix.begin[j] + 1; k < matrix.begin[j + 1]; ++k) {
            const Index i = matrix.row[k];
            neighbor[at(next[at(i)]++)] = j;
            neighbor[at(next[at(j)]++)] = i;
        }
    }
}

}  // namespace lissom
