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
    const double axis[] = {0, 0, 2}, target[] = {1, 1.5, 0.5};
    REQUIRE(lissom_deformer_turn_bone(host, bar.deformer, bar.bones, 1, axis, 2.0) == LISSOM_OK);
    chain.turn(1, {0, 0, 2}, 2.0);
    const auto close = [&] {
        const std::vector<Vec3> now = bar.joints(host), wanted = chain.joints();
        REQUIRE(now.size() == wanted.size());
        for (std::size_t i = 0; i < now.size(); ++i) CHECK((now[i] - wanted[i]).norm() < 1e-9);
    };
    close();
    double left = -1.0;
    REQUIRE(lissom_deformer_reach_with_bones(host, bar.deformer, bar.bones, target, axis, &left) ==
            LISSOM_OK);
    CHECK(left == doctest::Approx(chain.reach({1, 1.5, 0.5}, {.axis = {0, 0, 2}})));
    close();
    REQUIRE(lissom_deformer_move_bones(host, bar.deformer, bar.bones, target) == LISSOM_OK);
    chain.set_base({1, 1.5, 0.5});
    close();
    REQUIRE(lissom_deformer_solve(host, bar.deformer, LISSOM_FULL) == LISSOM_OK);
    REQUIRE(lissom_deformer_reset_bones(host, bar.deformer, bar.bones) == LISSOM_OK);
    CHECK((bar.joints(host)[2] - Vec3(0, 2.5, 0)).norm() < 1e-12);
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
