#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

#include "kernel/core/clock.h"
#include "kernel/core/error.h"
#include "kernel/core/large_pages.h"
#include "kernel/core/numbers/bits.h"
#include "kernel/solve/sparse/elimination_tree.h"
#include "kernel/solve/sparse/sparse_system_check.h"
#include "kernel/solve/sparse/sparse_system_state.h"
#include "kernel/solve/sparse/supernodal_factor.h"

namespace lissom {
namespace {

void require_part(const SymmetricMatrix& matrix, std::span<const Index> part, Index size) {
    require_valid(matrix);
    const bool ascends =
        std::adjacent_find(part.begin(), part.end(), std::greater_equal<>()) == part.end();
    if (ascends && count_of(part) == matrix.size() && part.front() >= 0 && part.back() < size)
        return;
    throw Error(ErrorCode::invalid_argument,
                "a part names one unknown of those analysed for each row of its matrix, ascending");
}

// Writes a matrix over a part of the unknowns into one over all, of the pattern `begin` and `row`,
// and calls changed(column, row) for each entry with another value than before.
// Errors: invalid_argument for an entry beyond the pattern.
template <typename Changed>
void embed(const SymmetricMatrix& matrix, std::span<const Index> part,
           const std::vector<Index>& begin, const std::vector<Index>& row,
           const std::vector<Index>& row_of, std::vector<double>& value, const Changed& changed) {
    const auto write = [&](Index column, Index entry, double now) {
        if (bits_as<std::uint64_t>(value[at(entry)]) == bits_as<std::uint64_t>(now)) return;
        value[at(entry)] = now;
        changed(column, row[at(entry)]);
    };
    const Index size = count_of(begin) - 1;
    for (Index column = 0; column < size; ++column) {
        const Index own = row_of[at(column)];
        Index entry = begin[at(column)];
        const Index end = begin[at(column) + 1];
        if (own == kNoIndex) write(column, entry++, 1.0);
        const Index first = own == kNoIndex ? 0 : matrix.begin[at(own)];
        const Index last = own == kNoIndex ? 0 : matrix.begin[at(own) + 1];
        for (Index e = first; e < last; ++e) {
            const Index target = part[at(matrix.row[at(e)])];
            while (entry < end && row[at(entry)] < target) write(column, entry++, 0.0);
            if (entry == end || row[at(entry)] != target) {
                throw Error(ErrorCode::invalid_argument,
                            "the matrix has an entry that was not analysed; analyze it first");
            }
            write(column, entry++, matrix.value[at(e)]);
        }
        while (entry < end) write(column, entry++, 0.0);
    }
}

// Marks all supernodes above marked ones.
void mark_paths(const Supernodes& nodes, std::vector<char>& marked) {
    const std::vector<Index> parent = nodes.parents();
    for (std::size_t s = 0; s < marked.size(); ++s) {
        if (marked[s] && parent[s] < nodes.count()) marked[at(parent[s])] = 1;
    }
}

// The supernodes without a column of a part.
std::vector<char> idle_nodes(const Supernodes& nodes, const std::vector<Index>& row_of) {
    std::vector<char> idle(at(nodes.count()), 1);
    for (Index s = 0; s < nodes.count(); ++s) {
        for (Index j = nodes.super[s]; j < nodes.super[s + 1]; ++j) {
            if (row_of[at(nodes.permutation[at(j)])] != kNoIndex) idle[at(s)] = 0;
        }
    }
    return idle;
}

}  // namespace

void SparseSystem::factor_part(const SymmetricMatrix& matrix, std::span<const Index> unknowns,
                               const Context& context) {
    State& state = *state_;
    FactorPart& part = state.part;
    require_part(matrix, unknowns, state.size());
    context.checkpoint();
    const bool again = std::exchange(state.factored, false) && !part.empty();
    const char* purpose = "factoring the linear system";
    const std::size_t extensions = state.plan.extension_bytes();
    if (!again) {
        part = {};
        state.value.reset();
        state.charge = {};
        const std::size_t kept =
            (state.nodes.value_count() + state.row.size()) * sizeof(double) + extensions;
        state.charge = context.charge(kept, purpose);
        state.stats.factor_bytes = state.stats.analysis_bytes + kept;
        state.value = large_array<double>(state.nodes.value_count());
        part.extensions = large_array<double>(extensions / sizeof(double));
        part.value.assign(state.row.size(), 0.0);
    }
    const MemoryCharge working = context.charge(state.stats.working_bytes - extensions, purpose);
    const auto start = Clock::now();
    const std::vector<Index> column_of = inverse_permutation(state.nodes.permutation),
                             node_of = state.nodes.nodes_of_columns();
    std::vector<char> changed(at(state.nodes.count()), again ? 0 : 1);
    part.row_of.assign(at(state.size()), kNoIndex);
    part.size = matrix.size();
    for (std::size_t i = 0; i < unknowns.size(); ++i) part.row_of[at(unknowns[i])] = index_of(i);
    embed(matrix, unknowns, state.begin, state.row, part.row_of, part.value,
          [&](Index column, Index row) {
              const Index first = std::min(column_of[at(column)], column_of[at(row)]);
              changed[at(node_of[at(first)])] = 1;
          });
    part.idle = idle_nodes(state.nodes, part.row_of);
    state.number_solve();
    mark_paths(state.nodes, changed);
    const FactorTask task{state.nodes,    state.plan,       part.value.data(),    state.value.get(),
                          changed.data(), part.idle.data(), part.extensions.get()};
    const Index failed = factor_supernodes(task, best_processor(), context);
    state.require_pivots(failed, state.value.get(), matrix);
    context.checkpoint();
    state.stats.factor_seconds = seconds_since(start);
    state.stats.computed_supernodes = index_of(std::count(changed.begin(), changed.end(), char{1}));
    state.factored = true;
}

}  // namespace lissom
