#include "kernel/solve/sparse/sparse_system_check.h"

#include <cmath>
#include <string>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// Rows connected to `start`, ascending.
Elements component_of(const SymmetricMatrix& matrix, Index start) {
    const std::size_t n = matrix.size();
    std::vector<std::vector<Index>> neighbors(n);
    for (Index j = 0; j < matrix.size(); ++j) {
        for (Index k = matrix.begin[j] + 1; k < matrix.begin[j + 1]; ++k) {
            neighbors[j].push_back(matrix.row[k]);
            neighbors[matrix.row[k]].push_back(j);
        }
    }
    std::vector<char> seen(n, 0);
    std::vector<Index> stack{start};
    seen[start] = 1;
    while (!stack.empty()) {
        const Index at = stack.back();
        stack.pop_back();
        for (const Index next : neighbors[at]) {
            if (seen[next]) continue;
            seen[next] = 1;
            stack.push_back(next);
        }
    }
    Elements rows{ElementKind::row, 0, {}};
    for (Index i = 0; i < matrix.size(); ++i) {
        if (seen[i]) rows.add(i);
    }
    return rows;
}

}  // namespace

double smallest_pivot(Index size) {
    return 2e-15 * std::sqrt(size);
}

void require_valid(const SymmetricMatrix& matrix) {
    const Index n = matrix.size();
    if (n > 0 && matrix.row.size() == matrix.value.size() &&
        at(matrix.begin[n]) == matrix.row.size()) {
        return;
    }
    throw Error(ErrorCode::invalid_argument,
                "the matrix is empty or its arrays do not fit together");
}

void require_pattern(const SymmetricMatrix& matrix, const std::vector<Index>& begin,
                     const std::vector<Index>& row) {
    require_valid(matrix);
    if (matrix.begin == begin && matrix.row == row) return;
    throw Error(ErrorCode::invalid_argument,
                "the matrix has another pattern than the one analysed; analyze it first");
}

void require_factor(bool factored) {
    if (factored) return;
    throw Error(ErrorCode::invalid_argument, "there is no factor; call factor first");
}

void require_sizes(std::span<const double> b, std::span<double> x, Index size, Index columns) {
    const std::size_t expected = at(size) * columns;
    if (b.size() == expected && x.size() == expected) return;
    throw Error(ErrorCode::invalid_argument, "right-hand side and solution must each hold " +
                                                 std::to_string(columns) + " columns of " +
                                                 std::to_string(size) + " rows");
}

void refuse_pivot(const SymmetricMatrix& matrix, Index row) {
    Elements rows = component_of(matrix, row);
    const std::string names = describe(rows);
    throw Error(ErrorCode::not_positive_definite,
                "the system has no unique solution on the component of " + names +
                    "; constrain at least one of its unknowns",
                std::move(rows));
}

}  // namespace lissom
