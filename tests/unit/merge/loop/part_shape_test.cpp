#include "kernel/merge/loop/part_shape.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "tests/unit/mesh/mesh_support.h"
#include "tests/unit/shapes.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A neck that leans forward, to +x, and carries a head that is wider than deep: y is left.
Vec3 head(double angle, double height) {
    const double r = 1.0 + 1.5 * height * std::sin(kPi * height);
    const double nose = 0.3 * std::sin(kPi * height) * std::exp(-8.0 * (1.0 - std::cos(angle)));
    return {(r + nose) * std::cos(angle) + 1.2 * height * height, 1.2 * r * std::sin(angle),
            4.0 * height};
}

PartShape shape_of(const Mesh& mesh, Index count) {
    std::vector<Index> ids(static_cast<std::size_t>(count));
    std::iota(ids.begin(), ids.end(), 0);
    return part_shape(mesh, Loop(mesh, ids), {});
}

}  // namespace

TEST_CASE("a part's plane of symmetry turns with it") {
    const Mesh rest = tube(64, 40, head);
    Random random(3);
    for (const double scale : {1.0, 1e-3, 500.0}) {
        Mesh moved = rest;
        const Affine map = similarity(random, scale);
        for (Vec3& p : moved.edit_positions()) p = map(p);
        const PartShape shape = shape_of(moved, 64);
        const Vec3 left = map.linear * Vec3::UnitY() / scale;
        CHECK(std::abs(shape.mirror.dot(left)) > 0.999);
        CHECK(shape.asymmetry < 0.02);
    }
}

TEST_CASE("a part with no plane of symmetry, or with many, has none") {
    const Mesh spiral = tube(64, 40, [](double angle, double height) {
        const double turn = angle + 2.5 * height;
        const double r = 1.0 + 0.4 * std::cos(turn) + 0.3 * std::sin(2.0 * turn);
        return Vec3(r * std::cos(angle), r * std::sin(angle), 4.0 * height);
    });
    CHECK(shape_of(spiral, 64).mirror.norm() == 0.0);
    const Mesh round = tube(64, 40, [](double angle, double height) {
        const double r = 1.0 + 0.5 * height;
        return Vec3(r * std::cos(angle), r * std::sin(angle), 5.0 * height);
    });
    CHECK(shape_of(round, 64).mirror.norm() == 0.0);
}
