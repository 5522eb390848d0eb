#include <algorithm>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "kernel/solve/sparse/sparse_system.h"
#include "tests/unit/solve/sparse/matrices.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

using Part = std::vector<Index>;

// The rows and columns of `a` that belong to a part.
SymmetricMatrix restricted(const SymmetricMatrix& a, const Part& part) {
    Part row_of(at(a.size()), kNoIndex);
    for (std::size_t i = 0; i < part.size(); ++i) row_of[at(part[i])] = index_of(i);
    SymmetricMatrix result;
    for (const Index column : part) {
        for (Index e = a.begin[at(column)]; e < a.begin[at(column) + 1]; ++e) {
            if (row_of[at(a.row[at(e)])] == kNoIndex) continue;
            result.row.push_back(row_of[at(a.row[at(e)])]);
            result.value.push_back(a.value[at(e)]);
        }
        result.begin.push_back(count_of(result.row));
    }
    return result;
}

Part all_of(const SymmetricMatrix& a) {
    Part part(at(a.size()));
    std::iota(part.begin(), part.end(), 0);
    return part;
}

// All unknowns but `count` that follow `first`.
Part without(const SymmetricMatrix& a, Index first, Index count) {
    Part part;
    for (Index i = 0; i < a.size(); ++i) {
        if (i < first || i >= first + count) part.push_back(i);
    }
    return part;
}

Part random_part(const SymmetricMatrix& a, std::mt19937& generator) {
    Part part;
    for (Index i = 0; i < a.size(); ++i) {
        if (generator() % 4 != 0) part.push_back(i);
    }
    return part.empty() ? Part{0} : part;
}

SparseSystem analysed(const SymmetricMatrix& a) {
    SparseSystem system;
    system.analyze(a);
    return system;
}

// Solutions by the factor and by its copy in single precision.
std::pair<std::vector<double>, std::vector<Vec3>> part_solutions(const SparseSystem& system) {
    const std::size_t n = at(system.size());
    std::vector<double> x(2 * n);
    std::vector<Vec3> b(n), y(n);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i * 7 % 11) - 5.0;
    for (std::size_t i = 0; i < n; ++i) b[i] = {x[i], x[i + n], 1.0};
    system.solve(x, x, 2);
    SingleFactor::Scratch scratch;
    system.single_factor().solve(b, y, scratch);
    return {std::move(x), std::move(y)};
}

auto fresh_solutions(const SymmetricMatrix& a, const SymmetricMatrix& matrix, const Part& part) {
    SparseSystem system = analysed(a);
    system.factor_part(matrix, part);
    return part_solutions(system);
}

Context part_context(int threads, std::size_t memory_limit = 0) {
    ContextOptions options;
    options.threads = threads;
    options.memory_limit = memory_limit;
    return Context(options);
}

}  // namespace

TEST_CASE("factor_part: solves the system of its rows") {
    std::mt19937 generator(5);
    for (const test::NamedMatrix& named : test::matrices()) {
        CAPTURE(named.name);
        const Part part = random_part(named.matrix, generator);
        const SymmetricMatrix matrix = restricted(named.matrix, part);
        SparseSystem system = analysed(named.matrix);
        system.factor_part(matrix, part);
        REQUIRE(system.size() == matrix.size());
        std::vector<double> x(part.size(), 1.0), product(part.size());
        system.solve(x, x, 1);
        matrix.multiply(x.data(), product.data(), 1);
        std::vector<Vec3> y(part.size(), Vec3(1.0, 2.0, 3.0));
        SingleFactor::Scratch scratch;
        system.single_factor().solve(y, y, scratch);
        for (std::size_t i = 0; i < part.size(); ++i) {
            CHECK(product[i] == doctest::Approx(1.0).epsilon(1e-10));
            CHECK(y[i][1] == doctest::Approx(2.0 * x[i]).epsilon(1e-2));
        }
    }
}

TEST_CASE("factor_part: after any other part, it comes to the bits of a fresh system") {
    std::mt19937 generator(11);
    for (const int threads : {1, 2}) {
        const Context context = part_context(threads);
        for (const test::NamedMatrix& named : test::matrices()) {
            CAPTURE(named.name);
            const SymmetricMatrix& a = named.matrix;
            SparseSystem system = analysed(a);
            std::vector<Part> parts{all_of(a), random_part(a, generator), all_of(a)};
            for (int i = 0; i < 3; ++i) {
                if (a.size() < 4) break;
                const auto first = static_cast<Index>(generator() % at(a.size() - 1));
                parts.push_back(without(a, first, 1 + a.size() / 10));
            }
            for (const Part& part : parts) {
                SymmetricMatrix matrix = restricted(a, part);
                // Values change in one place, beside the rows.
                matrix.value[at(matrix.begin[at(matrix.size() / 2)])] += 0.25;
                system.factor_part(matrix, part, context);
                CHECK(part_solutions(system) == fresh_solutions(a, matrix, part));
            }
        }
    }
}

