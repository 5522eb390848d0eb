#include "kernel/solve/field/grid_field.h"

#include <array>
#include <limits>
#include <random>
#include <vector>

#include "tests/unit/solve/grid/grids.h"
#include "tests/unit/support.h"

using namespace lissom;
using test::Field;
using test::max_difference;
using test::solved_field;

namespace {

// One solve of each kind of dual system.
GridFieldOptions dense() {
    return {};
}

GridFieldOptions iterative() {
    GridFieldOptions options;
    options.dense_limit = 0;
    options.tolerance = 1e-12;
    return options;
}

GridFieldOptions thesis() {
    GridFieldOptions options;
    options.boundary = GridBoundary::thesis;
    options.tolerance = 1e-12;
    return options;
}

GridFieldOptions cholesky_solve(GridBoundary boundary = GridBoundary::zero_flux) {
    GridFieldOptions options;
    options.solver = GridSolver::cholesky;
    options.boundary = boundary;
    options.refinements = 1;
    return options;
}

Context two_threads() {
    ContextOptions options;
    options.threads = 2;
    return Context(options);
}

Field scaled(Field field, double factor) {
    for (Vec3& v : field) v *= factor;
    return field;
}

}  // namespace

TEST_CASE("grid field: every solver and boundary gives the minimiser of the energy") {
    std::mt19937 random(11);
    const GridSize sizes[] = {{7, 6, 5}, {1, 9, 4}, {12, 1, 1}, {2, 2, 2}};
    for (const GridSize& size : sizes) {
        for (const double tension : {0.0, 0.1}) {
            const auto constraints =
                test::random_constraints(size, std::max(1, size.count() / 9), random);
            for (const GridBoundary boundary : {GridBoundary::zero_flux, GridBoundary::thesis}) {
                const Field oracle = test::dense_solution(size, constraints, boundary, tension);
                for (GridFieldOptions options : {dense(), iterative(), cholesky_solve()}) {
                    options.boundary = boundary;
                    options.tension = tension;
                    options.tolerance = 1e-12;
                    CAPTURE(size.nx);
                    CAPTURE(tension);
                    CAPTURE(options.dense_limit.value_or(kNoIndex));
                    CHECK(max_difference(solved_field(size, constraints, options), oracle) < 1e-9);
                }
            }
        }
    }
}

TEST_CASE("grid field: weights from soft to nearly hard give the minimiser") {
    std::mt19937 random(12);
    const GridSize size{6, 5, 6};
    for (const double weight : {0.01, 1.0, 100.0, 1e4}) {
        auto constraints = test::random_constraints(size, 25, random, weight);
        constraints[3].weight = 10.0;
        const Field oracle = test::dense_solution(size, constraints, GridBoundary::zero_flux, 0.0);
        for (const GridFieldOptions& options : {dense(), iterative()}) {
            CHECK(max_difference(solved_field(size, constraints, options), oracle) < 1e-8);
        }
    }
}

TEST_CASE("grid field: without a constraint the field is zero") {
    for (const GridFieldOptions& options : {dense(), iterative(), thesis(), cholesky_solve()}) {
        const Field field = solved_field({4, 3, 5}, {}, options);
        CHECK(max_difference(field, Field(60, Vec3::Zero())) == 0.0);
    }
}

TEST_CASE("grid field: one constraint, or equal ones, give a constant field") {
    const Vec3 v(0.3, -0.7, 0.2);
    for (const GridFieldOptions& options : {dense(), iterative(), thesis(), cholesky_solve()}) {
        CHECK(max_difference(solved_field({4, 3, 5}, {{17, v}}, options), Field(60, v)) < 1e-9);
        CHECK(max_difference(solved_field({4, 3, 5}, {{17, v}, {3, v, 2.0}, {50, v}}, options),
                             Field(60, v)) < 1e-9);
        CHECK(max_difference(solved_field({1, 1, 1}, {{0, v}}, options), Field(1, v)) < 1e-12);
    }
}

TEST_CASE("grid field: all points may be constrained") {
    std::mt19937 random(13);
    const GridSize size{5, 6, 4};
    const auto constraints = test::random_constraints(size, size.count(), random);
    for (const GridFieldOptions& options : {dense(), iterative(), thesis(), cholesky_solve()}) {
        const Field oracle = test::dense_solution(size, constraints, options.boundary, 0.0);
        CHECK(max_difference(solved_field(size, constraints, options), oracle) < 1e-9);
    }
}

