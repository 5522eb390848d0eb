#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>

#include "kernel/core/clock.h"
#include "kernel/core/large_pages.h"
#include "kernel/solve/sparse/sparse_system.h"
#include "kernel/solve/sparse/sparse_system_check.h"
#include "kernel/solve/sparse/sparse_system_state.h"
#include "kernel/solve/sparse/supernodal_factor.h"
#include "kernel/solve/sparse/supernodal_solve.h"

namespace lissom {
namespace {

constexpr const char* kPlanning = "analysing the linear system";

std::size_t supernode_bytes(const Supernodes& nodes) {
    return (3 * nodes.super.size() + nodes.row.size() + nodes.permutation.size()) * sizeof(Index);
}

}  // namespace

void SparseSystem::State::number_solve() {
    solve_row = nodes.permutation;
    solve_nodes.clear();
    for (Index s = 0; s < nodes.count(); ++s) {
        if (part.empty() || !part.idle[at(s)]) solve_nodes.push_back(s);
    }
    if (part.empty()) return;
    for (Index& unknown : solve_row) unknown = part.row_of[at(unknown)];
}

void SparseSystem::State::require_pivots(Index failed, const double* values,
                                         const SymmetricMatrix& matrix) const {
    if (failed != kNoIndex) refuse_pivot(matrix, solve_row[at(failed)]);
    // Least pivot relative to its diagonal entry, and the row it belongs to.
    std::pair<double, Index> least{1.0, 0};
    for (const Index s : solve_nodes) {
        const std::ptrdiff_t step = nodes.height(s) + 1;
        const double* diagonal = values + nodes.first_value[s];
        for (Index j = nodes.super[s]; j < nodes.super[s + 1]; ++j, diagonal += step) {
            const Index unknown = solve_row[at(j)];
            if (unknown == kNoIndex) continue;
            const double ratio = *diagonal * *diagonal / matrix.value[matrix.begin[unknown]];
            if (!(ratio >= least.first)) least = {ratio, unknown};
        }
    }
    if (!(least.first > smallest_pivot(matrix.size()))) refuse_pivot(matrix, least.second);
}

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
    next->number_solve();
    next->stats.supernodes = next->nodes.count();
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
    if (!state.part.empty()) {
        state.part = {};
        state.number_solve();
    }
    std::unique_ptr<double[]> value = std::move(state.value);
    const char* purpose = "factoring the linear system";
    MemoryCharge charge = context.charge(state.nodes.value_count() * sizeof(double), purpose);
    const MemoryCharge working = context.charge(state.stats.working_bytes, purpose);
    const auto start = Clock::now();
    if (!value) value = large_array<double>(state.nodes.value_count());
    const FactorTask task{state.nodes, state.plan, matrix.value.data(), value.get()};
    const Index failed = factor_supernodes(task, best_processor(), context);
    state.require_pivots(failed, value.get(), matrix);
    context.checkpoint();
    state.stats.factor_seconds = seconds_since(start);
    state.stats.computed_supernodes = state.nodes.count();
    state.value = std::move(value);
    state.charge = std::move(charge);
    state.factored = true;
}

void SparseSystem::solve(std::span<const double> b, std::span<double> x, Index columns) const {
    require_factor(state_->factored);
    require_sizes(b, x, size(), columns);
    const std::size_t rows = size();
    const Supernodes& nodes = state_->nodes;
    const SupernodalFactor factor{nodes.size(),
                                  size(),
                                  state_->solve_nodes,
                                  {nodes.super.data(), nodes.first_row.data(),
                                   nodes.first_value.data(), nodes.row.data(), state_->value.get()},
                                  state_->solve_row.data()};
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

namespace {

// The rows of a factor that a solve knows, numbered in their order, or kNoIndex.
std::vector<Index> number_rows(const std::vector<Index>& solve_row) {
    std::vector<Index> number(solve_row.size(), kNoIndex);
    Index next = 0;
    for (std::size_t i = 0; i < solve_row.size(); ++i) {
        if (solve_row[i] != kNoIndex) number[i] = next++;
    }
    return number;
}

// For each supernode the first above it, itself included, that is among `kept`, by its place there.
std::vector<Index> kept_nodes(const Supernodes& nodes, const std::vector<Index>& kept) {
    const std::vector<Index> parent = nodes.parents();
    std::vector<Index> place(parent.size() + 1, kNoIndex);
    place.back() = count_of(kept);
    for (std::size_t k = 0; k < kept.size(); ++k) place[at(kept[k])] = index_of(k);
    for (std::size_t s = parent.size(); s-- > 0;) {
        if (place[s] == kNoIndex) place[s] = place[at(parent[s])];
    }
    return place;
}

}  // namespace

// Rows and columns of the identity are left out.
SingleFactor SparseSystem::single_factor(const Context& context) const {
    require_factor(state_->factored);
    const Supernodes& from = state_->nodes;
    const std::vector<Index>& kept = state_->solve_nodes;
    const std::vector<Index> number = number_rows(state_->solve_row), parent = from.parents(),
                             place = kept_nodes(from, kept);
    SingleFactor::Supernodes to{{0}, {0}, {0}, {}, {}, {}, 0.0};
    std::vector<Index> permutation;
    to.value.reserve(from.value_count());
    prefer_large_pages(to.value);
    for (const Index s : kept) {
        for (Index j = from.super[s]; j < from.super[s + 1]; ++j) {
            if (number[at(j)] == kNoIndex) continue;
            const Index i = j - from.super[s];
            const double* diagonal =
                state_->value.get() + from.first_value[s] + i * (from.height(s) + 1);
            to.scale = std::max(to.scale, *diagonal);
            permutation.push_back(state_->solve_row[at(j)]);
        }
    }
    const double inverse = 1.0 / to.scale;
    std::vector<Index> taken;
    for (const Index s : kept) {
        taken.clear();
        const Index* row = from.row.data() + from.first_row[s];
        for (Index i = 0; i < from.height(s); ++i) {
            if (number[at(row[i])] == kNoIndex) continue;
            taken.push_back(i);
            to.row.push_back(number[at(row[i])]);
        }
        Index columns = 0;
        const double* column = state_->value.get() + from.first_value[s];
        for (Index j = 0; j < from.columns(s); ++j, column += from.height(s)) {
            if (number[at(row[j])] == kNoIndex) continue;
            ++columns;
            for (const Index i : taken) to.value.push_back(static_cast<float>(inverse * column[i]));
        }
        to.super.push_back(to.super.back() + columns);
        to.first_row.push_back(count_of(to.row));
        to.first_value.push_back(count_of(to.value));
        to.parent.push_back(place[at(parent[s])]);
    }
    return {std::move(to), std::move(permutation), context};
}

Index SparseSystem::size() const {
    return state_->part.empty() ? state_->size() : state_->part.size;
}

bool SparseSystem::factored() const {
    return state_->factored;
}

const FactorStats& SparseSystem::stats() const {
    return state_->stats;
}

}  // namespace lissom
