// Curves with frames, and bones and handles along them.
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/deform/bones/bone_chain.h"
#include "kernel/deform/bones/bones.h"
#include "kernel/deform/bones/framed_curve.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

namespace lissom::test {
namespace {

std::vector<Vec3> helix(int count) {
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        const double t = 4.0 * i / (count - 1);
        points.emplace_back(std::cos(t), 0.5 * t, std::sin(t));
    }
    return points;
}

// An arm of four bones along y, the lowest part pinned.
struct Limb {
    Mesh mesh = make_bar({.across = 4, .along = 40});
    Deformer deformer{mesh};
    Bones bones;

    explicit Limb(double radius = 0.0) {
        deformer.pin(mesh.region("bottom"));
        bones = add_bones(deformer, mesh,
                          {.joints = {{0, -2, 0}, {0, -1, 0}, {0, 0, 0}, {0, 1, 0}, {0, 2, 0}},
                           .radius = radius});
    }
};

}  // namespace

TEST_CASE("framed curve: it goes through its points, by arc length") {
    const std::vector<Vec3> points = helix(9);
    const FramedCurve curve(points);
    // A helix of radius 1 that rises by half of its angle.
    CHECK(curve.length() == doctest::Approx(4.0 * std::sqrt(1.25)).epsilon(0.01));
    for (const Vec3& p : points) CHECK((curve.at(curve.nearest(p)).point - p).norm() < 1e-9);
    CHECK((curve.at(0.0).point - points.front()).norm() == 0.0);
    const CurveFrame beyond = curve.at(curve.length() + 2.0);
    CHECK((beyond.point - points.back() - 2.0 * beyond.direction).norm() < 1e-12);
    const CurveFrame before = curve.at(-1.0);
    CHECK((before.point - points.front() + before.direction).norm() < 1e-12);
    for (double s = 0.0; s < curve.length(); s += 0.05) {
        const double step = (curve.at(s + 1e-4).point - curve.at(s).point).norm();
        CHECK(step == doctest::Approx(1e-4).epsilon(1e-3));
    }
}

TEST_CASE("framed curve: frames carry the tangent, and do not turn about it") {
    const FramedCurve curve(helix(9));
    const Vec3 first = curve.at(0.0).direction;
    for (double s = 0.0; s < curve.length(); s += 0.05) {
        const CurveFrame a = curve.at(s), b = curve.at(s + 1e-3);
        CHECK((a.turn * first - a.direction).norm() < 1e-9);
        const Eigen::AngleAxisd step(b.turn * a.turn.conjugate());
        CHECK(std::abs(step.angle() * step.axis().dot(a.direction)) < 2e-6);
    }
    // In a plane they turn about its normal alone.
    const FramedCurve flat(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {2, 2, 0}});
    CHECK((flat.at(flat.length()).turn * Vec3::UnitZ() - Vec3::UnitZ()).norm() < 1e-9);
}

