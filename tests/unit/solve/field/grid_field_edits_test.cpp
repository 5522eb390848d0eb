#include <random>
#include <vector>

#include "kernel/solve/field/grid_field.h"
#include "tests/unit/solve/grid/grids.h"
#include "tests/unit/support.h"

using namespace lissom;
using test::Field;
using test::max_difference;
using test::solved_field;

namespace {

const GridSize kSize{11, 9, 10};

using Curves = std::vector<std::vector<GridConstraint>>;

Curves random_curves(int count, std::mt19937& random) {
    Curves curves;
    for (int i = 0; i < count; ++i) curves.push_back(test::random_curve(kSize, 20, random));
    return curves;
}

GridFieldOptions iterative_edits() {
    GridFieldOptions options;
    options.dense_limit = 0;
    options.tolerance = 1e-12;
    return options;
}

GridFieldOptions cholesky_edits() {
    GridFieldOptions options;
    options.solver = GridSolver::cholesky;
    options.refinements = 1;
    return options;
}

Field field_of(const Curves& curves, const GridFieldOptions& options) {
    GridField field(kSize, options);
    for (std::size_t i = 0; i < curves.size(); ++i) {
        field.set_constraints(static_cast<ConstraintOwner>(i), curves[i]);
    }
    return solved_field(field);
}

// Moves, adds to, thins out or removes one curve, or turns its vectors alone.
void edit(std::vector<GridConstraint>& curve, std::mt19937& random) {
    switch (std::uniform_int_distribution<int>(0, 4)(random)) {
        case 0:
            curve = test::random_curve(kSize, 20, random);
            break;
        case 1:
            for (GridConstraint& c : curve) c.value = test::random_vector(random);
            break;
        case 2:
            curve.resize(curve.size() / 2);
            break;
        case 3:
            for (GridConstraint& c : curve) c.weight = c.weight == 100.0 ? 30.0 : 100.0;
            break;
        default:
            curve = test::random_curve(kSize, 45, random);
    }
}

}  // namespace

TEST_CASE("grid field edits: the order of edits does not matter, nor what was in between") {
    std::mt19937 random(31);
    const Curves curves = random_curves(5, random);
    for (const GridFieldOptions& options :
         {GridFieldOptions{}, iterative_edits(), cholesky_edits()}) {
        const Field direct = field_of(curves, options);
        GridField field(kSize, options);
        for (const int owner : {3, 0, 4}) {
            field.set_constraints(owner, test::random_curve(kSize, 30, random));
            field.solve();
        }
        for (const int owner : {4, 1, 3, 2, 0}) {
            field.set_constraints(owner, curves[owner]);
            field.solve();
        }
        CHECK(max_difference(solved_field(field), direct) < 1e-9);
    }
}

TEST_CASE("grid field edits: removing an owner returns to before") {
    std::mt19937 random(32);
    const Curves curves = random_curves(3, random);
    for (const GridFieldOptions& options :
         {GridFieldOptions{}, iterative_edits(), cholesky_edits()}) {
        GridField field(kSize, options);
        field.set_constraints(0, curves[0]);
        field.set_constraints(1, curves[1]);
        const Field before = solved_field(field);
        field.set_constraints(2, curves[2]);
        CHECK(max_difference(solved_field(field), before) > 1e-2);
        field.set_constraints(2, {});
        CHECK(max_difference(solved_field(field), before) < 1e-9);
        field.clear();
        CHECK(max_difference(solved_field(field), Field(before.size(), Vec3::Zero())) == 0.0);
        field.set_constraints(0, curves[0]);
        field.set_constraints(1, curves[1]);
        CHECK(max_difference(solved_field(field), before) < 1e-9);
    }
}

