#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>

#include "kernel/core/clock.h"
#include "kernel/core/large_pages.h"
#include "kernel/solve/sparse/sparse_system.h"
#include "kernel/solve/sparse/sparse_system_check.h"
#include "kernel/solve/sparse/supernodal_factor.h"
#include "kernel/solve/sparse/supernodal_solve.h"

namespace lissom {
namespace {

constexpr const char* kPlanning = "analysing the linear system";

// Least pivot relative to its diagonal entry, and the row it belongs to.
std::pair<double, Index> min_pivot(const Supernodes& nodes, const double* value,
                                   const SymmetricMatrix& matrix) {
    std::pair<double, Index> least{1.0, 0};
    for (Index s = 0; s < nodes.count(); ++s) {
        const std::ptrdiff_t step = nodes.height(s) + 1;
        const double* diagonal = value + nodes.first_value[s];
        for (Index j = nodes.super[s]; j < nodes.super[s + 1]; ++j, diagonal += step) {
            const Index row = nodes.permutation[j];
            const double ratio = *diagonal * *diagonal / matrix.value[matrix.begin[row]];
            if (!(ratio >= least.first)) least = {ratio, row};
        }
    }
    return least;
}

std::size_t supernode_bytes(const Supernodes& nodes) {
    return (3 * nodes.super.size() + nodes.row.size() + nodes.permutation.size()) * sizeof(Index);
}

}  // namespace

struct SparseSystem::State {
    Supernodes nodes;
    FactorPlan plan;
    std::unique_ptr<double[]> value;
    // Buffer of the solve before, taken by the next one; a concurrent solve makes its own.
    std::vector<double> scratch;
    std::mutex scratch_lock;
    std::vector<Index> begin, row;
    bool factored = false;
    // Memory of the analysis and of the values.
    MemoryCharge analysis_charge, charge;
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
    next->nodes = analyze_supernodes(matrix, context);
    context.checkpoint();
    {
        const MemoryCharge planning = context.charge(
            supernode_bytes(next->nodes) + planning_bytes(next->nodes, matrix), kPlanning);
        next->plan = plan_factor(next->nodes, matrix);
    }
    next->begin = matrix.begin;
    next->row = matrix.row;
    const std::size_t kept = supernode_bytes(next->nodes) + next->plan.bytes() +
                             (next->begin.size() + next->row.size()) * sizeof(Index);
    next->analysis_charge = context.charge(kept, kPlanning);
    next->stats.factor_nonzeros = next->nodes.value_count();
    next->stats.analysis_bytes = kept;
    next->stats.factor_bytes = kept + next->nodes.value_count() * sizeof(double);
    next->stats.working_bytes = factoring_bytes(next->nodes, next->plan);
    next->stats.analyze_seconds = seconds_since(start);
    state_ = std::move(next);
}

void SparseSystem::factor(const SymmetricMatrix& matrix, const Context& context) {
    State& state = *state_;
    require_pattern(matrix, state.begin, state.row);
    context.checkpoint();
    state.factored = false;
    state.charge = {};
    std::unique_ptr<double[]> value = std::move(state.value);
    const char* purpose = "factoring the linear system";
    MemoryCharge charge = context.charge(state.nodes.value_count() * sizeof(double), purpose);
    const MemoryCharge working = context.charge(state.stats.working_bytes, purpose);
    const auto start = Clock::now();
    if (!value) value = large_array<double>(state.nodes.value_count());
    const Index failed =
        factor_supernodes(state.nodes, state.plan, matrix, value.get(), best_processor(), context);
    if (failed != kNoIndex) refuse_pivot(matrix, state.nodes.permutation[failed]);
    if (const auto [ratio, row] = min_pivot(state.nodes, value.get(), matrix);
        !(ratio > smallest_pivot(size()))) {
        refuse_pivot(matrix, row);
    }
    context.checkpoint();
    state.stats.factor_seconds = seconds_since(start);
    state.value = std::move(value);
    state.charge = std::move(charge);
    state.factored = true;
}

void SparseSystem::solve(std::span<const double> b, std::span<double> x, Index columns) const {
    require_factor(state_->factored);
    require_sizes(b, x, size(), columns);
    const std::size_t rows = size();
    const Supernodes& nodes = state_->nodes;
    const SupernodalFactor factor{size(),
                                  nodes.count(),
                                  {nodes.super.data(), nodes.first_row.data(),
                                   nodes.first_value.data(), nodes.row.data(), state_->value.get()},
                                  nodes.permutation.data()};
    std::vector<double> scratch;
    const auto exchange_scratch = [&] {
        const std::lock_guard lock(state_->scratch_lock);
        scratch.swap(state_->scratch);
    };
    exchange_scratch();
    for (Index first = 0; first < columns; first += kSolveWidth) {
        const std::size_t shift = first * rows;
        solve_supernodal(factor, b.data() + shift, x.data() + shift,
                         std::min(kSolveWidth, columns - first), scratch);
    }
    exchange_scratch();
}

SingleFactor SparseSystem::single_factor(const Context& context) const {
    require_factor(state_->factored);
    const Supernodes& from = state_->nodes;
    const double *value = state_->value.get(), *end = value + from.value_count();
    SingleFactor::Supernodes nodes{from.super, from.first_row, from.first_value, from.row, {}, 0.0};
    nodes.value.reserve(from.value_count());
    prefer_large_pages(nodes.value);
    for (Index s = 0; s < nodes.count(); ++s) {
        for (Index j = 0; j < nodes.columns(s); ++j) {
            nodes.scale =
                std::max(nodes.scale, value[nodes.first_value[s] + j * (nodes.height(s) + 1)]);
        }
    }
    const double inverse = 1.0 / nodes.scale;
    for (; value != end; ++value) nodes.value.push_back(static_cast<float>(inverse * *value));
    return {std::move(nodes), from.permutation, context};
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

}  // namespace lissom
