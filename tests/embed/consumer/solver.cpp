// Uses one module alone: solves a system of two unknowns.
#include <lissom/solve/sparse/sparse_system.h>

#include <cmath>
#include <vector>

int main() {
    const auto matrix = lissom::symmetric_from_triplets(2, {{0, 0, 2.0}, {1, 0, 1.0}, {1, 1, 2.0}});
    lissom::SparseSystem system;
    system.analyze(matrix);
    system.factor(matrix);
    std::vector<double> x{3.0, 3.0};
    system.solve(x, x, 1);
    return std::abs(x[0] - 1.0) + std::abs(x[1] - 1.0) < 1e-12 ? 0 : 1;
}
