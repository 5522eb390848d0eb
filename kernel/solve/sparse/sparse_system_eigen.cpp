#include <Eigen/SparseCholesky>
#include <cmath>
#include <utility>

#include "kernel/core/clock.h"
#include "kernel/solve/sparse/sparse_system.h"
#include "kernel/solve/sparse/sparse_system_check.h"

namespace lissom {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;

Eigen::Map<const Matrix> view_of(const SymmetricMatrix& matrix) {
    return {matrix.size(),       matrix.size(),     static_cast<Eigen::Index>(matrix.nonzeros()),
            matrix.begin.data(), matrix.row.data(), matrix.value.data()};
}

// Eigen's class, with access to the size of the factor that its analysis found.
class Factorization
    : public Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<Index>> {
  public:
    std::size_t factor_nonzeros() const { return static_cast<std::size_t>(m_matrix.nonZeros()); }
    // L without its unit diagonal.
    const Matrix& lower() const { return m_matrix; }
};

}  // namespace

struct SparseSystem::State {
    Factorization factorization;
    std::vector<Index> begin, row;
    bool factored = false;
    MemoryCharge charge;
    FactorStats stats;
};

SparseSystem::SparseSystem() : state_(std::make_unique<State>()) {}
SparseSystem::~SparseSystem() = default;
SparseSystem::SparseSystem(SparseSystem&&) noexcept = default;
SparseSystem& SparseSystem::operator=(SparseSystem&&) noexcept = default;

void SparseSystem::analyze(const SymmetricMatrix& matrix, const Context& context) {
    require_valid(matrix);
    context.checkpoint();
    const auto start = Clock::now();
    auto next = std::make_unique<State>();
    next->factorization.analyzePattern(view_of(matrix));
    next->begin = matrix.begin;
    next->row = matrix.row;
    next->stats.factor_nonzeros = next->factorization.factor_nonzeros();
    next->stats.factor_bytes = next->stats.factor_nonzeros * (sizeof(double) + sizeof(Index));
    next->stats.analyze_seconds = seconds_since(start);
    state_ = std::move(next);
}

void SparseSystem::factor(const SymmetricMatrix& matrix, const Context& context) {
    State& state = *state_;
    require_pattern(matrix, state.begin, state.row);
    context.checkpoint();
    state.factored = false;
    state.charge = {};
    MemoryCharge charge = context.charge(state.stats.factor_bytes, "factoring the linear system");
    const auto start = Clock::now();
    state.factorization.factorize(view_of(matrix));
    const auto& pivots = state.factorization.vectorD();
    const auto& to_row = state.factorization.permutationPinv().indices();
    const double smallest = smallest_pivot(size());
    for (Index i = 0; i < matrix.size(); ++i) {
        const Index row = to_row[i];
        if (!(pivots[i] > smallest * matrix.value[matrix.begin[row]])) refuse_pivot(matrix, row);
    }
    state.stats.factor_seconds = seconds_since(start);
    state.charge = std::move(charge);
    state.factored = true;
    context.checkpoint();
}

void SparseSystem::solve(std::span<const double> b, std::span<double> x, Index columns) const {
    require_factor(state_->factored);
    require_sizes(b, x, size(), columns);
    const Eigen::Map<const Eigen::MatrixXd> right(b.data(), size(), columns);
    Eigen::Map<Eigen::MatrixXd>(x.data(), size(), columns) = state_->factorization.solve(right);
}

// Every column is a supernode; L sqrt(D) stands in place of L and D.
SingleFactor SparseSystem::single_factor(const Context& context) const {
    require_factor(state_->factored);
    const Matrix& lower = state_->factorization.lower();
    const auto& pivots = state_->factorization.vectorD();
    const auto& to_row = state_->factorization.permutationPinv().indices();
    SingleFactor::Supernodes nodes;
    nodes.scale = std::sqrt(pivots.maxCoeff());
    for (Index column = 0; column < size(); ++column) {
        nodes.super.push_back(column);
        nodes.first_row.push_back(count_of(nodes.row));
        const double root = std::sqrt(pivots[column]) / nodes.scale;
        nodes.row.push_back(column);
        nodes.value.push_back(root);
        for (Matrix::InnerIterator entry(lower, column); entry; ++entry) {
            if (entry.row() == column) continue;
            nodes.row.push_back(index_of(entry.row()));
            nodes.value.push_back(root * entry.value());
        }
    }
    nodes.super.push_back(size());
    nodes.first_row.push_back(count_of(nodes.row));
    nodes.first_value = nodes.first_row;
    return {std::move(nodes), {to_row.data(), to_row.data() + to_row.size()}, context};
}

Index SparseSystem::size() const {
    return state_->begin.empty() ? 0 : count_of(state_->begin) - 1;
}

bool SparseSystem::factored() const {
    return state_->factored;
}

const FactorStats& SparseSystem::stats() const {
    return state_->stats;
}

const char* sparse_backend() {
    return "eigen";
}

}  // namespace lissom
