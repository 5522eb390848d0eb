#include "kernel/solve/sparse/sparse_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "kernel/core/extended.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

// The Laplacian of a square grid of side n plus `shift` on the diagonal.
SymmetricMatrix grid_laplacian(Index n, double shift) {
    std::vector<Triplet> entries;
    for (Index y = 0; y < n; ++y) {
        for (Index x = 0; x < n; ++x) {
            const Index i = y * n + x;
            entries.push_back({i, i, shift});
            for (const Index j : {x + 1 < n ? i + 1 : kNoIndex, y + 1 < n ? i + n : kNoIndex}) {
                if (j == kNoIndex) continue;
                entries.push_back({i, i, 1.0});
                entries.push_back({j, j, 1.0});
                entries.push_back({j, i, -1.0});
            }
        }
    }
    return symmetric_from_triplets(n * n, entries);
}

double residual(const SymmetricMatrix& a, const std::vector<double>& x,
                const std::vector<double>& b, Index columns) {
    std::vector<double> ax(x.size());
    a.multiply(x.data(), ax.data(), columns);
    double worst = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) worst = std::max(worst, std::abs(ax[i] - b[i]));
    return worst;
}

std::vector<double> random_vector(std::size_t size) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<double> values(size);
    for (double& v : values) v = uniform(generator);
    return values;
}

}  // namespace

TEST_CASE("solve: several columns at once satisfy the system") {
    const SymmetricMatrix a = grid_laplacian(40, 0.01);
    SparseSystem system;
    system.analyze(a);
    system.factor(a);
    const std::vector<double> b = random_vector(3 * 1600);
    std::vector<double> x(b.size());
    system.solve(b, x, 3);
    CHECK(residual(a, x, b, 3) < 1e-11);

    std::vector<double> in_place = b;
    system.solve(in_place, in_place, 3);
    CHECK(in_place == x);
}

TEST_CASE("solve: refined, an ill-conditioned system loses little to rounding, in every column") {
    for (const double shift : {1e-3, 1e-6, 1e-9}) {
        CAPTURE(shift);
        const SymmetricMatrix a = grid_laplacian(30, shift);
        SparseSystem system;
        system.analyze(a);
        system.factor(a);
        const std::vector<double> wanted = random_vector(3 * 900);
        // b = A x to more digits than a double has: what residual takes off zero.
        const std::vector<Extended> zero(wanted.size(), 0.0);
        std::vector<double> head(wanted.size()), tail(wanted.size());
        a.residual(zero.data(), wanted.data(), head.data(), 3);
        std::vector<Extended> b;
        for (const double value : head) b.push_back(-value);
        a.residual(b.data(), wanted.data(), tail.data(), 3);
        for (std::size_t i = 0; i < b.size(); ++i) b[i] -= tail[i];
        const auto error = [&](const std::vector<double>& x) {
            double worst = 0.0;
            for (std::size_t i = 0; i < x.size(); ++i) {
                worst = std::max(worst, std::abs(x[i] - wanted[i]));
            }
            return worst;
        };
        std::vector<double> x(b.size()), refined(b.size());
        system.solve(std::vector<double>(b.begin(), b.end()), x, 3);
        system.solve_refined(a, b, refined, 3);
        if (sizeof(Extended) > sizeof(double)) CHECK(error(refined) < 0.01 * error(x));
        CHECK(error(refined) <= error(x));
    }
}

TEST_CASE("factor: new values with the analysed pattern") {
    SparseSystem system;
    system.analyze(grid_laplacian(20, 1.0));
    for (const double shift : {1.0, 0.1, 10.0}) {
        const SymmetricMatrix a = grid_laplacian(20, shift);
        system.factor(a);
        const std::vector<double> b = random_vector(400);
        std::vector<double> x(b.size());
        system.solve(b, x, 1);
        CHECK(residual(a, x, b, 1) < 1e-11);
    }
}

TEST_CASE("factor: a component without a constraint is named") {
    // Two paths of three unknowns; only the first is held.
    const SymmetricMatrix a = symmetric_from_triplets(6, {{0, 0, 2.0},
                                                          {1, 0, -1.0},
                                                          {1, 1, 2.0},
                                                          {2, 1, -1.0},
                                                          {2, 2, 1.0},
                                                          {3, 3, 1.0},
                                                          {4, 3, -1.0},
                                                          {4, 4, 2.0},
                                                          {5, 4, -1.0},
                                                          {5, 5, 1.0}});
    SparseSystem system;
    system.analyze(a);
    const Error error = test::error_of([&] { system.factor(a); });
    CHECK(error.code() == ErrorCode::not_positive_definite);
    CHECK(error.elements().ids == std::vector<Index>{3, 4, 5});
    CHECK_FALSE(system.factored());
}

