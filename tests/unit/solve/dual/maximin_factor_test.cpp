#include "kernel/solve/dual/maximin_factor.h"

#include <algorithm>
#include <random>
#include <vector>

#include "tests/unit/solve/grid/grids.h"
#include "tests/unit/support.h"

using namespace lissom;
using test::Field;

namespace {

ConstraintRows rows_of(const GridSize& size, const std::vector<GridConstraint>& constraints) {
    ConstraintRows rows;
    for (const GridConstraint& c : constraints) {
        rows.point.push_back(size.point(c.point));
        rows.weight.push_back(c.weight);
    }
    return rows;
}

Field random_vectors(std::size_t count) {
    std::mt19937 random(50);
    Field vectors;
    for (std::size_t i = 0; i < count; ++i) vectors.push_back(test::random_vector(random));
    return vectors;
}

Field applied(const MaximinFactor& factor, const Field& from) {
    Field to(from.size());
    factor.apply(from, to);
    return to;
}

// M x, entry by entry.
Field multiplied(const GridGreen& green, const ConstraintRows& rows, const Field& x) {
    Field y(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        y[i] = x[i] / (rows.weight[i] * rows.weight[i]);
        for (std::size_t j = 0; j < x.size(); ++j) {
            y[i] += (green.entry(rows.point[i], rows.point[j]) + green.shift()) * x[j];
        }
    }
    return y;
}

}  // namespace

TEST_CASE("maximin factor: where all rows are neighbours it is the inverse") {
    const GridSize size{3, 3, 3};
    std::mt19937 random(51);
    const ConstraintRows rows = rows_of(size, test::random_constraints(size, 20, random));
    const GridGreen green(size, 0.0, {});
    MaximinFactor factor;
    factor.update(green, rows, {});
    const Field x = random_vectors(rows.size());
    CHECK(test::max_difference(applied(factor, multiplied(green, rows, x)), x) < 1e-10);
}

TEST_CASE("maximin factor: it comes close to the inverse for many rows") {
    const GridSize size{20, 20, 20};
    std::mt19937 random(52);
    const ConstraintRows rows = rows_of(size, test::random_constraints(size, 500, random));
    const GridGreen green(size, 0.0, {});
    MaximinFactor factor;
    factor.update(green, rows, {});
    // Ten steps of x += U U^T (b - M x) would not converge with a poor inverse.
    const Field wanted = random_vectors(rows.size()), b = multiplied(green, rows, wanted);
    Field x(rows.size(), Vec3::Zero());
    for (int step = 0; step < 10; ++step) {
        Field residual = multiplied(green, rows, x);
        for (std::size_t i = 0; i < x.size(); ++i) residual[i] = b[i] - residual[i];
        const Field more = applied(factor, residual);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += more[i];
    }
    CHECK(test::max_difference(x, wanted) < 1e-2);
}

TEST_CASE("maximin factor: after edits it is what it would be from nothing, to the bit") {
    const GridSize size{16, 15, 17};
    std::mt19937 random(53);
    const GridGreen green(size, 0.0, {});
    MaximinFactor edited;
    auto constraints = test::random_constraints(size, 300, random);
    for (int step = 0; step < 12; ++step) {
        const auto at = std::ptrdiff_t{20} * step;
        if (step % 3 == 0)
            constraints.erase(constraints.begin() + at, constraints.begin() + at + 7);
        if (step % 3 == 1) constraints[at].weight = 7.0;
        if (step % 3 == 2) std::reverse(constraints.begin(), constraints.end());
        const ConstraintRows rows = rows_of(size, constraints);
        edited.update(green, rows, {});
        MaximinFactor fresh;
        fresh.update(green, rows, {});
        const Field x = random_vectors(rows.size());
        CHECK(test::max_difference(applied(edited, x), applied(fresh, x)) == 0.0);
    }
}

TEST_CASE("maximin factor: without the memory it needs, or cancelled, it stays what it was") {
    const GridSize size{20, 20, 20};
    std::mt19937 random(54);
    const GridGreen green(size, 0.0, {});
    const ConstraintRows few = rows_of(size, test::random_constraints(size, 50, random));
    const ConstraintRows many = rows_of(size, test::random_constraints(size, 500, random));
    MaximinFactor factor;
    factor.update(green, few, {});
    const Field x = random_vectors(few.size()), before = applied(factor, x);
    ContextOptions limits;
    // A row has dozens of entries of twelve bytes.
    limits.memory_limit = 20 * 12 * many.size();
    CHECK(test::error_of([&] { factor.update(green, many, Context(limits)); }).code() ==
          ErrorCode::memory_limit);
    CHECK(test::max_difference(applied(factor, x), before) == 0.0);
    const Context cancelled;
    cancelled.cancel();
    CHECK(test::error_of([&] { factor.update(green, many, cancelled); }).code() ==
          ErrorCode::cancelled);
    CHECK(test::max_difference(applied(factor, x), before) == 0.0);
    limits.memory_limit = 200 * 12 * many.size();
    CHECK_NOTHROW(factor.update(green, many, Context(limits)));
}
