// Bones of deformers through the C interface.
#include <cmath>
#include <vector>

#include "kernel/deform/bones/bone_chain.h"
#include "kernel/deform/bones/bones.h"
#include "kernel/deform/deformer.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/c/host.h"

namespace lissom::test {
namespace {

const double kJoints[] = {0, -1.5, 0, 0, 0.5, 0, 0, 2.5, 0};
const double kLimits[] = {1.0, 0.5};

struct BonedBar {
    explicit BonedBar(const Host& host) : mesh(host.add(own)) {
        lissom_region bottom{};
        const double end[] = {0, -2.4, 0}, down[] = {0, -1, 0};
        REQUIRE(lissom_region_plane(host, mesh, end, down, &bottom) == LISSOM_OK);
        REQUIRE(lissom_deformer_create(host, mesh, {0}, nullptr, &deformer) == LISSOM_OK);
        REQUIRE(lissom_deformer_pin(host, deformer, bottom) == LISSOM_OK);
        const lissom_input joints{kJoints, 3, 0, LISSOM_FLOAT64};
        auto options = lissom_default_bones_options();
        options.limits = {kLimits, 2, 0, LISSOM_FLOAT64};
        REQUIRE(lissom_deformer_add_bones(host, deformer, mesh, &joints, &options, &bones) ==
                LISSOM_OK);
    }

    std::vector<Vec3> joints(const Host& host) const {
        std::vector<Vec3> places(at(lissom_deformer_joint_count(host, deformer, bones)));
        const lissom_output out{places.data(), places.size(), 0, LISSOM_FLOAT64};
        REQUIRE(lissom_deformer_read_joints(host, deformer, bones, &out) == LISSOM_OK);
        return places;
    }

