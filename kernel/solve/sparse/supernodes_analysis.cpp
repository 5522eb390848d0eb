#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/solve/sparse/elimination_tree.h"
#include "kernel/solve/sparse/minimum_degree.h"
#include "kernel/solve/sparse/supernodes.h"

namespace lissom {
namespace {

// Zeros that joining two supernodes may store, as a fraction of the block, by its columns.
struct Relaxation {
    std::int64_t columns;
    double zeros;
};
constexpr Index kAlwaysJoined = 4;
constexpr Relaxation kRelaxations[] = {
    {16, 0.8}, {48, 0.1}, {std::numeric_limits<Index>::max(), 0.05}};

constexpr const char* kAnalysis = "analysing the linear system";

void require_countable(std::int64_t count) {
    if (std::in_range<Index>(count)) return;
    throw Error(ErrorCode::memory_limit,
                "the factor of the linear system has more entries than can be counted; use a "
                "smaller region or mesh");
}

// A run of columns of the tree and the rows of its block.
struct Run {
    Index first = 0, columns = 0;
    std::int64_t height = 0, zeros = 0;
};

// Columns that have the same rows below them: each is the only child of the next, with one entry
// more.
std::vector<Run> fundamental_runs(const EliminationTree& tree) {
    std::vector<Index> children(tree.order.size(), 0);
    for (const Index parent : tree.parent) {
        if (parent != kNoIndex) ++children[parent];
    }
    std::vector<Run> runs;
    for (Index j = 0; j < tree.size(); ++j) {
        const bool goes_on = j > 0 && tree.parent[j - 1] == j && children[j] == 1 &&
                             tree.count[j - 1] == tree.count[j] + 1;
        if (!goes_on) runs.push_back({j, 0, tree.count[j], 0});
        ++runs.back().columns;
    }
    return runs;
}

// The run that each run hangs from: that of the parent of its last column, or kNoIndex.
std::vector<Index> parents_of_runs(const EliminationTree& tree, const std::vector<Run>& runs) {
    std::vector<Index> run_of(tree.order.size()), parent(runs.size(), kNoIndex);
    for (Index s = 0; s < count_of(runs); ++s) {
        std::fill_n(run_of.begin() + runs[s].first, runs[s].columns, s);
    }
    for (Index s = 0; s < count_of(runs); ++s) {
        const Index above = tree.parent[runs[s].first + runs[s].columns - 1];
        if (above != kNoIndex) parent[s] = run_of[above];
    }
    return parent;
}

// Joins `low` to the run `high` after it, its parent, if that stores few zeros: relaxed supernodes
// (Ashcraft and Grimes, The influence of relaxed supernode partitions on the multifrontal method,
// 1989). Small blocks are always joined.
bool join(Run& low, const Run& high) {
    const std::int64_t columns = low.columns + high.columns, height = low.columns + high.height;
    const std::int64_t made = low.columns * (height - low.height);
    std::int64_t zeros = high.zeros;
    if (columns > kAlwaysJoined && made > 0) {
        zeros += made;
        const double size = static_cast<double>(columns) * (columns + 1) / 2 +
                            static_cast<double>(columns) * (height - columns);
        const double fraction = static_cast<double>(zeros) / size;
        const auto allows = [&](const Relaxation& r) {
            return columns <= r.columns && fraction < r.zeros;
        };
        if (std::none_of(std::begin(kRelaxations), std::end(kRelaxations), allows)) return false;
    }
    low = {low.first, static_cast<Index>(columns), height, zeros};
    return true;
}

// From the last run to the first, each is joined to the next if that is its parent.
std::vector<Run> relaxed_runs(const EliminationTree& tree) {
    std::vector<Run> runs = fundamental_runs(tree);
    const std::vector<Index> parent = parents_of_runs(tree, runs);
    // The run that each has become part of.
    std::vector<Index> whole(runs.size());
    Index next = kNoIndex;
    std::vector<char> joined(runs.size(), 0);
    for (Index s = count_of(runs); s-- > 0; next = s) {
        whole[s] = s;
        if (parent[s] == kNoIndex) continue;
        Index above = parent[s];
        while (whole[above] != above) above = std::exchange(whole[above], whole[whole[above]]);
        if (above != next || !join(runs[s], runs[next])) continue;
        whole[next] = s;
        joined[next] = 1;
    }
    std::vector<Run> result;
    for (Index s = 0; s < count_of(runs); ++s) {
        if (!joined[s]) result.push_back(runs[s]);
    }
    return result;
}

// The rows of each supernode, ascending. Row k is in all those on the paths in the tree of
// supernodes from the columns of the matrix in that row up to its own.
void list_rows(Supernodes& nodes, const Adjacency& graph, const std::vector<Index>& column_parent) {
    const std::vector<Index> column_of = inverse_permutation(nodes.permutation),
                             node_of = nodes.nodes_of_columns();
    std::vector<Index> parent(at(nodes.count()), kNoIndex), last(parent), next(nodes.first_row);
    for (Index s = 0; s < nodes.count(); ++s) {
        const Index above = column_parent[nodes.super[s + 1] - 1];
        if (above != kNoIndex) parent[s] = node_of[above];
    }
    nodes.row.resize(at(nodes.first_row.back()));
    for (Index k = 0; k < nodes.size(); ++k) {
        const auto take = [&](Index s) {
            last[s] = k;
            nodes.row[next[s]++] = k;
        };
        take(node_of[k]);
        graph.for_each(nodes.permutation[k], [&](Index unknown) {
            const Index i = column_of[unknown];
            if (i >= k) return;
            for (Index s = node_of[i]; last[s] != k; s = parent[s]) take(s);
        });
    }
}

}  // namespace

Supernodes join_columns(EliminationTree tree) {
    Supernodes nodes;
    std::int64_t rows = 0, values = 0;
    for (const Run& run : relaxed_runs(tree)) {
        require_countable(values);
        nodes.super.push_back(run.first);
        nodes.first_row.push_back(static_cast<Index>(rows));
        nodes.first_value.push_back(static_cast<Index>(values));
        rows += run.height;
        values += run.height * run.columns;
    }
    // A block has at least as many values as rows.
    require_countable(values);
    nodes.super.push_back(tree.size());
    nodes.first_row.push_back(static_cast<Index>(rows));
    nodes.first_value.push_back(static_cast<Index>(values));
    nodes.permutation = std::move(tree.order);
    return nodes;
}

Supernodes analyze_supernodes(const SymmetricMatrix& matrix, const Context& context) {
    const std::size_t n = at(matrix.size()), entries = Adjacency::entries(matrix);
    require_countable(static_cast<std::int64_t>(minimum_degree_room(n, entries)));
    const MemoryCharge held = context.charge(
        Adjacency::bytes(matrix) + elimination_tree_bytes(n) + n * sizeof(Run), kAnalysis);
    const Adjacency graph(matrix);
    std::vector<Index> order;
    {
        const MemoryCharge working = context.charge(minimum_degree_bytes(n, entries), kAnalysis);
        order = minimum_degree_order(graph, context);
    }
    EliminationTree tree = elimination_tree(graph, std::move(order), context);
    context.checkpoint();
    const std::vector<Index> parent = tree.parent;
    Supernodes nodes = join_columns(std::move(tree));
    context.checkpoint();
    const MemoryCharge rows = context.charge(at(nodes.first_row.back()) * sizeof(Index), kAnalysis);
    list_rows(nodes, graph, parent);
    return nodes;
}

}  // namespace lissom