TEST_CASE("framed curve: it leaves a ball where it is so far for the first time") {
    const FramedCurve curve(helix(12));
    for (const double distance : {0.1, 0.7, 1.9, 5.0}) {
        const double along = curve.leave(curve.at(0.4).point, distance, 0.4);
        CHECK((curve.at(along).point - curve.at(0.4).point).norm() ==
              doctest::Approx(distance).epsilon(1e-9));
    }
    CHECK(error_of([&] {
              curve.leave({0, 0, 0}, 0.0, 0.0);
          }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([] {
              FramedCurve(std::vector<Vec3>{{1, 2, 3}, {1, 2, 3}});
          }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([] {
              FramedCurve(std::vector<Vec3>{{1, 2, 3}, {NAN, 2, 3}});
          }).code() == ErrorCode::not_finite);
}

TEST_CASE("bones along a curve: joints lie on it, lengths stay, and nothing twists") {
    const FramedCurve curve(std::vector<Vec3>{{0, 0, 0}, {0.5, 1.5, 0}, {2, 2, 0.5}, {3, 3, 0}});
    BoneChain chain({{0, 0, 0}, {0, 1, 0}, {0, 1.8, 0}, {0, 2.5, 0}});
    chain.follow(curve);
    const std::vector<Vec3> joints = chain.joints();
    for (std::size_t i = 0; i < joints.size(); ++i) {
        CHECK((curve.at(curve.nearest(joints[i])).point - joints[i]).norm() < 1e-9);
        if (i > 0) {
            CHECK((joints[i] - joints[i - 1]).norm() ==
                  doctest::Approx((chain.rest()[i] - chain.rest()[i - 1]).norm()));
        }
    }
    // Each bone turns from the one before about an axis square to both.
    for (Index i = 1; i < chain.size(); ++i) {
        const Eigen::AngleAxisd bend(chain.rotation(i) * chain.rotation(i - 1).conjugate());
        const Vec3 bone = joints[at(i)] - joints[at(i - 1)];
        CHECK(std::abs(bend.axis().dot(bone.normalized()) * bend.angle()) < 1e-9);
    }
    BoneChain twisted = chain;
    twisted.follow(curve, 1.2);
    for (std::size_t i = 0; i < joints.size(); ++i) {
        CHECK((twisted.joints()[i] - joints[i]).norm() < 1e-9);
    }
    CHECK(twisted.rotation(2).angularDistance(chain.rotation(2)) ==
          doctest::Approx(1.2 * 2.5 / 3.0));
}

TEST_CASE("bones along a curve that is too short go on straight, and limits hold") {
    BoneChain chain({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}}, {kPi, 0.3, 0.3});
    chain.follow(FramedCurve(std::vector<Vec3>{{1, 1, 0}, {1.5, 1, 0}}));
    CHECK((chain.joints().back() - Vec3(4, 1, 0)).norm() < 1e-9);
    chain.follow(FramedCurve(helix(9)));
    for (Index i = 1; i < chain.size(); ++i) {
        CHECK(chain.rotation(i).angularDistance(chain.rotation(i - 1)) <= 0.3 + 1e-9);
    }
    CHECK((chain.joints().front() - helix(9).front()).norm() < 1e-12);
}

TEST_CASE("bones along their own line are at rest, and move with the curve") {
    Limb limb;
    const std::vector<Vec3> line = {{0, -2, 0}, {0, 0, 0}, {0, 2, 0}};
    for (const bool stretch : {false, true}) {
        follow(limb.deformer, limb.bones, FramedCurve(line), {.stretch = stretch});
        for (const HandleId handle : limb.bones.handles) {
            const Affine& map = limb.deformer.pose(handle).transform;
            CHECK((map.linear - Mat3::Identity()).norm() < 1e-9);
            CHECK(map.translation.norm() < 1e-9);
        }
    }
    // The same motion of the curve moves bones alike.
    const Affine motion = rotation(Vec3(1, 2, 0.5), 0.9, Vec3(0.3, 0, 0));
    std::vector<Vec3> bent = {{0, -2, 0}, {0.4, 0, 0}, {1.2, 1, 0.2}}, moved;
    for (const Vec3& p : bent) moved.push_back(motion(p));
    follow(limb.deformer, limb.bones, FramedCurve(bent));
    const std::vector<Vec3> joints = joints_of(limb.deformer, limb.bones);
    follow(limb.deformer, limb.bones, FramedCurve(moved));
    for (std::size_t i = 0; i < joints.size(); ++i) {
        CHECK((joints_of(limb.deformer, limb.bones)[i] - motion(joints[i])).norm() < 1e-9);
    }
}

TEST_CASE("a stretched chain spans the curve, and its bones find back") {
    Limb limb;
    const FramedCurve curve(std::vector<Vec3>{{0, -2, 0}, {1, 0, 0}, {3, 2, 0}, {4, 2, 0}});
    follow(limb.deformer, limb.bones, curve, {.stretch = true, .twist = 0.5});
    const std::vector<Vec3> joints = joints_of(limb.deformer, limb.bones);
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const double share = static_cast<double>(i) / 4.0;
        CHECK((joints[i] - curve.at(share * curve.length()).point).norm() < 1e-9);
    }
    CHECK(!limb.deformer.solve().empty());
    // Without the stretch it is a chain of the same directions.
    const BoneChain chain = chain_of(limb.deformer, limb.bones);
    for (Index i = 0; i < chain.size(); ++i) {
        const Vec3 bone = chain.joints()[at(i + 1)] - chain.joints()[at(i)];
        CHECK(bone.norm() == doctest::Approx(1.0));
        CHECK(bone.normalized().dot((joints[at(i + 1)] - joints[at(i)]).normalized()) > 1 - 1e-9);
    }
    const auto turning_back = [&] {
        follow(limb.deformer, limb.bones, FramedCurve(std::vector<Vec3>{{0, 0, 0}, {NAN, 0, 0}}),
               {.stretch = true});
    };
    CHECK(error_of(turning_back).code() == ErrorCode::not_finite);
    CHECK(joints_of(limb.deformer, limb.bones) == joints);
}

