#include "kernel/solve/sparse/elimination_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace lissom {
namespace {

// Integers per unknown, of the result and of the stages.
constexpr std::size_t kTreeArrays = 9;

// The parent of each column: the columns of row k that are roots so far get k as their parent.
// Ancestors are compressed on the way.
std::vector<Index> find_parents(const Adjacency& graph, const std::vector<Index>& order) {
    const std::vector<Index> column_of = inverse_permutation(order);
    std::vector<Index> parent(order.size(), kNoIndex), ancestor(order.size(), kNoIndex);
    for (Index k = 0; k < graph.size(); ++k) {
        graph.for_each(order[k], [&](Index unknown) {
            Index i = column_of[unknown];
            if (i >= k) return;
            while (ancestor[i] != kNoIndex && ancestor[i] != k) i = std::exchange(ancestor[i], k);
            if (ancestor[i] == kNoIndex) ancestor[i] = parent[i] = k;
        });
    }
    return parent;
}

// The columns of a forest, children before parents, by walking down from each root in turn.
// `child` holds the first child of each column, `sibling` the next.
std::vector<Index> walk_forest(const std::vector<Index>& parent, std::vector<Index> child,
                               const std::vector<Index>& sibling) {
    std::vector<Index> walk, path;
    walk.reserve(parent.size());
    for (Index root = 0; root < count_of(parent); ++root) {
        if (parent[root] != kNoIndex) continue;
        path.push_back(root);
        while (!path.empty()) {
            Index& next = child[path.back()];
            if (next == kNoIndex) {
                walk.push_back(path.back());
                path.pop_back();
            } else {
                path.push_back(std::exchange(next, sibling[next]));
            }
        }
    }
    return walk;
}

// Columns by descending count, equal ones by descending number.
std::vector<Index> descending(const std::vector<Index>& count) {
    std::vector<Index> first(count.size() + 2, 0), sorted(count.size());
    const auto bucket = [&](Index i) { return count.size() - at(count[i]); };
    for (Index i = 0; i < count_of(count); ++i) ++first[bucket(i) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (Index i = count_of(count); i-- > 0;) sorted[first[bucket(i)]++] = i;
    return sorted;
}

// Returns a postorder: children ascend by count, or by number without counts.
std::vector<Index> postorder(const std::vector<Index>& parent, const std::vector<Index>& count) {
    std::vector<Index> child(parent.size(), kNoIndex), sibling(parent.size(), kNoIndex);
    std::vector<Index> last_first =
        count.empty() ? std::vector<Index>(parent.size()) : descending(count);
    if (count.empty()) std::iota(last_first.rbegin(), last_first.rend(), 0);
    for (const Index i : last_first) {
        if (parent[i] != kNoIndex) sibling[i] = std::exchange(child[parent[i]], i);
    }
    return walk_forest(parent, std::move(child), sibling);
}

// Renumbers the columns of a tree by a walk of it.
void renumber(EliminationTree& tree, const std::vector<Index>& walk) {
    const std::vector<Index> to = inverse_permutation(walk);
    EliminationTree next;
    for (const Index i : walk) {
        next.order.push_back(tree.order[i]);
        next.parent.push_back(tree.parent[i] == kNoIndex ? kNoIndex : to[tree.parent[i]]);
        if (!tree.count.empty()) next.count.push_back(tree.count[i]);
    }
    tree = std::move(next);
}

// The first column of the subtree below each column of a postordered tree.
std::vector<Index> first_descendants(const std::vector<Index>& parent) {
    std::vector<Index> first(parent.size());
    std::iota(first.begin(), first.end(), 0);
    for (Index j = 0; j < count_of(parent); ++j) {
        if (parent[j] != kNoIndex) first[parent[j]] = std::min(first[parent[j]], first[j]);
    }
    return first;
}

// The root that column i has so far.
Index find_root(std::vector<Index>& ancestor, Index i) {
    Index root = i;
    while (ancestor[root] != root) root = ancestor[root];
    while (ancestor[i] != root) i = std::exchange(ancestor[i], root);
    return root;
}

// The entries of the columns of the factor. Those of row i form a subtree with root i. Its leaves
// are the columns j of the matrix such that no earlier column of the row is below j. Each leaf adds
// one on the path from it to the root; if the paths of two leaves in a row meet, one too many is
// taken away. Sums over the subtrees then give the counts.
std::vector<Index> count_entries(const Adjacency& graph, const std::vector<Index>& order,
                                 const std::vector<Index>& parent) {
    const std::vector<Index> column_of = inverse_permutation(order),
                             first = first_descendants(parent);
    std::vector<Index> count(order.size(), 0), ancestor(order.size());
    std::vector<Index> last_leaf(order.size(), kNoIndex);
    std::iota(ancestor.begin(), ancestor.end(), 0);
    for (Index j = 0; j < graph.size(); ++j) {
        count[j] += first[j] == j;
        graph.for_each(order[j], [&](Index unknown) {
            const Index i = column_of[unknown];
            if (i <= j || (last_leaf[i] != kNoIndex && first[j] <= last_leaf[i])) return;
            ++count[j];
            const Index before = std::exchange(last_leaf[i], j);
            if (before != kNoIndex) --count[find_root(ancestor, before)];
        });
        if (parent[j] == kNoIndex) continue;
        --count[parent[j]];
        ancestor[j] = parent[j];
    }
    for (Index j = 0; j < count_of(parent); ++j) {
        if (parent[j] != kNoIndex) count[parent[j]] += count[j];
    }
    return count;
}

}  // namespace

std::vector<Index> inverse_permutation(const std::vector<Index>& permutation) {
    std::vector<Index> to(permutation.size());
    for (std::size_t i = 0; i < to.size(); ++i) to[permutation[i]] = index_of(i);
    return to;
}

EliminationTree elimination_tree(const Adjacency& graph, std::vector<Index> order,
                                 const Context& context) {
    EliminationTree tree{std::move(order), {}, {}};
    tree.parent = find_parents(graph, tree.order);
    context.checkpoint();
    renumber(tree, postorder(tree.parent, {}));
    tree.count = count_entries(graph, tree.order, tree.parent);
    context.checkpoint();
    renumber(tree, postorder(tree.parent, tree.count));
    return tree;
}

std::size_t elimination_tree_bytes(std::size_t unknowns) {
    return kTreeArrays * unknowns * sizeof(Index);
}

}  // namespace lissom
