#include <random>
#include <vector>

#include "kernel/core/build_info.h"
#include "kernel/solve/field/grid_field.h"
#include "tests/unit/solve/grid/grids.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

GridFieldOptions cholesky() {
    GridFieldOptions options;
    options.solver = GridSolver::cholesky;
    return options;
}

bool updates() {
    return build_info().gpl;
}

}  // namespace

TEST_CASE("grid cholesky: few changes update the factor, many make a new one") {
    std::mt19937 random(41);
    const GridSize size{11, 10, 12};
    GridField field(size, cholesky());
    field.set_constraints(0, test::random_constraints(size, 200, random));
    field.solve();
    CHECK(field.cholesky_stats().factorisations == 1);
    CHECK(field.cholesky_stats().updated == 0);
    CHECK(field.cholesky_stats().factor_nonzeros > 0);
    field.set_constraints(1, {{0}, {1, Vec3::UnitY()}});
    field.solve();
    CHECK(field.cholesky_stats().factorisations == (updates() ? 1 : 2));
    field.set_constraints(2, test::random_constraints(size, 600, random));
    field.solve();
    CHECK(field.cholesky_stats().factorisations == (updates() ? 2 : 3));
}

TEST_CASE("grid cholesky: new vectors at the same points change no factor") {
    GridField field({6, 6, 6}, cholesky());
    field.set_constraints(0, {{7, Vec3::UnitX()}, {100, Vec3::UnitY()}});
    field.solve();
    field.set_constraints(0, {{7, Vec3::UnitZ()}, {100, Vec3::UnitY()}});
    field.solve();
    CHECK(field.cholesky_stats().factorisations == 1);
    CHECK(field.cholesky_stats().updated == 0);
}

TEST_CASE("grid cholesky: the dual solver has no such statistics") {
    GridField field({6, 6, 6});
    field.set_constraints(0, {{7, Vec3::UnitX()}});
    field.solve();
    CHECK(field.cholesky_stats().factorisations == 0);
}