TEST_CASE("bones of a line on the surface hold what is near them") {
    Limb limb;
    const auto regions = bone_regions(
        limb.mesh, Region::all(limb.mesh.shared_topology()),
        {.joints = {{-0.5, -1, 0.5}, {0.5, -1, 0.5}, {0.5, 1, 0.5}}, .share = 1.0, .radius = 0.3});
    REQUIRE(regions.size() == 2);
    for (const Index v : regions[0].vertices()) {
        const Vec3& p = limb.mesh.position(v);
        CHECK(p.z() > 0.19);
        CHECK(std::abs(p.y() + 1.0) <= 0.3);
    }
    const auto far = [&] {
        bone_regions(limb.mesh, Region::all(limb.mesh.shared_topology()),
                     {.joints = {{5, 0, 0}, {6, 0, 0}}, .radius = 0.3});
    };
    CHECK(error_of(far).code() == ErrorCode::invalid_argument);
    const auto negative = [&] {
        bone_regions(limb.mesh, Region::all(limb.mesh.shared_topology()),
                     {.joints = {{0, 0, 0}, {0, 1, 0}}, .radius = -1.0});
    };
    CHECK(error_of(negative).code() == ErrorCode::invalid_argument);
}

TEST_CASE("a handle is carried along a curve as a body") {
    Mesh mesh = make_bar({.across = 4, .along = 20});
    Deformer deformer(mesh);
    deformer.pin(mesh.region("bottom"));
    const HandleId top = deformer.add_handle(mesh.region("top"));
    const FramedCurve curve(std::vector<Vec3>{{0, 2.5, 0}, {0.5, 3, 0}, {1.5, 3, 0}});
    follow(deformer, top, curve, {});
    CHECK((deformer.pose(top).transform.linear - Mat3::Identity()).norm() < 1e-12);
    follow(deformer, top, curve, {.along = curve.length()});
    const CurveFrame end = curve.at(curve.length());
    const Affine& map = deformer.pose(top).transform;
    CHECK((map(Vec3(0, 2.5, 0)) - end.point).norm() < 1e-9);
    CHECK((map.linear * curve.at(0.0).direction - end.direction).norm() < 1e-9);
    CHECK((map.linear * Vec3::UnitZ() - Vec3::UnitZ()).norm() < 1e-9);
    follow(deformer, top, curve, {.along = curve.length(), .twist = 0.4});
    CHECK((deformer.pose(top).transform.linear * curve.at(0.0).direction - end.direction).norm() <
          1e-9);
    CHECK(error_of([&] { follow(deformer, top, curve, {.along = NAN}); }).code() ==
          ErrorCode::not_finite);
}

}  // namespace lissom::test
