#include <algorithm>
#include <span>
#include <vector>

#include "kernel/solve/field/grid_cholesky.h"
#include "kernel/solve/grid/cosine_transform.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {

struct GridCholesky::State {
    explicit State(const GridLaplacian& laplacian)
        : size(laplacian.size()), base(laplacian.matrix()), matrix(base) {}

    GridSize size;
    SymmetricMatrix base, matrix;
    SparseSystem system;
    GridCholeskyStats stats;
};

GridCholesky::GridCholesky(const GridLaplacian& laplacian)
    : state_(std::make_unique<State>(laplacian)) {}
GridCholesky::~GridCholesky() = default;

void GridCholesky::update(const ConstraintRows& rows, const Context& context) {
    State& s = *state_;
    std::vector<double> value = s.base.value;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        value[s.base.begin[s.size.index(rows.point[i])]] += rows.weight[i] * rows.weight[i];
    }
    if (s.system.factored() && value == s.matrix.value) return;
    s.matrix.value = std::move(value);
    if (s.stats.factorisations == 0) s.system.analyze(s.matrix, context);
    s.system.factor(s.matrix, context);
    ++s.stats.factorisations;
    s.stats.factor_nonzeros = s.system.stats().factor_nonzeros;
}

void GridCholesky::solve(const double* b, double* x, int refinements,
                         const Context& context) const {
    const State& s = *state_;
    const std::size_t count = kComponents * s.size.count();
    s.system.solve({b, count}, {x, count}, kComponents);
    std::vector<double> product(count);
    for (int i = 0; i < refinements; ++i) {
        context.checkpoint();
        s.matrix.multiply(x, product.data(), kComponents);
        for (std::size_t k = 0; k < count; ++k) product[k] = b[k] - product[k];
        s.system.solve(product, product, kComponents);
        for (std::size_t k = 0; k < count; ++k) x[k] += product[k];
    }
}

const GridCholeskyStats& GridCholesky::stats() const {
    return state_->stats;
}

}  // namespace lissom
