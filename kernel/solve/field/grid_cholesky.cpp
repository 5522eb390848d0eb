#include "kernel/solve/field/grid_cholesky.h"

#include <algorithm>
#include <span>
#include <vector>

#include "kernel/core/build_info.h"
#include "kernel/solve/grid/cosine_transform.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {

namespace {

class FactoredCholesky final : public GridCholesky {
  public:
    explicit FactoredCholesky(const GridLaplacian& laplacian)
        : size_(laplacian.size()), base_(laplacian.matrix()), matrix_(base_) {}

    void update(const ConstraintRows& rows, const Context& context) override;
    void solve(const double* b, double* x, int refinements, const Context& context) const override;
    const GridCholeskyStats& stats() const override { return stats_; }

  private:
    GridSize size_;
    SymmetricMatrix base_, matrix_;
    SparseSystem system_;
    GridCholeskyStats stats_;
};

void FactoredCholesky::update(const ConstraintRows& rows, const Context& context) {
    std::vector<double> value = base_.value;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        value[base_.begin[size_.index(rows.point[i])]] += rows.weight[i] * rows.weight[i];
    }
    if (system_.factored() && value == matrix_.value) return;
    matrix_.value = std::move(value);
    if (stats_.factorisations == 0) system_.analyze(matrix_, context);
    system_.factor(matrix_, context);
    ++stats_.factorisations;
    stats_.factor_nonzeros = system_.stats().factor_nonzeros;
}

void FactoredCholesky::solve(const double* b, double* x, int refinements,
                             const Context& context) const {
    const std::size_t count = kComponents * size_.count();
    system_.solve({b, count}, {x, count}, kComponents);
    std::vector<double> product(count);
    for (int i = 0; i < refinements; ++i) {
        context.checkpoint();
        matrix_.multiply(x, product.data(), kComponents);
        for (std::size_t k = 0; k < count; ++k) product[k] = b[k] - product[k];
        system_.solve(product, product, kComponents);
        for (std::size_t k = 0; k < count; ++k) x[k] += product[k];
    }
}

}  // namespace

LISSOM_REPLACEABLE std::unique_ptr<GridCholesky> make_updated_cholesky(const GridLaplacian&) {
    return nullptr;
}

std::unique_ptr<GridCholesky> make_grid_cholesky(const GridLaplacian& laplacian) {
    if (auto updated = make_updated_cholesky(laplacian)) return updated;
    return std::make_unique<FactoredCholesky>(laplacian);
}

}  // namespace lissom
