#include "kernel/solve/sparse/factor_plan.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "kernel/solve/sparse/elimination_tree.h"

namespace lissom {
namespace {

// Units of parallel work.
constexpr std::size_t kBins = 8;

// Subtrees are split further while they hold more than this share of the work.
constexpr double kLargestShare = 1.0 / 12.0;

// Operations below which a factorisation is not worth splitting.
constexpr double kMinWork = 2e6;

// Starts of groups from their sizes, which are counted at [group + 1].
void sum_up(std::vector<Index>& first) {
    std::partial_sum(first.begin(), first.end(), first.begin());
}

// Groups the entries of the matrix by the supernode they belong to.
void map_entries(const Supernodes& nodes, const SymmetricMatrix& pattern, FactorPlan& plan) {
    const std::vector<Index> to = inverse_permutation(nodes.permutation),
                             node_of = nodes.nodes_of_columns();
    plan.first_entry.assign(at(nodes.count()) + 1, 0);
    for (Index column = 0; column < pattern.size(); ++column) {
        for (Index k = pattern.begin[column]; k < pattern.begin[column + 1]; ++k) {
            ++plan.first_entry[node_of[std::min(to[column], to[pattern.row[k]])] + 1];
        }
    }
    sum_up(plan.first_entry);
    // Targets come in a second pass, which can look up the rows of one supernode.
    std::vector<Index> next = plan.first_entry;
    std::vector<Index> lower(pattern.row.size()), upper(pattern.row.size());
    plan.entries.resize(pattern.row.size());
    for (Index column = 0; column < pattern.size(); ++column) {
        for (Index k = pattern.begin[column]; k < pattern.begin[column + 1]; ++k) {
            const auto [low, high] = std::minmax(to[column], to[pattern.row[k]]);
            const Index at = next[node_of[low]]++;
            plan.entries[at].source = k;
            lower[at] = low;
            upper[at] = high;
        }
    }
    std::vector<Index> position(nodes.permutation.size());
    for (Index s = 0; s < nodes.count(); ++s) {
        const Index height = nodes.height(s);
        for (Index i = 0; i < height; ++i) position[nodes.row[nodes.first_row[s] + i]] = i;
        for (Index e = plan.first_entry[s]; e < plan.first_entry[s + 1]; ++e) {
            plan.entries[e].target =
                nodes.first_value[s] + (lower[e] - nodes.super[s]) * height + position[upper[e]];
        }
    }
}

// Cuts the elimination tree below its upper part. Subtrees are contiguous if the tree is
// postordered; otherwise everything counts as the upper part.
void split(const Supernodes& nodes, FactorPlan& plan) {
    const Index count = nodes.count();
    const std::vector<Index> parent = nodes.parents();
    std::vector<Index> first(count), members(first.size(), 1);
    std::vector<double> work(first.size(), 0.0);
    std::iota(first.begin(), first.end(), 0);
    bool postordered = true;
    double total = 0.0;
    for (Index s = 0; s < count; ++s) {
        const double height = nodes.height(s), own = height * height * nodes.columns(s);
        work[s] += own;
        total += own;
        postordered = postordered && s - first[s] + 1 == members[s];
        if (parent[s] == count) continue;
        work[parent[s]] += work[s];
        members[parent[s]] += members[s];
        first[parent[s]] = std::min(first[parent[s]], first[s]);
    }
    const bool splits = postordered && total >= kMinWork;
    const auto is_small = [&](Index s) { return splits && work[s] <= kLargestShare * total; };
    for (Index s = 0; s < count; ++s) {
        if (!is_small(s)) {
            plan.top.push_back(s);
        } else if (parent[s] == count || !is_small(parent[s])) {
            const auto rows = nodes.row.begin();
            plan.subtrees.push_back(
                {first[s],
                 s + 1,
                 {rows + nodes.first_row[s] + nodes.columns(s), rows + nodes.first_row[s + 1]},
                 work[s]});
        }
    }
}

// Greatest subtrees first, each into the bin with the least work.
void fill_bins(FactorPlan& plan) {
    std::vector<Index> order(plan.subtrees.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
        return plan.subtrees[a].work > plan.subtrees[b].work;
    });
    plan.bins.resize(std::min(kBins, plan.subtrees.size()));
    std::vector<double> load(plan.bins.size(), 0.0);
    for (const Index i : order) {
        const auto bin = std::min_element(load.begin(), load.end()) - load.begin();
        plan.bins[bin].push_back(i);
        load[bin] += plan.subtrees[i].work;
    }
}

// Calls use(block, update) for each block that rows of block `from` are columns of. Rows from
// `end_column` on go to `extension` instead, if there is one.
template <typename Use>
void for_each_update(const std::vector<Index>& node_of, Index from, const Index* rows, Index begin,
                     Index end, Index end_column, Index extension, const Use& use) {
    while (begin < end) {
        if (extension != kNoIndex && rows[begin] >= end_column) {
            use(extension, FactorPlan::Update{from, begin, end});
            return;
        }
        const Index node = node_of[rows[begin]];
        Index next = begin + 1;
        while (next < end && node_of[rows[next]] == node) ++next;
        use(node, FactorPlan::Update{from, begin, next});
        begin = next;
    }
}

// Blocks in ascending order of their source, extensions last.
template <typename Use>
void for_each_update(const Supernodes& nodes, const FactorPlan& plan, const Use& use) {
    const std::vector<Index> node_of = nodes.nodes_of_columns();
    std::vector<Index> subtree_of(nodes.count(), kNoIndex);
    const auto subtrees = count_of(plan.subtrees);
    for (Index i = 0; i < subtrees; ++i) {
        std::fill(subtree_of.begin() + plan.subtrees[i].first,
                  subtree_of.begin() + plan.subtrees[i].last, i);
    }
    for (Index s = 0; s < nodes.count(); ++s) {
        const Index i = subtree_of[s];
        const bool is_top = i == kNoIndex;
        for_each_update(node_of, s, nodes.row.data() + nodes.first_row[s], nodes.columns(s),
                        nodes.height(s), is_top ? 0 : nodes.super[plan.subtrees[i].last],
                        is_top ? kNoIndex : nodes.count() + i, use);
    }
    for (Index i = 0; i < subtrees; ++i) {
        const std::vector<Index>& above = plan.subtrees[i].above;
        for_each_update(node_of, nodes.count() + i, above.data(), 0, count_of(above), 0, kNoIndex,
                        use);
    }
}

void list_updates(const Supernodes& nodes, FactorPlan& plan) {
    const std::size_t blocks = nodes.count() + plan.subtrees.size();
    plan.first_update.assign(blocks + 1, 0);
    for_each_update(nodes, plan, [&](Index block, const FactorPlan::Update&) {
        ++plan.first_update[block + 1];
    });
    sum_up(plan.first_update);
    plan.updates.resize(plan.first_update.back());
    std::vector<Index> next = plan.first_update;
    for_each_update(nodes, plan, [&](Index block, const FactorPlan::Update& update) {
        plan.updates[next[block]++] = update;
    });
}

template <typename T>
std::size_t bytes_of(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}

}  // namespace