TEST_CASE("factor_part: computes the paths of changed columns alone") {
    const SymmetricMatrix a = test::grid(120, 110);
    SparseSystem system = analysed(a);
    const Part all = all_of(a);
    system.factor_part(a, all);
    CHECK(system.stats().computed_supernodes == system.stats().supernodes);
    system.factor_part(a, all);
    CHECK(system.stats().computed_supernodes == 0);

    const Part part = without(a, 3000, 8);
    system.factor_part(restricted(a, part), part);
    CHECK(system.stats().computed_supernodes > 0);
    CHECK(system.stats().computed_supernodes < system.stats().supernodes / 4);

    SymmetricMatrix doubled = a;
    for (double& value : doubled.value) value *= 2.0;
    system.factor_part(doubled, all);
    CHECK(system.stats().computed_supernodes == system.stats().supernodes);
}

TEST_CASE("factor_part: rows that nothing changes make no difference to the bits of all") {
    const SymmetricMatrix a = test::grid(60, 50);
    SparseSystem system = analysed(a);
    system.factor_part(a, all_of(a));
    const auto by_part = part_solutions(system);
    system.factor(a);
    CHECK(part_solutions(system) == by_part);
    system.factor_part(a, all_of(a));
    CHECK(part_solutions(system) == by_part);
}

TEST_CASE("factor_part: after an error there is no factor, and the next one is whole") {
    const SymmetricMatrix a = test::grid(120, 110);
    const Part part = without(a, 100, 40);
    const SymmetricMatrix matrix = restricted(a, part);
    SparseSystem system = analysed(a);
    system.factor_part(a, all_of(a));
    const auto is_recovered = [&] {
        CHECK_FALSE(system.factored());
        system.factor_part(matrix, part);
        CHECK(part_solutions(system) == fresh_solutions(a, matrix, part));
    };
    SUBCASE("cancelled") {
        const Context context;
        context.cancel();
        system.factor_part(a, all_of(a));
        CHECK(test::error_of([&] { system.factor_part(matrix, part, context); }).code() ==
              ErrorCode::cancelled);
        CHECK(system.factored());
    }
    SUBCASE("not positive definite") {
        SymmetricMatrix bad = matrix;
        bad.value[at(bad.begin[50])] = -1.0;
        const Error error = test::error_of([&] { system.factor_part(bad, part); });
        CHECK(error.code() == ErrorCode::not_positive_definite);
        is_recovered();
    }
    SUBCASE("memory") {
        const Context context = part_context(1, 1000);
        CHECK(test::error_of([&] { system.factor_part(matrix, part, context); }).code() ==
              ErrorCode::memory_limit);
        is_recovered();
    }
    SUBCASE("an entry beyond those analysed") {
        const SymmetricMatrix other = test::grid(120, 110, 2);
        CHECK(test::error_of([&] { system.factor_part(other, all_of(other)); }).code() ==
              ErrorCode::invalid_argument);
        is_recovered();
    }
}

TEST_CASE("factor_part: refuses a part that does not fit its matrix") {
    const SymmetricMatrix a = test::grid(10, 10);
    SparseSystem system = analysed(a);
    const SymmetricMatrix matrix = restricted(a, {3, 4, 9});
    for (const Part& part : {Part{3, 4}, Part{4, 3, 9}, Part{3, 4, 100}, Part{-1, 4, 9}}) {
        CHECK(test::error_of([&] { system.factor_part(matrix, part); }).code() ==
              ErrorCode::invalid_argument);
    }
    system.factor_part(matrix, Part{3, 4, 9});
    CHECK(system.size() == 3);
}

TEST_CASE("factor_part: memory that it keeps is charged, and released with the system") {
    const SymmetricMatrix a = test::grid(120, 110);
    const Context context = part_context(1);
    {
        SparseSystem system;
        system.analyze(a, context);
        const std::size_t before = context.memory()->used();
        system.factor_part(a, all_of(a), context);
        const std::size_t kept = context.memory()->used() - before;
        CHECK(kept > (system.stats().factor_nonzeros + a.nonzeros()) * sizeof(double));
        system.factor_part(a, all_of(a), context);
        CHECK(context.memory()->used() - before == kept);
    }
    CHECK(context.memory()->used() == 0);
}