TEST_CASE("factor: the loose one of several components is named whole, wherever its rows stand") {
    std::mt19937 random(4);
    for (int round = 0; round < 30; ++round) {
        // Four rings of five unknowns, one of which is not held, in any order.
        std::vector<Index> place(20);
        std::iota(place.begin(), place.end(), 0);
        std::shuffle(place.begin(), place.end(), random);
        const int loose = round % 4;
        std::vector<Triplet> entries;
        std::vector<Index> expected;
        for (int c = 0; c < 4; ++c) {
            for (int k = 0; k < 5; ++k) {
                const Index a = place[5 * c + k], b = place[5 * c + (k + 1) % 5];
                entries.push_back({a, a, k == 0 && c != loose ? 3.0 : 2.0});
                entries.push_back({std::max(a, b), std::min(a, b), -1.0});
                if (c == loose) expected.push_back(a);
            }
        }
        std::sort(expected.begin(), expected.end());
        const SymmetricMatrix matrix = symmetric_from_triplets(20, entries);
        SparseSystem system;
        system.analyze(matrix);
        const Error error = test::error_of([&] { system.factor(matrix); });
        CHECK(error.code() == ErrorCode::not_positive_definite);
        CHECK(error.elements().kind == ElementKind::row);
        CHECK(error.elements().ids == expected);
    }
}

TEST_CASE("factor: an unconstrained large system is singular, not merely inaccurate") {
    const SymmetricMatrix a = grid_laplacian(60, 0.0);
    SparseSystem system;
    system.analyze(a);
    CHECK(test::error_of([&] { system.factor(a); }).code() == ErrorCode::not_positive_definite);
}

TEST_CASE("factor: an indefinite matrix is refused") {
    const SymmetricMatrix a = symmetric_from_triplets(2, {{0, 0, 1.0}, {1, 0, 3.0}, {1, 1, 1.0}});
    SparseSystem system;
    system.analyze(a);
    CHECK(test::error_of([&] { system.factor(a); }).code() == ErrorCode::not_positive_definite);
}

TEST_CASE("factor: memory is predicted, charged before factoring and released") {
    const SymmetricMatrix a = grid_laplacian(50, 1.0);
    SparseSystem probe;
    probe.analyze(a);
    const std::size_t held = probe.stats().factor_bytes;
    const std::size_t needed = held + probe.stats().working_bytes;
    CHECK(held > a.nonzeros() * sizeof(double));

    ContextOptions options;
    options.memory_limit = needed - 1;
    const Context tight(options);
    probe.analyze(a, tight);
    CHECK(test::error_of([&] { probe.factor(a, tight); }).code() == ErrorCode::memory_limit);
    CHECK(tight.memory()->used() == probe.stats().analysis_bytes);

    options.memory_limit = needed;
    const Context enough(options);
    {
        SparseSystem system;
        system.analyze(a, enough);
        system.factor(a, enough);
        CHECK(enough.memory()->used() == held);
        CHECK(enough.memory()->peak() == needed);
    }
    CHECK(enough.memory()->used() == 0);
}

TEST_CASE("misuse: no factor, wrong sizes, another pattern, an empty matrix, a cancel") {
    const SymmetricMatrix a = grid_laplacian(5, 1.0);
    SparseSystem system;
    std::vector<double> b(25), x(25), shorter(24);
    CHECK(test::error_of([&] { system.analyze({}); }).code() == ErrorCode::invalid_argument);
    system.analyze(a);
    CHECK(test::error_of([&] { system.solve(b, x, 1); }).code() == ErrorCode::invalid_argument);
    CHECK(test::error_of([&] { system.factor(grid_laplacian(6, 1.0)); }).code() ==
          ErrorCode::invalid_argument);
    const Context cancelled;
    cancelled.cancel();
    CHECK(test::error_of([&] { system.factor(a, cancelled); }).code() == ErrorCode::cancelled);
    system.factor(a);
    CHECK(test::error_of([&] { system.solve(b, shorter, 1); }).code() ==
          ErrorCode::invalid_argument);
}
