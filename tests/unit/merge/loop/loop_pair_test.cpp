#include "kernel/merge/loop/loop_pair.h"

#include <doctest/doctest.h>

#include <array>

#include "kernel/core/error.h"

using namespace lissom;

TEST_CASE("a place on a loop: at its points to the bit, and past the last one back to the first") {
    const std::array<Vec3, 3> loop{Vec3{0, 0, 0}, Vec3{0.1, 0, 0}, Vec3{0, 0.3, 0}};
    CHECK(point_of(loop, {1, 0.0}) == loop[1]);
    CHECK((point_of(loop, {2, 0.5}) - Vec3(0, 0.15, 0)).norm() < 1e-15);
    CHECK_THROWS_AS(point_of(loop, {3, 0.0}), Error);
}
