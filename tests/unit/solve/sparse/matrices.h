/// Symmetric positive definite matrices of many structures.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "kernel/solve/sparse/sparse_matrix.h"

namespace lissom::test {

struct NamedMatrix {
    std::string name;
    SymmetricMatrix matrix;
};

/// A matrix with these pairs as its pattern, entries in [-1, 1], and diagonals that exceed the sum
/// of their row.
inline SymmetricMatrix dominant(Index size, const std::vector<std::pair<Index, Index>>& pairs,
                                unsigned seed = 3) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<Triplet> entries;
    for (Index i = 0; i < size; ++i) entries.push_back({i, i, 0.01});
    for (const auto& [a, b] : pairs) {
        const double value = uniform(generator);
        entries.push_back({std::max(a, b), std::min(a, b), value});
        entries.push_back({a, a, std::abs(value)});
        entries.push_back({b, b, std::abs(value)});
    }
    return symmetric_from_triplets(size, entries);
}

/// A grid of width x height unknowns, each coupled to those within `reach`.
inline SymmetricMatrix grid(Index width, Index height, Index reach = 1, unsigned seed = 3) {
    std::vector<std::pair<Index, Index>> pairs;
    for (Index y = 0; y < height; ++y) {
        for (Index x = 0; x < width; ++x) {
            for (Index v = y; v <= std::min(y + reach, height - 1); ++v) {
                for (Index u = std::max<Index>(0, x - reach); u <= std::min(x + reach, width - 1);
                     ++u) {
                    if (v > y || u > x) pairs.emplace_back(y * width + x, v * width + u);
                }
            }
        }
    }
    return dominant(width * height, pairs, seed);
}

inline SymmetricMatrix random_pattern(Index size, Index pairs_count, unsigned seed) {
    std::mt19937 generator(seed);
    std::vector<std::pair<Index, Index>> pairs;
    while (static_cast<Index>(pairs.size()) < pairs_count) {
        const auto a = static_cast<Index>(generator() % static_cast<unsigned>(size));
        const auto b = static_cast<Index>(generator() % static_cast<unsigned>(size));
        if (a != b) pairs.emplace_back(a, b);
    }
    return dominant(size, pairs, seed);
}

/// One of every structure; the larger ones are cut into subtrees.
inline std::vector<NamedMatrix> matrices() {
    std::vector<NamedMatrix> all;
    all.push_back({"1x1", dominant(1, {})});
    all.push_back({"diagonal", dominant(50, {})});
    for (const Index n : {2, 3, 4, 5, 7, 12, 65, 131, 300}) {
        std::vector<std::pair<Index, Index>> dense, arrow;
        for (Index i = 0; i < n; ++i) {
            for (Index j = 0; j < i; ++j) dense.emplace_back(i, j);
            if (i > 0) arrow.emplace_back(i, 0);
        }
        all.push_back({"dense " + std::to_string(n), dominant(n, dense)});
        all.push_back({"arrow " + std::to_string(n), dominant(n, arrow)});
    }
    all.push_back({"path", grid(200, 1)});
    all.push_back({"grid", grid(37, 41)});
    all.push_back({"wide grid", grid(60, 50, 2)});
    all.push_back({"grid with subtrees", grid(110, 90)});
    for (unsigned seed = 1; seed < 12; ++seed) {
        const auto n = static_cast<Index>(20 * seed);
        all.push_back({"random " + std::to_string(seed), random_pattern(n, n + n / 2, seed)});
        all.push_back({"components " + std::to_string(seed), random_pattern(n, n / 3, seed)});
    }
    all.push_back({"random with fill", random_pattern(900, 2700, 5)});
    return all;
}

}  // namespace lissom::test
