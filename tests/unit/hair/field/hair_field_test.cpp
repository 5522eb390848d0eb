#include "kernel/hair/field/hair_field.h"

#include <cmath>

#include "tests/unit/hair/curve/curve_scenes.h"

using namespace lissom;
using namespace lissom::test;
using doctest::Approx;

TEST_CASE("hair field: distances and their gradients are those of its grid") {
    const Mesh mesh = make_sphere({.radius = kBallRadius, .segments = 24});
    const HairField field(DistanceGrid(mesh, ball().layout()));
    const GridLayout& grid = field.layout();
    for (const Vec3& cell : {Vec3(4, 5, 6), Vec3(15, 14, 13), Vec3(20, 3, 27)}) {
        const auto corner = [&](Index x, Index y, Index z) {
            return ball().at(index_of(std::lround(cell.x())) + x,
                             index_of(std::lround(cell.y())) + y,
                             index_of(std::lround(cell.z())) + z);
        };
        const auto at = [&](const Vec3& inside) {
            return field.sample(grid.origin + grid.step * (cell + inside));
        };
        CHECK(at(Vec3::Zero()).distance == Approx(corner(0, 0, 0)));
        CHECK(at({0.25, 0.0, 0.0}).distance ==
              Approx(0.75 * corner(0, 0, 0) + 0.25 * corner(1, 0, 0)));
        CHECK(at({0.0, 0.25, 0.0}).distance ==
              Approx(0.75 * corner(0, 0, 0) + 0.25 * corner(0, 1, 0)));
        const HairField::Sample middle = at(Vec3::Constant(0.5));
        double sum = 0.0;
        for (int k = 0; k < 8; ++k) sum += corner(k & 1, (k >> 1) & 1, k >> 2);
        CHECK(middle.distance == Approx(sum / 8.0));
        // Against differences within the cell.
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3 step = 0.25 * Vec3::Unit(axis);
            const double rise =
                at(Vec3::Constant(0.5) + step).distance - at(Vec3::Constant(0.5) - step).distance;
            CHECK(middle.gradient[axis] == Approx(rise / (0.5 * grid.step)));
        }
    }
}
