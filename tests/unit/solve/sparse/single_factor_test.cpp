#include "kernel/solve/sparse/single_factor.h"

#include <cmath>
#include <random>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/solve/sparse/sparse_system.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

// The Laplacian of `parts` separate square grids of side n, scaled, plus `shift` on the diagonal.
SymmetricMatrix grids(Index n, Index parts, double scale, double shift) {
    std::vector<Triplet> entries;
    for (Index part = 0; part < parts; ++part) {
        for (Index k = 0; k < n * n; ++k) {
            const Index i = part * n * n + k, x = k % n, y = k / n;
            entries.push_back({i, i, scale * shift});
            for (const Index j : {x + 1 < n ? i + 1 : kNoIndex, y + 1 < n ? i + n : kNoIndex}) {
                if (j == kNoIndex) continue;
                entries.push_back({i, i, scale});
                entries.push_back({j, j, scale});
                entries.push_back({j, i, -scale});
            }
        }
    }
    return symmetric_from_triplets(parts * n * n, entries);
}

std::vector<Vec3> random_rows(Index size, double scale) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<Vec3> rows;
    for (Index i = 0; i < size; ++i) {
        rows.push_back(scale * Vec3(uniform(generator), uniform(generator), uniform(generator)));
    }
    return rows;
}

// b - A x.
std::vector<Vec3> single_residual(const SymmetricMatrix& a, const std::vector<Vec3>& x,
                                  std::vector<Vec3> b) {
    for (Index j = 0; j < a.size(); ++j) {
        b[j] -= a.value[a.begin[j]] * x[j];
        for (Index k = a.begin[j] + 1; k < a.begin[j + 1]; ++k) {
            b[a.row[k]] -= a.value[k] * x[j];
            b[j] -= a.value[k] * x[a.row[k]];
        }
    }
    return b;
}

double norm(const std::vector<Vec3>& rows) {
    double sum = 0.0;
    for (const Vec3& row : rows) sum += row.squaredNorm();
    return std::sqrt(sum);
}

SparseSystem factored(const SymmetricMatrix& a) {
    SparseSystem system;
    system.analyze(a);
    system.factor(a);
    return system;
}

}  // namespace

TEST_CASE("single factor: each correction takes five digits off the residual") {
    for (const double scale : {1e-20, 1.0, 1e20}) {
        CAPTURE(scale);
        const SymmetricMatrix a = grids(60, 1, scale, 0.01);
        const SingleFactor factor = factored(a).single_factor();
        REQUIRE(factor.size() == a.size());
        const std::vector<Vec3> b = random_rows(a.size(), 1e-3 * scale);
        std::vector<Vec3> x(b.size(), Vec3::Zero()), correction(b.size());
        SingleFactor::Scratch scratch;
        for (const double bound : {1e-4, 1e-9, 1e-13}) {
            factor.solve(single_residual(a, x, b), correction, scratch);
            for (std::size_t i = 0; i < x.size(); ++i) x[i] += correction[i];
            CHECK(norm(single_residual(a, x, b)) < bound * norm(b));
        }
    }
}

TEST_CASE("single factor: separate components are solved as the whole is") {
    const SymmetricMatrix a = grids(20, 5, 1.0, 0.5);
    const SingleFactor factor = factored(a).single_factor();
    std::vector<Vec3> b = random_rows(a.size(), 1.0), x = b;
    SingleFactor::Scratch scratch;
    factor.solve(x, x, scratch);
    CHECK(norm(single_residual(a, x, b)) < 1e-5 * norm(b));
}

TEST_CASE("single factor: threads and old scratch do not change the result") {
    const SymmetricMatrix a = grids(70, 1, 1.0, 0.01);
    const SingleFactor factor = factored(a).single_factor();
    const std::vector<Vec3> b = random_rows(a.size(), 1.0);
    std::vector<Vec3> one(b.size()), many(b.size());
    SingleFactor::Scratch scratch, used(7, 3.0F);
    factor.solve(b, one, scratch);
    for (const int threads : {2, 4}) {
        ContextOptions options;
        options.threads = threads;
        factor.solve(b, many, used, Context(options));
        CHECK(many == one);
    }
}

TEST_CASE("single factor: zero, wrong sizes and a missing factor") {
    const SymmetricMatrix a = grids(5, 1, 1.0, 1.0);
    const SingleFactor factor = factored(a).single_factor();
    std::vector<Vec3> b(25, Vec3::Zero()), x(25, Vec3::Ones()), less(24);
    SingleFactor::Scratch scratch;
    factor.solve(b, x, scratch);
    CHECK(norm(x) == 0.0);
    CHECK_THROWS_AS(factor.solve(b, less, scratch), Error);
    CHECK_THROWS_AS(SparseSystem().single_factor(), Error);
}
