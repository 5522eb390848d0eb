#include "kernel/core/geometry.h"

#include <cmath>
#include <limits>

#include "kernel/core/rotation.h"
#include "tests/unit/support.h"

using namespace lissom;

TEST_CASE("a box grows by points and a new one is empty") {
    Box box;
    CHECK(box.empty());
    CHECK(box.diagonal() == 0.0);
    box.extend(Vec3(1, 2, 3));
    CHECK(!box.empty());
    CHECK(box.contains(Vec3(1, 2, 3)));
    box.extend(Vec3(-1, 2, 5));
    CHECK(box.center() == Vec3(0, 2, 4));
    CHECK(box.contains(Vec3(0, 2, 4)));
    CHECK(!box.contains(Vec3(0, 2.1, 4)));
    CHECK(box.diagonal() == doctest::Approx(std::sqrt(8.0)));
}

TEST_CASE("affine maps compose from right to left") {
    const Affine turn = rotation(Vec3(0, 0, 2), kPi / 2, Vec3(1, 0, 0));
    const Affine move = translation(Vec3(0, 0, 3));
    const Vec3 p(2, 0, 0);
    CHECK(((move * turn)(p)-Vec3(1, 1, 3)).norm() < 1e-15);
    CHECK((move * turn)(p) == move(turn(p)));
    CHECK(Affine().is_identity());
    CHECK(!move.is_identity());
}

TEST_CASE("a rotation keeps its center and lengths") {
    const Vec3 about(1, -2, 3);
    const Affine turn = rotation(Vec3(1, 1, 1), 1.234, about);
    CHECK((turn(about) - about).norm() < 1e-15);
    CHECK((turn.linear * turn.linear.transpose() - Mat3::Identity()).norm() < 1e-14);
}

TEST_CASE("scaling keeps its center") {
    const Affine map = scaling(Vec3(2, 3, 4), Vec3(1, 1, 1));
    CHECK(map(Vec3(1, 1, 1)) == Vec3(1, 1, 1));
    CHECK(map(Vec3(2, 2, 2)) == Vec3(3, 4, 5));
}

TEST_CASE("a rotation without axis or angle is refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(test::error_of([] { rotation(Vec3::Zero(), 1.0, Vec3::Zero()); }).code() ==
          ErrorCode::invalid_argument);
    CHECK(test::error_of([&] { rotation(Vec3(nan, 0, 1), 1.0, Vec3::Zero()); }).code() ==
          ErrorCode::invalid_argument);
    CHECK(test::error_of([&] { rotation(Vec3(0, 0, 1), nan, Vec3::Zero()); }).code() ==
          ErrorCode::invalid_argument);
}

TEST_CASE(
    "the least rotation between directions turns one to the other about an axis square to both") {
    const Vec3 from(0.3, -2.0, 0.7);
    const Vec3 axis = from.unitOrthogonal();
    for (int degrees = 0; degrees <= 180; ++degrees) {
        CAPTURE(degrees);
        const Vec3 to = 5.0 * rotation(axis, degrees * kDegree, Vec3::Zero())(from);
        const Eigen::Quaterniond turn = min_rotation(from, to);
        CHECK((turn * from.normalized() - to.normalized()).norm() < 1e-14);
        CHECK(std::abs(turn.norm() - 1.0) < 1e-14);
        CHECK(std::abs(turn.vec().dot(from)) < 1e-14);
    }
    // Close to opposite directions the axis is still square to the first, and the turn still exact.
    for (double off = 1e-3; off > 1e-18; off *= 0.1) {
        CAPTURE(off);
        const Vec3 to = -from.normalized() + off * axis;
        const Eigen::Quaterniond turn = min_rotation(from, to);
        CHECK((turn * from.normalized() - to.normalized()).norm() < 1e-7);
        CHECK(std::abs(turn.norm() - 1.0) < 1e-7);
    }
}
