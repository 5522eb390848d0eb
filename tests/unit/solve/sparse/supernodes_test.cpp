#include "kernel/solve/sparse/supernodes.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "kernel/solve/sparse/minimum_degree.h"
#include "kernel/solve/sparse/sparse_system.h"
#include "tests/unit/solve/sparse/matrices.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

// The rows of each column of the factor, found by eliminating one unknown after the other.
std::vector<std::set<Index>> eliminated(const SymmetricMatrix& a, const std::vector<Index>& order) {
    const std::vector<Index> column_of = inverse_permutation(order);
    std::vector<std::set<Index>> rows(order.size());
    for (Index j = 0; j < a.size(); ++j) {
        for (Index k = a.begin[j]; k < a.begin[j + 1]; ++k) {
            const auto [low, high] = std::minmax(column_of[j], column_of[a.row[k]]);
            rows[low].insert(high);
        }
    }
    for (std::set<Index>& column : rows) {
        if (column.size() < 2) continue;
        const Index parent = *std::next(column.begin());
        rows[parent].insert(std::next(column.begin()), column.end());
    }
    return rows;
}

bool is_permutation_of_all(std::vector<Index> order, Index size) {
    std::sort(order.begin(), order.end());
    std::vector<Index> all(static_cast<std::size_t>(size));
    std::iota(all.begin(), all.end(), 0);
    return order == all;
}

std::vector<Index> natural(Index size) {
    std::vector<Index> order(static_cast<std::size_t>(size));
    std::iota(order.begin(), order.end(), 0);
    return order;
}

std::size_t entries(const std::vector<Index>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

// A tree of `size` unknowns, each hung from an earlier one.
SymmetricMatrix random_tree(Index size, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::pair<Index, Index>> pairs;
    for (Index i = 1; i < size; ++i) {
        pairs.emplace_back(i, static_cast<Index>(random() % static_cast<unsigned>(i)));
    }
    return test::dominant(size, pairs, seed);
}

// A path, and some unknowns that are coupled to everything.
SymmetricMatrix with_dense_rows(Index size, Index dense) {
    std::vector<std::pair<Index, Index>> pairs;
    for (Index i = 1; i < size; ++i) pairs.emplace_back(i - 1, i);
    for (Index d = 0; d < dense; ++d) {
        const Index row = d * (size / dense);
        for (Index i = 0; i < size; ++i) {
            if (i != row) pairs.emplace_back(row, i);
        }
    }
    return test::dominant(size, pairs);
}

}  // namespace

TEST_CASE("elimination tree: parents and counts are those of elimination, columns a postorder") {
    for (const test::NamedMatrix& named : test::matrices()) {
        const SymmetricMatrix& a = named.matrix;
        CAPTURE(named.name);
        if (a.size() > 1600) continue;
        const Adjacency graph(a);
        for (const std::vector<Index>& given : {natural(a.size()), minimum_degree_order(graph)}) {
            const EliminationTree tree = elimination_tree(graph, given);
            REQUIRE(is_permutation_of_all(tree.order, a.size()));
            const auto rows = eliminated(a, tree.order);
            Index wrong = 0;
            for (Index j = 0; j < a.size(); ++j) {
                const bool root = rows[j].size() == 1;
                if (tree.count[j] != count_of(rows[j])) ++wrong;
                if (tree.parent[j] != (root ? kNoIndex : *std::next(rows[j].begin()))) ++wrong;
            }
            CHECK(wrong == 0);
            const auto before = eliminated(a, given);
            std::size_t fill = 0;
            for (const auto& column : before) fill += column.size();
            CHECK(entries(tree.count) == fill);
        }
    }
}

