#include "kernel/hair/dynamics/hair_dynamics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/dynamics/body_grid.h"
#include "tests/unit/hair/hair_support.h"
#include "tests/unit/hair/strands/strand_support.h"

namespace lissom::test {
namespace {

constexpr double kFrame = 1.0 / 30.0;

// A straight strand from the origin in a direction.
std::vector<Vec3> straight(const Vec3& from, const Vec3& direction, double length, int points) {
    std::vector<Vec3> list;
    for (int k = 0; k < points; ++k) {
        list.push_back(from + direction * (length * k / (points - 1)));
    }
    return list;
}

// Four strands, `apart` metres from one another, so that no links join them if that is large.
GuideSet level_guides(double length, int points, double apart = 1.0) {
    std::vector<std::vector<Vec3>> lists;
    for (int s = 0; s < 4; ++s) {
        lists.push_back(straight({0.0, 0.0, apart * s}, Vec3::UnitX(), length, points));
    }
    return make_guide_set(strands_of(lists), {.count = 4, .points = points});
}

// Strands that curl around their course, and turn by up to 80 degrees a segment.
GuideSet curly_guides(int count) {
    std::vector<std::vector<Vec3>> lists;
    for (int s = 0; s < count; ++s) {
        std::vector<Vec3> points;
        for (int k = 0; k < 16; ++k) {
            const double a = 1.4 * k + s, r = k == 0 ? 0.0 : 0.012;
            points.push_back({0.03 * s + r * std::cos(a), 0.01 * k, r * std::sin(a)});
        }
        lists.push_back(points);
    }
    return make_guide_set(strands_of(lists), {.count = count, .points = 16});
}

HairDynamics moving(const GuideSet& set, const HairDynamicsOptions& options = {},
                    const HairRigOptions& rig = {}) {
    return HairDynamics(make_hair_rig(set, rig), rig.body, options);
}

void run(HairDynamics& hair, double seconds) {
    for (double t = 0.0; t < seconds; t += kFrame) hair.step(kFrame);
}

double farthest(const HairDynamics& a, const HairDynamics& b) {
    const auto x = a.curves(), y = b.curves();
    float most = 0.0f;
    for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, (x[i] - y[i]).norm());
    return most;
}

BodyDistance ball(double radius, const Vec3& center = Vec3::Zero()) {
    return [=](const Vec3& p) { return (p - center).norm() - radius; };
}

// Strands that stand on a ball of 9 cm, all around its upper half.
GuideSet hair_on_ball(int count) {
    std::vector<std::vector<Vec3>> lists;
    for (int s = 0; s < count; ++s) {
        const double y = (s + 0.5) / count, a = 2.399963 * s, r = std::sqrt(1.0 - y * y);
        const Vec3 out(r * std::cos(a), y, r * std::sin(a));
        lists.push_back(straight(0.0905 * out, out, 0.12, 16));
    }
    return make_guide_set(strands_of(lists), {.count = count, .points = 16});
}

TEST_CASE("hair dynamics: a style that carries its weight stays as it is, to rounding") {
    HairDynamics hair = moving(curly_guides(6), {.hold = 1.0});
    run(hair, 0.5);
    CHECK(hair.motion().max < 1e-7);
    CHECK(hair.motion().time == doctest::Approx(0.5).epsilon(0.1));
}

TEST_CASE("hair dynamics: a level strand as long as its stiffness droops by an eighth of it") {
    // The first segment is held, so the beam is shorter by that. Its end falls by w L^4 / 8 EI.
    for (const double length : {0.05, 0.2}) {
        HairDynamics hair = moving(level_guides(length, 31), {.stiffness = length});
        run(hair, 6.0);
        const double droop = -hair.curves()[30].y();
        const double expected = length / 8.0 * std::pow(29.0 / 30.0, 4);
        CHECK(droop == doctest::Approx(expected).epsilon(0.03));
        CHECK(hair.motion().speed < 1e-3);
    }
}

TEST_CASE("hair dynamics: soft hair hangs from its root, stiff hair does not") {
    HairDynamics soft = moving(level_guides(0.2, 20), {.stiffness = 0.005});
    HairDynamics stiff = moving(level_guides(0.2, 20), {.stiffness = 1.0});
    run(soft, 4.0);
    run(stiff, 4.0);
    CHECK(soft.curves()[19].y() < -0.17);
    CHECK(stiff.curves()[19].y() > -0.002);
}

TEST_CASE("hair dynamics: lengths stay, however hair is thrown about") {
    HairDynamics hair = moving(curly_guides(8), {.wind = {8.0, 0.0, 3.0}, .drag = 8.0});
    for (int i = 0; i < 20; ++i) {
        const double angle = i % 2 == 0 ? 1.2 : -1.2;
        hair.step(kFrame, rotation(Vec3(0.3, 1.0, 0.1), angle, Vec3::Zero()));
        CHECK(hair.motion().stretch < 1e-3);
    }
}

TEST_CASE("hair dynamics: curls come to rest") {
    HairDynamics hair = moving(curly_guides(8));
    run(hair, 4.0);
    CHECK(hair.motion().speed < 0.01);
}

TEST_CASE("hair dynamics: without gravity hair comes back to its shape after a motion") {
    HairDynamics hair = moving(level_guides(0.1, 16), {.gravity = Vec3::Zero(), .drag = 12.0});
    hair.step(0.2, rotation(Vec3::UnitY(), 0.8, Vec3::Zero()));
    CHECK(hair.motion().max > 0.01);
    run(hair, 5.0);
    CHECK(hair.motion().max < 1e-3);
    CHECK(hair.head() == rotation(Vec3::UnitY(), 0.8, Vec3::Zero()));
}

TEST_CASE("hair dynamics: the frame of the world does not matter") {
    const GuideSet set = curly_guides(5);
    const Affine turn = rotation(Vec3(1.0, 2.0, -0.5), 1.1, Vec3::Zero());
    GuideSet turned = set;
    for (Eigen::Vector3f& p : turned.curves) {
        p = turn(p.cast<double>()).cast<float>();
    }
    HairDynamics a = moving(set);
    HairDynamics b = moving(turned, {.gravity = turn(Vec3(0.0, -9.81, 0.0))});
    run(a, 0.3);
    run(b, 0.3);
    double off = 0.0;
    for (std::size_t i = 0; i < set.curves.size(); ++i) {
        off = std::max(off,
                       (turn(a.curves()[i].cast<double>()) - b.curves()[i].cast<double>()).norm());
    }
    CHECK(a.motion().max > 0.005);
    CHECK(off < 1e-4);
}

TEST_CASE("hair dynamics: hair falls onto the body and not into it") {
    HairRigOptions rig;
    rig.body = ball(0.09);
    HairDynamics hair = moving(hair_on_ball(60), {.stiffness = 0.02}, rig);
    CHECK(hair.motion().depth == 0.0);
    run(hair, 2.0);
    CHECK(hair.motion().max > 0.05);
    CHECK(hair.motion().depth < 2e-4);
    CHECK(hair.motion().speed < 0.02);
    for (const Eigen::Vector3f& p : hair.curves()) CHECK(p.norm() > 0.0895f);
}

TEST_CASE("hair dynamics: ties hold the hair in them to the head") {
    HairRigOptions rig;
    rig.ties = {{"middle", {0.1, 0.0, 0.0}, 0.012}};
    const GuideSet set = level_guides(0.2, 21, 0.0004);
    const HairRig made = make_hair_rig(set, rig);
    REQUIRE(made.ties.size() == 1);
    REQUIRE(made.ties[0].points.size() == 12);
    HairDynamics hair(made);
    for (int i = 1; i <= 15; ++i) {
        hair.step(kFrame, rotation(Vec3::UnitY(), 0.05 * i, Vec3::Zero()));
    }
    const auto now = hair.curves();
    for (const Index p : made.ties[0].points) {
        CHECK((now[at(p)] - set.curves[at(p)]).norm() < 1e-6f);
    }
    CHECK(hair.motion().max > 0.01);
}

TEST_CASE("hair dynamics: bound groups stay together, as loose hair does not") {
    std::vector<std::vector<Vec3>> lists;
    for (int s = 0; s < 6; ++s) {
        lists.push_back(straight({0.0, 0.0, 0.004 * s}, Vec3::UnitY(), 0.2, 16));
    }
    Strands strands = strands_of(lists);
    strands.set_groups(std::vector<Index>(6, 0), {"braid"});
    const GuideSet set = make_guide_set(strands, {.count = 6, .points = 16});
    const auto spread = [&](const HairRigOptions& rig, double cohesion) {
        HairDynamics hair(make_hair_rig(set, rig), {},
                          {.wind = {4.0, 0.0, 0.0}, .gusts = 1.0, .cohesion = cohesion});
        double most = 0.0;
        for (int i = 0; i < 60; ++i) {
            hair.step(kFrame);
            const auto now = hair.curves();
            for (std::size_t g = 1; g < 6; ++g) {
                const double off = (now[16 * g + 15] - now[16 * g - 1]).norm() - 0.004;
                most = std::max(most, std::abs(off));
            }
        }
        return most;
    };
    HairRigOptions bound;
    bound.bound = {"braid"};
    const HairRig rig = make_hair_rig(set, bound);
    REQUIRE(!rig.links.empty());
    for (const HairLink& link : rig.links) CHECK(link.bound);
    CHECK(spread(bound, 0.0) < 0.5 * spread({}, 0.0));
}

TEST_CASE("hair dynamics: wind carries hair along, and gusts come and go") {
    HairDynamics calm = moving(level_guides(0.2, 16), {.wind = {0.0, 0.0, 6.0}, .gusts = 0.0});
    HairDynamics gusty = moving(level_guides(0.2, 16), {.wind = {0.0, 0.0, 6.0}, .gusts = 1.0});
    run(calm, 4.0);
    run(gusty, 4.0);
    CHECK(calm.curves()[15].z() > 0.04f);
    CHECK(calm.motion().speed < 5e-3);
    CHECK(gusty.motion().speed > 0.05);
}

TEST_CASE("hair dynamics: the same for any number of threads, and after a reset") {
    HairRigOptions rig;
    rig.body = ball(0.09);
    const GuideSet set = hair_on_ball(40);
    HairDynamics one(make_hair_rig(set, rig), rig.body, {}, threads(1));
    HairDynamics four(make_hair_rig(set, rig), rig.body, {}, threads(4));
    for (int i = 0; i < 10; ++i) {
        one.step(kFrame, threads(1));
        four.step(kFrame, threads(4));
    }
    CHECK(farthest(one, four) == 0.0);
    const auto first = one.curves();
    one.reset();
    CHECK(one.motion().max == 0.0);
    for (int i = 0; i < 10; ++i) one.step(kFrame);
    CHECK(one.curves() == first);
}

TEST_CASE("hair dynamics: after an error the hair is as before") {
    HairDynamics hair = moving(curly_guides(4));
    run(hair, 0.2);
    const auto before = hair.curves();
    const HairMotion then = hair.motion();
    Context cancelled;
    cancelled.cancel();
    CHECK(error_of([&] { hair.step(0.1, cancelled); }).code() == ErrorCode::cancelled);
    CHECK(error_of([&] { hair.step(0.0); }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { hair.step(11.0); }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { hair.step(0.1, scaling(Vec3::Constant(1.1), Vec3::Zero())); }).code() ==
          ErrorCode::invalid_argument);
    CHECK(error_of([&] {
              hair.step(0.1, translation({std::nan(""), 0.0, 0.0}));
          }).code() == ErrorCode::not_finite);
    CHECK(error_of([&] {
              hair.step(0.1, translation({1e15, 0.0, 0.0}));
          }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { hair.set_options({.substeps = 0}); }).code() ==
          ErrorCode::invalid_argument);
    CHECK(hair.curves() == before);
    CHECK(hair.motion().time == then.time);
    CHECK(hair.options().substeps == HairDynamicsOptions().substeps);
}

TEST_CASE("hair dynamics: bad options and rigs are refused") {
    const GuideSet set = curly_guides(4);
    const double inf = std::numeric_limits<double>::infinity();
    for (const HairDynamicsOptions& bad :
         {HairDynamicsOptions{.gravity = {0.0, -2000.0, 0.0}},
          HairDynamicsOptions{.wind = {1e9, 0.0, 0.0}}, HairDynamicsOptions{.gusts = 2.0},
          HairDynamicsOptions{.stiffness = 0.0}, HairDynamicsOptions{.hold = -0.1},
          HairDynamicsOptions{.drag = inf}, HairDynamicsOptions{.cohesion = 1.5},
          HairDynamicsOptions{.friction = -1.0}, HairDynamicsOptions{.clearance = 2.0},
          HairDynamicsOptions{.substeps = 100000}, HairDynamicsOptions{.substeps = 15}}) {
        CHECK(error_of([&] { moving(set, bad); }).code() == ErrorCode::invalid_argument);
    }
    CHECK(error_of([&] {
              moving(set, {.wind = {inf, 0.0, 0.0}});
          }).code() == ErrorCode::not_finite);
    GuideSet tiny = set;
    for (Eigen::Vector3f& p : tiny.curves) p *= 1e-6f;
    CHECK(error_of([&] { moving(tiny); }).code() == ErrorCode::invalid_argument);
    HairRig torn = make_hair_rig(set);
    torn.curves.pop_back();
    CHECK(error_of([&] { HairDynamics hair(torn); }).code() == ErrorCode::invalid_argument);
    HairRig linked = make_hair_rig(set);
    linked.links.push_back({0, 1'000'000, 0.01f, false});
    CHECK(error_of([&] { HairDynamics hair(linked); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("hair dynamics: rig and motion count on the account") {
    const GuideSet set = hair_on_ball(60);
    ContextOptions small;
    small.memory_limit = 10'000;
    CHECK(error_of([&] { make_hair_rig(set, {}, Context(small)); }).code() ==
          ErrorCode::memory_limit);
    const HairRig rig = make_hair_rig(set);
    CHECK(error_of([&] { HairDynamics hair(rig, {}, {}, Context(small)); }).code() ==
          ErrorCode::memory_limit);
}

TEST_CASE("hair rig: lengths, frames and lengths of strands are those of the guides") {
    const GuideSet set = curly_guides(5);
    const HairRig rig = make_hair_rig(set);
    REQUIRE(rig.guide_count() == 5);
    REQUIRE(rig.lengths.size() == 5 * 15);
    for (Index g = 0; g < 5; ++g) {
        const std::size_t first = at(16 * g);
        const Eigen::Vector3f along = rig.curves[first + 1] - rig.curves[first];
        CHECK(rig.lengths[at(15 * g)] == doctest::Approx(along.norm()));
        const Eigen::Vector3f z = rig.root_frames[at(g)] * Eigen::Vector3f::UnitZ();
        CHECK((z - along.normalized()).norm() < 1e-5f);
    }
    const auto points = rebuild_strands(set);
    double length = 0.0;
    for (std::size_t k = 0; k + 1 < 16; ++k) length += (points[k + 1] - points[k]).norm();
    CHECK(rig.strand_lengths[0] == doctest::Approx(length));
}

TEST_CASE("hair rig: links join near points of different guides, bad input is refused") {
    const GuideSet near = level_guides(0.1, 10, 0.005), far = level_guides(0.1, 10, 0.5);
    CHECK(make_hair_rig(far).links.empty());
    const HairRig rig = make_hair_rig(near);
    CHECK(!rig.links.empty());
    for (const HairLink& link : rig.links) {
        CHECK(link.a / 10 != link.b / 10);
        CHECK(link.length <= 0.015f);
        CHECK(link.a % 10 >= 2);
    }
    CHECK(make_hair_rig(near, {.reach = 0.0}).links.empty());
    CHECK(make_hair_rig(near, {.links = 0}).links.empty());
    CHECK_THROWS_AS(make_hair_rig(near, {.bound = {"braid"}}), Error);
    CHECK_THROWS_AS(make_hair_rig(near, {.reach = -1.0}), Error);
    CHECK_THROWS_AS(make_hair_rig(near, {.links = 9}), Error);
    CHECK_THROWS_AS(make_hair_rig(near, {.ties = {{"far", {9.0, 9.0, 9.0}, 0.1}}}), Error);
    CHECK_THROWS_AS(make_hair_rig(near, {.ties = {{"none", Vec3::Zero(), 0.0}}}), Error);
    CHECK_THROWS_AS(make_hair_rig({}), Error);
}

TEST_CASE("body grid: distances near the surface are those of the body") {
    const BodyDistance body = ball(0.09);
    const BodyGrid grid(body, {Vec3::Constant(-0.2), Vec3::Constant(0.2)}, {});
    for (int i = 0; i < 500; ++i) {
        const double y = 1.0 - 2.0 * (i + 0.5) / 500, a = 2.399963 * i, r = std::sqrt(1 - y * y);
        const Vec3 out(r * std::cos(a), y, r * std::sin(a));
        for (const double off : {-0.006, -0.001, 0.0, 0.002, 0.006}) {
            const BodyGrid::Sample found = grid.sample((0.09 + off) * out);
            CHECK(std::abs(found.distance - off) < 2e-4);
            CHECK((found.gradient.normalized() - out).norm() < 0.05);
        }
    }
    CHECK(std::isinf(grid.sample({1.0, 0.0, 0.0}).distance));
    CHECK(std::isinf(BodyGrid().sample(Vec3::Zero()).distance));
}

TEST_CASE("capsules: they lie in the body, and cover a body that is one") {
    const Capsule whole{{-0.05, 0.0, 0.01}, {0.06, 0.02, 0.0}, 0.04};
    const BodyDistance body = [&](const Vec3& p) { return distance_to(whole, p); };
    const Box box{Vec3::Constant(-0.15), Vec3::Constant(0.15)};
    const BodyCapsules found = fit_capsules(body, box);
    CHECK(found.covered >= 0.95);
    CHECK(found.capsules.size() <= 12);
    for (const Capsule& capsule : found.capsules) {
        CHECK(capsule.radius <= 0.042);
        for (const double t : {0.0, 0.3, 0.7, 1.0}) {
            const Vec3 middle = (1.0 - t) * capsule.a + t * capsule.b;
            CHECK(capsule.radius <= 0.0021 - body(middle));
        }
    }
    const BodyCapsules one = fit_capsules(ball(0.09), box, {.count = 1});
    REQUIRE(one.capsules.size() == 1);
    CHECK(one.covered > 0.85);
    CHECK_THROWS_AS(fit_capsules({}, box), Error);
    CHECK_THROWS_AS(fit_capsules(body, box, {.count = 0}), Error);
    CHECK_THROWS_AS(fit_capsules(body, {Vec3::Constant(1.0), Vec3::Constant(2.0)}), Error);
    Context cancelled;
    cancelled.cancel();
    CHECK(error_of([&] { fit_capsules(body, box, {}, cancelled); }).code() == ErrorCode::cancelled);
}

}  // namespace
}  // namespace lissom::test