    Mesh own = make_bar({.across = 4, .along = 30});
    lissom_mesh mesh{};
    lissom_deformer deformer{};
    std::int32_t bones = -1;
};

}  // namespace

TEST_CASE("bones in C turn and reach as those of the kernel") {
    const Host host;
    const BonedBar bar(host);
    CHECK(bar.bones == 1);
    BoneChain chain({{0, -1.5, 0}, {0, 0.5, 0}, {0, 2.5, 0}}, {1.0, 0.5});
    // Within limits: elsewhere the nearest pose is known to the root of rounding alone.
    BoneChain goal = chain;
    goal.turn(0, Vec3::UnitZ(), 0.5);
    goal.turn(1, Vec3::UnitX(), 0.3);
    const Vec3 place = goal.joints().back();
    const double axis[] = {0, 0, 2}, target[] = {place.x(), place.y(), place.z()};
    REQUIRE(lissom_deformer_turn_bone(host, bar.deformer, bar.bones, 1, axis, 2.0) == LISSOM_OK);
    chain.turn(1, {0, 0, 2}, 2.0);
    const auto close = [&] {
        const std::vector<Vec3> now = bar.joints(host), wanted = chain.joints();
        REQUIRE(now.size() == wanted.size());
        for (std::size_t i = 0; i < now.size(); ++i) CHECK((now[i] - wanted[i]).norm() < 1e-7);
    };
    close();
    double left = -1.0;
    REQUIRE(lissom_deformer_reach_with_bones(host, bar.deformer, bar.bones, target, axis, &left) ==
            LISSOM_OK);
    CHECK(left < 1e-7);
    CHECK(chain.reach(place, {.axis = {0, 0, 2}}) < 1e-7);
    close();
    REQUIRE(lissom_deformer_move_bones(host, bar.deformer, bar.bones, target) == LISSOM_OK);
    chain.set_base(place);
    close();
    REQUIRE(lissom_deformer_solve(host, bar.deformer, LISSOM_FULL) == LISSOM_OK);
    REQUIRE(lissom_deformer_reset_bones(host, bar.deformer, bar.bones) == LISSOM_OK);
    CHECK((bar.joints(host)[2] - Vec3(0, 2.5, 0)).norm() < 1e-12);
}

TEST_CASE("bones and handles in C follow a curve") {
    const Host host;
    const BonedBar bar(host);
    const double line[] = {1, 0, 0, 2, 0, 0, 9, 0, 0};
    const lissom_input points{line, 3, 0, LISSOM_FLOAT64};
    REQUIRE(lissom_deformer_follow_with_bones(host, bar.deformer, bar.bones, &points, false, 0.0) ==
            LISSOM_OK);
    CHECK((bar.joints(host)[0] - Vec3(1, 0, 0)).norm() < 1e-9);
    // The limit of the first bone is 1 radian.
    CHECK((bar.joints(host)[1] - Vec3(1 + 2 * std::sin(1.0), 2 * std::cos(1.0), 0)).norm() < 1e-9);
    REQUIRE(lissom_deformer_follow_with_bones(host, bar.deformer, bar.bones, &points, true, 0.3) ==
            LISSOM_OK);
    CHECK((bar.joints(host)[2] - Vec3(9, 0, 0)).norm() < 1e-9);
    REQUIRE(lissom_deformer_carry_handle(host, bar.deformer, bar.bones, &points, 0.0, 1.0, 0.0) ==
            LISSOM_OK);
    lissom_transform map{};
    REQUIRE(lissom_deformer_get_transform(host, bar.deformer, bar.bones, &map) == LISSOM_OK);
    CHECK(map.m[3] == doctest::Approx(8.0));
    CHECK(map.m[0] == doctest::Approx(1.0));
    const lissom_input one{line, 1, 0, LISSOM_FLOAT64};
    CHECK(lissom_deformer_follow_with_bones(host, bar.deformer, bar.bones, &one, false, 0.0) ==
          LISSOM_INVALID_ARGUMENT);
}

TEST_CASE("bones in C that are gone or wrong are refused") {
    const Host host;
    const BonedBar bar(host);
    const double axis[] = {0, 0, 1}, none[] = {0, 0, 0};
    CHECK(lissom_deformer_turn_bone(host, bar.deformer, bar.bones, 2, axis, 1.0) ==
          LISSOM_OUT_OF_RANGE);
    CHECK(lissom_deformer_turn_bone(host, bar.deformer, bar.bones, 0, none, 1.0) ==
          LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_deformer_joint_count(host, bar.deformer, bar.bones + 1) == -1);
    const double outside[] = {0, -1.5, 0, 4, 0.5, 0, 0, 2.5, 0};
    const lissom_input joints{outside, 3, 0, LISSOM_FLOAT64};
    std::int32_t bones = 77;
    CHECK(lissom_deformer_add_bones(host, bar.deformer, bar.mesh, &joints, nullptr, &bones) ==
          LISSOM_INVALID_ARGUMENT);
    CHECK(bones == 77);
    REQUIRE(lissom_deformer_remove_bones(host, bar.deformer, bar.bones) == LISSOM_OK);
    CHECK(lissom_deformer_reset_bones(host, bar.deformer, bar.bones) == LISSOM_HANDLE_REMOVED);
}

TEST_CASE("bones in a mirrored space turn as its handles do") {
    lissom_context_options options = lissom_default_context_options();
    options.space.left_handed = true;
    const Host host(options), plain;
    const BonedBar mirrored(host), bar(plain);
    const double axis[] = {0, 0, 1};
    REQUIRE(lissom_deformer_turn_bone(host, mirrored.deformer, mirrored.bones, 1, axis, 0.4) ==
            LISSOM_OK);
    REQUIRE(lissom_deformer_turn_bone(plain, bar.deformer, bar.bones, 1, axis, 0.4) == LISSOM_OK);
    // The same numbers mean the same turn of the numbers, in either space.
    CHECK((mirrored.joints(host)[2] - bar.joints(plain)[2]).norm() < 1e-9);
}

}  // namespace lissom::test
