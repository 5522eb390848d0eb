#include <vector>

#include "kernel/core/extended.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {

void SparseSystem::solve_refined(const SymmetricMatrix& matrix, std::span<const Extended> b,
                                 std::span<double> x, Index columns) const {
    std::vector<double> right(b.begin(), b.end());
    solve(right, x, columns);
    matrix.residual(b.data(), x.data(), right.data(), columns);
    solve(right, right, columns);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += right[i];
}

}  // namespace lissom