TEST_CASE("supernodes: hold the pattern of the factor, rows ascending, columns first") {
    for (const test::NamedMatrix& named : test::matrices()) {
        const SymmetricMatrix& a = named.matrix;
        CAPTURE(named.name);
        if (a.size() > 1600) continue;
        const Supernodes nodes = analyze_supernodes(a);
        REQUIRE(is_permutation_of_all(nodes.permutation, a.size()));
        const auto rows = eliminated(a, nodes.permutation);
        Index wrong = 0;
        for (Index s = 0; s < nodes.count(); ++s) {
            const auto begin = nodes.row.begin() + nodes.first_row[s],
                       end = nodes.row.begin() + nodes.first_row[s + 1];
            std::set<Index> all;
            for (Index c = 0; c < nodes.columns(s); ++c) {
                const Index column = nodes.super[s] + c;
                if (begin[c] != column) ++wrong;
                all.insert(column);
                all.insert(rows[column].begin(), rows[column].end());
            }
            if (!std::equal(begin, end, all.begin(), all.end())) ++wrong;
            if (nodes.first_value[s + 1] - nodes.first_value[s] !=
                nodes.columns(s) * nodes.height(s)) {
                ++wrong;
            }
        }
        CHECK(wrong == 0);
        CHECK(nodes.super.back() == a.size());
    }
}

TEST_CASE("minimum degree: a tree has no fill, a grid little") {
    for (unsigned seed = 1; seed < 20; ++seed) {
        const SymmetricMatrix a = random_tree(500, seed);
        const Adjacency graph(a);
        CHECK(entries(elimination_tree(graph, minimum_degree_order(graph)).count) == a.nonzeros());
    }
    const Adjacency graph(test::grid(60, 60));
    const std::size_t ordered = entries(elimination_tree(graph, minimum_degree_order(graph)).count);
    CHECK(ordered < entries(elimination_tree(graph, natural(3600)).count) / 2);
}

TEST_CASE("minimum degree: unknowns with very many neighbors come last") {
    const Adjacency graph(with_dense_rows(3000, 4));
    const std::vector<Index> order = minimum_degree_order(graph);
    CHECK(is_permutation_of_all(order, 3000));
    CHECK(std::vector<Index>(order.end() - 4, order.end()) ==
          std::vector<Index>{0, 750, 1500, 2250});
}

TEST_CASE("minimum degree: lists that are moved together change nothing") {
    // Random couplings fill up: lists outgrow the room between them again and again.
    for (unsigned seed = 1; seed < 6; ++seed) {
        const Adjacency graph(test::random_pattern(2500, 10000, seed));
        const std::vector<Index> order = minimum_degree_order(graph);
        REQUIRE(is_permutation_of_all(order, 2500));
        CHECK(order == minimum_degree_order(graph));
    }
}

TEST_CASE("supernodes: an empty matrix has none") {
    const Supernodes nodes = analyze_supernodes(SymmetricMatrix{});
    CHECK(nodes.count() == 0);
    CHECK(nodes.value_count() == 0);
}

TEST_CASE("supernodes: a factor of more entries than can be counted is refused") {
    // The tree of a dense matrix whose factor has 2.45e9 entries.
    const Index n = 70000;
    EliminationTree tree;
    for (Index j = 0; j < n; ++j) {
        tree.order.push_back(j);
        tree.parent.push_back(j + 1 < n ? j + 1 : kNoIndex);
        tree.count.push_back(n - j);
    }
    const Error error = test::error_of([&] { join_columns(tree); });
    CHECK(error.code() == ErrorCode::memory_limit);
    CHECK(std::string(error.what()).find("smaller region or mesh") != std::string::npos);
}

TEST_CASE("analysis: memory is charged before it is taken, the analysis before stays") {
    const SymmetricMatrix a = test::grid(40, 40), small = test::grid(3, 3);
    std::size_t peak = 0;
    {
        const Context open;
        SparseSystem system;
        system.analyze(a, open);
        peak = open.memory()->peak();
        CHECK(open.memory()->used() == system.stats().analysis_bytes);
        CHECK(system.stats().analysis_bytes <= peak);
        // The ordering alone works on more than the pattern.
        CHECK(peak > minimum_degree_bytes(1600, 2 * (a.nonzeros() - 1600)));
    }
    SparseSystem system;
    system.analyze(small);
    for (std::size_t limit = 1; limit < peak; limit += peak / 23) {
        ContextOptions options;
        options.memory_limit = limit;
        const Context tight(options);
        const Error error = test::error_of([&] { system.analyze(a, tight); });
        CHECK(error.code() == ErrorCode::memory_limit);
        CHECK(tight.memory()->used() == 0);
        CHECK(system.size() == 9);
    }
    ContextOptions options;
    options.memory_limit = peak;
    system.analyze(a, Context(options));
    CHECK(system.size() == 1600);
}