TEST_CASE("grid field: owners that contradict each other give the average by squared weight") {
    for (const GridFieldOptions& options : {dense(), iterative(), thesis(), cholesky_solve()}) {
        GridField field({4, 3, 5}, options);
        field.set_constraints(1, {{17, Vec3(1.0, 0.0, 0.0), 100.0}});
        field.set_constraints(2, {{17, Vec3(-1.0, 1.0, 0.0), 200.0}});
        CHECK(max_difference(solved_field(field), Field(60, Vec3(-0.6, 0.8, 0.0))) < 1e-9);
        CHECK(field.constraint_count() == 1);
    }
}

TEST_CASE("grid field: neighbours that contradict each other meet in the middle") {
    const GridSize size{9, 9, 9};
    const Index a = size.index({4, 4, 4}), b = size.index({5, 4, 4});
    const Field field = solved_field(size, {{a, Vec3::UnitX()}, {b, -Vec3::UnitX()}});
    CHECK(field[a].x() == doctest::Approx(1.0).epsilon(1e-3));
    CHECK(field[b].x() == doctest::Approx(-1.0).epsilon(1e-3));
    for (const Vec3& v : field) CHECK(v.allFinite());
}

TEST_CASE("grid field: it is linear in the vectors given") {
    std::mt19937 random(14);
    const GridSize size{9, 8, 10};
    const auto one = test::random_constraints(size, 60, random);
    auto other = one, sum = one;
    for (std::size_t i = 0; i < one.size(); ++i) {
        other[i].value = test::random_vector(random);
        sum[i].value = 2.0 * one[i].value - 3.0 * other[i].value;
    }
    for (const GridFieldOptions& options : {dense(), iterative(), thesis()}) {
        const Field a = scaled(solved_field(size, one, options), 2.0);
        const Field b = scaled(solved_field(size, other, options), -3.0);
        const Field c = solved_field(size, sum, options);
        double worst = 0.0;
        for (std::size_t i = 0; i < c.size(); ++i) {
            worst = std::max(worst, (c[i] - a[i] - b[i]).cwiseAbs().maxCoeff());
        }
        CHECK(worst < 1e-8);
    }
}

TEST_CASE("grid field: mirrored and turned constraints give the mirrored and turned field") {
    std::mt19937 random(15);
    const GridSize size{8, 7, 9}, turned{9, 8, 7};
    const auto constraints = test::random_constraints(size, 50, random);
    for (const GridFieldOptions& options : {dense(), iterative(), thesis()}) {
        auto mirror = constraints, turn = constraints;
        for (std::size_t i = 0; i < constraints.size(); ++i) {
            const GridPoint p = size.point(constraints[i].point);
            mirror[i].point = size.index({p.x, size.ny - 1 - p.y, p.z});
            turn[i].point = turned.index({p.z, p.x, p.y});
        }
        const Field field = solved_field(size, constraints, options);
        const Field mirrored = solved_field(size, mirror, options);
        const Field rotated = solved_field(turned, turn, options);
        double worst = 0.0;
        for (Index i = 0; i < size.count(); ++i) {
            const GridPoint p = size.point(i);
            const Vec3& other = mirrored[size.index({p.x, size.ny - 1 - p.y, p.z})];
            worst = std::max(worst, (field[i] - other).norm());
            worst = std::max(worst, (field[i] - rotated[turned.index({p.z, p.x, p.y})]).norm());
        }
        CHECK(worst < 1e-8);
    }
}

TEST_CASE("grid field: far from the faces a moved set-up gives the moved field") {
    const GridSize size{40, 40, 40};
    const auto dipole = [&](Index shift) {
        GridFieldOptions options;
        options.tension = 100.0;  // screens the faces
        const Index a = size.index({18 + shift, 20, 20}), b = size.index({20 + shift, 20, 20});
        return solved_field(size, {{a, Vec3::UnitZ()}, {b, -Vec3::UnitZ()}}, options);
    };
    const Field here = dipole(0), there = dipole(1);
    for (Index x = 14; x < 25; ++x) {
        const Vec3& a = here[size.index({x, 21, 19})];
        CHECK((a - there[size.index({x + 1, 21, 19})]).norm() < 2e-3);
    }
}

TEST_CASE("grid field: zero flux is the field of the box mirrored at a face") {
    std::mt19937 random(16);
    const GridSize size{6, 7, 5}, both{12, 7, 5};
    const auto constraints = test::random_constraints(size, 30, random);
    std::vector<GridConstraint> doubled;
    for (const GridConstraint& c : constraints) {
        const GridPoint p = size.point(c.point);
        doubled.push_back({both.index(p), c.value, c.weight});
        doubled.push_back({both.index({11 - p.x, p.y, p.z}), c.value, c.weight});
    }
    const Field half = solved_field(size, constraints), whole = solved_field(both, doubled);
    double worst = 0.0;
    for (Index i = 0; i < size.count(); ++i) {
        worst = std::max(worst, (half[i] - whole[both.index(size.point(i))]).norm());
    }
    CHECK(worst < 1e-9);
}