TEST_CASE("grid field edits: after 200 random edits the dual and cholesky solvers agree to 1e-8") {
    std::mt19937 random(33);
    for (const GridBoundary boundary : {GridBoundary::zero_flux, GridBoundary::thesis}) {
        GridFieldOptions dual, factored = cholesky_edits();
        dual.boundary = factored.boundary = boundary;
        dual.refinements = 1;
        dual.tolerance = 1e-11;
        GridField a(kSize, dual), b(kSize, factored);
        Curves curves = random_curves(6, random);
        for (std::size_t i = 0; i < curves.size(); ++i) {
            a.set_constraints(static_cast<ConstraintOwner>(i), curves[i]);
            b.set_constraints(static_cast<ConstraintOwner>(i), curves[i]);
        }
        double worst = max_difference(solved_field(a), solved_field(b));
        for (int step = 0; step < 200; ++step) {
            const auto owner = std::uniform_int_distribution<std::size_t>(0, 5)(random);
            edit(curves[owner], random);
            a.set_constraints(static_cast<ConstraintOwner>(owner), curves[owner]);
            b.set_constraints(static_cast<ConstraintOwner>(owner), curves[owner]);
            worst = std::max(worst, max_difference(solved_field(a), solved_field(b)));
        }
        MESSAGE("greatest difference " << worst);
        CHECK(worst < 1e-8);
    }
}

TEST_CASE("grid field edits: the dual system grows past the dense limit and comes back") {
    std::mt19937 random(34);
    const Curves curves = random_curves(4, random);
    GridFieldOptions options;
    options.dense_limit = 40;
    options.tolerance = 1e-12;
    GridField field(kSize, options);
    Curves soFar;
    for (const auto& curve : curves) {
        soFar.push_back(curve);
        field.set_constraints(static_cast<ConstraintOwner>(soFar.size()) - 1, curve);
        CHECK(max_difference(solved_field(field), field_of(soFar, {})) < 1e-9);
    }
    field.set_constraints(3, {});
    field.set_constraints(2, {});
    field.set_constraints(1, {});
    CHECK(max_difference(solved_field(field), field_of({curves[0]}, {})) < 1e-9);
}

TEST_CASE("grid field edits: a cancelled solve leaves the field of the last one") {
    std::mt19937 random(35);
    const Curves curves = random_curves(3, random);
    GridFieldOptions thesis;
    thesis.boundary = GridBoundary::thesis;
    thesis.tolerance = 1e-11;
    for (const GridFieldOptions& options :
         {GridFieldOptions{}, iterative_edits(), thesis, cholesky_edits()}) {
        for (int stop = 1; stop < 40; stop += 3) {
            GridField field(kSize, options);
            field.set_constraints(0, curves[0]);
            const Field before = solved_field(field);
            field.set_constraints(0, curves[1]);
            field.set_constraints(1, curves[2]);
            // Cancels when the given number of parallel loops has begun.
            ContextOptions host;
            int loops = 0;
            const Context* own = nullptr;
            host.parallel_for = [&](std::size_t count,
                                    const std::function<void(std::size_t)>& chunk) {
                if (++loops == stop) own->cancel();
                for (std::size_t i = 0; i < count; ++i) chunk(i);
            };
            const Context context(host);
            own = &context;
            bool cancelled = false;
            try {
                field.solve(context);
            } catch (const Error& error) {
                CHECK(error.code() == ErrorCode::cancelled);
                cancelled = true;
            }
            if (!cancelled) break;
            CHECK_FALSE(field.solved());
            Field now(before.size());
            field.evaluate(std::span<Vec3>(now));
            CHECK(max_difference(now, before) == 0.0);
            CHECK(max_difference(solved_field(field), field_of({curves[1], curves[2]}, options)) <
                  1e-9);
        }
    }
}

TEST_CASE("grid field edits: solving again without a change does nothing") {
    GridField field(kSize);
    CHECK(field.solved());
    field.set_constraints(0, {{5, Vec3::UnitX()}});
    CHECK_FALSE(field.solved());
    field.solve();
    CHECK(field.solved());
    const Context context;
    context.cancel();
    CHECK(test::error_of([&] { field.solve(context); }).code() == ErrorCode::cancelled);
    CHECK(field.constraint_count() == 1);
}
