// Poses of a deformer as values.
#include "kernel/deform/poses/deform_pose.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/deform/deformer.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

struct PosedBar {
    Mesh mesh = make_bar({.across = 2, .along = 12});
    Deformer deformer{mesh};
    HandleId top;

    PosedBar() {
        deformer.pin(mesh.region("bottom"));
        top = deformer.add_handle(mesh.region("top"));
    }

    DeformPose turned(double degrees) {
        deformer.reset();
        for (double done = 0.0; done < degrees; done += 45.0) {
            deformer.rotate(top, Vec3::UnitZ(), std::min(45.0, degrees - done) * kDegree);
        }
        return pose_of(deformer);
    }
};

ErrorCode blend_error(auto&& work) {
    try {
        work();
    } catch (const Error& e) {
        return e.code();
    }
    return ErrorCode::internal;
}

}  // namespace

TEST_CASE("deform pose: a pose comes back to the bit") {
    PosedBar bar;
    const DeformPose bent = bar.turned(90.0);
    const std::vector<Vec3> expected = bar.deformer.solve();
    bar.deformer.translate(bar.top, {1.0, 2.0, 3.0});
    bar.deformer.solve();
    set_pose(bar.deformer, bent);
    CHECK(bar.deformer.solve() == expected);
    CHECK(pose_of(bar.deformer).poses == bent.poses);
}

TEST_CASE("deform pose: blends turn by the turns that the handles made, full ones too") {
    PosedBar bar;
    const DeformPose rest = bar.turned(0.0), wound = bar.turned(450.0);
    CHECK(blended(rest, wound, 0.0).poses == rest.poses);
    CHECK(blended(rest, wound, 1.0).poses == wound.poses);
    for (const double t : {0.25, 0.5, 0.9, 1.2}) {
        CAPTURE(t);
        set_pose(bar.deformer, blended(rest, wound, t));
        const HandlePose& pose = bar.deformer.pose(bar.top);
        CHECK(pose.turn.z() == doctest::Approx(450.0 * t * kDegree));
        const Affine expected =
            rotation(Vec3::UnitZ(), 450.0 * t * kDegree, bar.deformer.handle(bar.top).center);
        CHECK((pose.transform.linear - expected.linear).norm() < 1e-9);
        CHECK((pose.transform.translation - expected.translation).norm() < 1e-9);
    }
}

TEST_CASE("deform pose: handles added since stay, removed ones are passed over") {
    PosedBar bar;
    const DeformPose bent = bar.turned(90.0);
    const HandleId side = bar.deformer.add_handle(Region(bar.mesh.shared_topology(), {20}));
    bar.deformer.translate(side, {0.5, 0.0, 0.0});
    bar.deformer.remove_handle(bar.top);
    set_pose(bar.deformer, bent);
    CHECK(bar.deformer.pose(side).transform.translation.x() == 0.5);
    CHECK(bar.deformer.handles().size() == 2);
}

TEST_CASE("deform pose: keys are met, held beyond, and eased between") {
    PosedBar bar;
    const std::vector<PoseKey> keys{
        {1.0, bar.turned(0.0)}, {2.0, bar.turned(80.0)}, {4.0, bar.turned(40.0)}};
    const auto degrees = [&](double time, Easing easing) {
        set_pose(bar.deformer, pose_at(keys, time, easing));
        return bar.deformer.pose(bar.top).turn.z() / kDegree;
    };
    for (const Easing easing :
         {Easing::linear, Easing::smooth, Easing::slow_in, Easing::slow_out, Easing::step}) {
        CHECK(degrees(0.0, easing) == 0.0);
        CHECK(degrees(2.0, easing) == doctest::Approx(80.0));
        CHECK(degrees(9.0, easing) == doctest::Approx(40.0));
    }
    CHECK(degrees(1.25, Easing::linear) == doctest::Approx(20.0));
    CHECK(degrees(3.0, Easing::linear) == doctest::Approx(60.0));
    CHECK(degrees(1.25, Easing::smooth) == doctest::Approx(80.0 * 0.15625));
    CHECK(degrees(1.25, Easing::slow_in) == doctest::Approx(5.0));
    CHECK(degrees(1.25, Easing::slow_out) == doctest::Approx(35.0));
    CHECK(degrees(1.99, Easing::step) == 0.0);
}

TEST_CASE("deform pose: poses of other deformers and bad numbers are refused, and nothing moves") {
    PosedBar bar, other;
    const DeformPose bent = bar.turned(90.0), foreign = other.turned(90.0);
    CHECK(blend_error([&] { set_pose(bar.deformer, foreign); }) == ErrorCode::invalid_argument);
    CHECK(blend_error([&] { blended(bent, foreign, 0.5); }) == ErrorCode::invalid_argument);
    CHECK(blend_error([&] { blended(bent, bent, kNone); }) == ErrorCode::not_finite);
    CHECK(blend_error([&] { blended(DeformPose(), DeformPose(), 0.5); }) ==
          ErrorCode::invalid_argument);
    CHECK(blend_error([&] { pose_at({}, 0.0); }) == ErrorCode::invalid_argument);
    const std::vector<PoseKey> twice{{1.0, bent}, {1.0, bent}};
    CHECK(blend_error([&] { pose_at(twice, 0.0); }) == ErrorCode::invalid_argument);
    bar.deformer.set_transform(bar.top, scaling(Vec3(-1.0, 1.0, 1.0), Vec3::Zero()));
    const DeformPose mirrored = pose_of(bar.deformer);
    CHECK(blend_error([&] { blended(bar.turned(0.0), mirrored, 0.5); }) ==
          ErrorCode::singular_transform);
    CHECK(pose_of(bar.deformer).poses == bar.turned(0.0).poses);
    bar.deformer.solve();
    bar.deformer.rebase();
    CHECK(blend_error([&] { set_pose(bar.deformer, bent); }) == ErrorCode::invalid_argument);
}