TEST_CASE("grid field: constants and limits carry over, tension takes away overshoot") {
    const GridSize size{16, 16, 16};
    std::mt19937 random(17);
    const auto curve = test::random_curve(size, 25, random);
    const auto greatest = [&](double tension) {
        GridFieldOptions options;
        options.tension = tension;
        double most = 0.0;
        for (const Vec3& v : solved_field(size, curve, options)) most = std::max(most, v.norm());
        return most;
    };
    CHECK(greatest(0.5) < greatest(0.0));
    CHECK(greatest(50.0) < 1.01);
}

TEST_CASE("grid field: dense and iterative dual agree on a larger grid") {
    std::mt19937 random(18);
    const GridSize size{31, 24, 28};
    for (const double tension : {0.0, 0.03}) {
        GridFieldOptions one = dense(), other = iterative();
        one.tension = other.tension = tension;
        other.tolerance = 1e-10;
        GridField a(size, one), b(size, other);
        for (ConstraintOwner owner = 0; owner < 6; ++owner) {
            const auto curve = test::random_curve(size, 60, random);
            a.set_constraints(owner, curve);
            b.set_constraints(owner, curve);
        }
        CHECK(max_difference(solved_field(a), solved_field(b)) < 1e-8);
    }
}

TEST_CASE("grid field: threads change no bit") {
    std::mt19937 random(19);
    const GridSize size{23, 17, 20};
    const auto constraints = test::random_constraints(size, 300, random);
    GridFieldOptions loose = iterative();
    loose.tolerance = 1e-7;
    for (const GridFieldOptions& options : {dense(), loose, thesis(), cholesky_solve()}) {
        const Field one = solved_field(size, constraints, options);
        const Field two = solved_field(size, constraints, options, two_threads());
        CHECK(max_difference(one, two) == 0.0);
    }
}

TEST_CASE("grid field: quads hold the field and keep their fourth number") {
    std::mt19937 random(20);
    const GridSize size{8, 9, 7};
    const auto constraints = test::random_constraints(size, 40, random);
    for (const GridFieldOptions& options : {dense(), thesis(), cholesky_solve()}) {
        GridField field(size, options);
        field.set_constraints(3, constraints);
        const Field vectors = solved_field(field);
        std::vector<float> quads(4 * vectors.size(), -5.0F);
        field.evaluate(std::span<float>(quads));
        for (std::size_t i = 0; i < vectors.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                CHECK(std::abs(quads[4 * i + c] - vectors[i][c]) < 1e-6);
            }
            CHECK(quads[4 * i + 3] == -5.0F);
        }
    }
}

TEST_CASE("grid field: bad sizes and options are refused") {
    const auto code = [](const GridSize& size, const GridFieldOptions& options) {
        return test::error_of([&] { GridField(size, options); }).code();
    };
    CHECK(code({0, 3, 3}, {}) == ErrorCode::invalid_argument);
    GridFieldOptions options;
    options.tension = -1.0;
    CHECK(code({3, 3, 3}, options) == ErrorCode::invalid_argument);
    options.tension = std::numeric_limits<double>::quiet_NaN();
    CHECK(code({3, 3, 3}, options) == ErrorCode::invalid_argument);
    options = {};
    options.tolerance = 0.0;
    CHECK(code({3, 3, 3}, options) == ErrorCode::invalid_argument);
    options = {};
    options.refinements = -1;
    CHECK(code({3, 3, 3}, options) == ErrorCode::invalid_argument);
    GridField field({3, 3, 3});
    std::vector<float> small(50);
    CHECK(test::error_of([&] { field.evaluate(std::span<float>(small)); }).code() ==
          ErrorCode::invalid_argument);
}

TEST_CASE("grid field: memory is charged as predicted, and a limit is kept") {
    const GridSize size{30, 30, 30};
    std::mt19937 random(21);
    const auto constraints = test::random_constraints(size, 700, random);
    GridFieldOptions exact = thesis(), many = iterative();
    exact.tolerance = many.tolerance = 1e-4;
    for (const GridFieldOptions& options : {dense(), many, exact}) {
        ContextOptions host;
        host.memory_limit = GridField::predicted_bytes(size, 700, options);
        const Context context(host);
        CHECK_NOTHROW(solved_field(size, constraints, options, context));
        CHECK(context.memory()->peak() > host.memory_limit / 2);
        CHECK(context.memory()->used() == 0);
        host.memory_limit /= 2;
        CHECK(test::error_of([&] {
                  solved_field(size, constraints, options, Context(host));
              }).code() == ErrorCode::memory_limit);
    }
}