std::size_t FactorPlan::bytes() const {
    std::size_t sum = bytes_of(first_update) + bytes_of(updates) + bytes_of(first_entry) +
                      bytes_of(entries) + bytes_of(top);
    for (const Subtree& subtree : subtrees) sum += sizeof(Subtree) + bytes_of(subtree.above);
    return sum;
}

std::size_t FactorPlan::extension_bytes() const {
    std::size_t sum = 0;
    for (const Subtree& t : subtrees) sum += t.above.size() * t.above.size() * sizeof(double);
    return sum;
}

// Each row of a supernode begins at most one update, and one more through an extension.
std::size_t planning_bytes(const Supernodes& nodes, const SymmetricMatrix& pattern) {
    const std::size_t updates = 2 * nodes.row.size(), count = at(nodes.count());
    return pattern.nonzeros() * (sizeof(FactorPlan::Entry) + 2 * sizeof(Index)) +
           updates * (sizeof(FactorPlan::Update) + sizeof(Index)) +
           nodes.permutation.size() * 4 * sizeof(Index) +
           count * (sizeof(FactorPlan::Subtree) + 10 * sizeof(Index));
}

FactorPlan plan_factor(const Supernodes& nodes, const SymmetricMatrix& pattern) {
    FactorPlan plan;
    map_entries(nodes, pattern, plan);
    split(nodes, plan);
    fill_bins(plan);
    list_updates(nodes, plan);
    for (Index s = 0; s < nodes.count(); ++s) {
        plan.tallest = std::max(plan.tallest, nodes.height(s));
    }
    for (const Index s : plan.top) plan.widest = std::max(plan.widest, nodes.columns(s));
    return plan;
}

}  // namespace lissom
