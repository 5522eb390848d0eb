#include "kernel/deform/bones/bones.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

namespace lissom::test {
namespace {

// Four bones along y, of length 1, 1.5, 1 and 0.5.
BoneChain finger(std::vector<double> limits = {}) {
    return BoneChain({{0, 0, 0}, {0, 1, 0}, {0, 2.5, 0}, {0, 3.5, 0}, {0, 4, 0}},
                     std::move(limits));
}

std::vector<double> lengths_of(const std::vector<Vec3>& joints) {
    std::vector<double> lengths;
    for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
        lengths.push_back((joints[i + 1] - joints[i]).norm());
    }
    return lengths;
}

void check_lengths(const BoneChain& chain) {
    const auto rest = lengths_of(chain.rest()), now = lengths_of(chain.joints());
    for (std::size_t i = 0; i < rest.size(); ++i) CHECK(std::abs(rest[i] - now[i]) < 1e-12);
}

double angle_between(const BoneChain& chain, Index bone) {
    const auto before =
        bone > 0 ? chain.rotation(bone - 1) : Eigen::Quaterniond(Eigen::Quaterniond::Identity());
    return before.angularDistance(chain.rotation(bone));
}

TEST_CASE("bones: a turn takes the bones behind along, and no others") {
    BoneChain chain = finger();
    chain.turn(1, Vec3::UnitZ(), kPi / 2.0);
    const std::vector<Vec3> joints = chain.joints();
    CHECK((joints[1] - Vec3(0, 1, 0)).norm() < 1e-12);
    CHECK((joints[2] - Vec3(-1.5, 1, 0)).norm() < 1e-12);
    CHECK((joints[4] - Vec3(-3, 1, 0)).norm() < 1e-12);
    check_lengths(chain);
    for (Index i = 0; i < chain.size(); ++i) {
        const Affine map = chain.transforms()[at(i)];
        CHECK((map(chain.rest()[at(i)]) - joints[at(i)]).norm() < 1e-12);
        CHECK((map(chain.rest()[at(i + 1)]) - joints[at(i + 1)]).norm() < 1e-12);
    }
}

TEST_CASE("bones: the tip comes to any point that the chain can reach") {
    for (const Vec3& target : {Vec3(2, 1, 0.5), Vec3(-1, -2, 1), Vec3(0.1, 3.9, 0.2), Vec3(3, 0, 0),
                               Vec3(0.2, 0.3, 0.1), Vec3(0, 2, 0), Vec3(0, -3, 0)}) {
        BoneChain chain = finger();
        CHECK(chain.reach(target) < 1e-4);
        CHECK((chain.joints().back() - target).norm() < 1e-4);
        check_lengths(chain);
    }
}

TEST_CASE("bones: beyond its reach a chain stretches towards the target") {
    BoneChain chain = finger();
    const Vec3 target(6, 6, 0);
    CHECK(std::abs(chain.reach(target) - (target.norm() - 4.0)) < 1e-12);
    check_lengths(chain);
    BoneChain straight = finger();
    CHECK(straight.reach({0, 9, 0}) == doctest::Approx(5.0));
    CHECK((straight.joints().back() - Vec3(0, 4, 0)).norm() < 1e-9);
    // A long bone leaves a ball around the base that the tip cannot enter.
    BoneChain stiff({{0, 0, 0}, {0, 0.5, 0}, {0, 3, 0}, {0, 3.5, 0}});
    CHECK(std::abs(stiff.reach({0.3, 0.4, 0}) - 1.0) < 1e-12);
    CHECK((stiff.joints().back() - Vec3(0.9, 1.2, 0)).norm() < 1e-12);
    check_lengths(stiff);
    CHECK(std::abs(stiff.reach({0, 0, 0}) - 1.5) < 1e-12);
}

TEST_CASE("bones: near full stretch and full fold the tip comes to the target exactly") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<Vec3> joints = {Vec3::Zero()};
        const int bones = 2 + trial % 7;
        for (int i = 0; i < bones; ++i) {
            joints.push_back(joints.back() + Vec3(number(random), 1.5, number(random)));
        }
        BoneChain chain(joints);
        double longest = 0.0;
        for (const double length : lengths_of(joints)) longest = std::max(longest, length);
        const double inner = std::max(0.0, 2.0 * longest - chain.length());
        const Vec3 way = Vec3(number(random), number(random), number(random)).normalized();
        for (const double share : {1e-6, 1e-3, 0.5, 0.98, 0.999, 0.999999}) {
            const Vec3 target = (inner + share * (chain.length() - inner)) * way;
            const double off = chain.reach(target);
            CHECK(off < 1e-8 * chain.length());
            CHECK(std::abs((chain.joints().back() - target).norm() - off) < 1e-12);
            check_lengths(chain);
        }
    }
}

TEST_CASE("bones: with limits too, no reach leaves the tip farther away, and near ones are exact") {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int trial = 0; trial < 100; ++trial) {
        const std::vector<double> limits{1.5, 0.9, 0.7, 0.4};
        BoneChain goal = finger(limits), chain = finger(limits);
        for (Index i = 0; i < 4; ++i) {
            goal.turn(i, Vec3(number(random), number(random), number(random)), number(random));
        }
        const Vec3 target = goal.joints().back();
        double before = (chain.joints().back() - target).norm();
        for (int round = 0; round < 20; ++round) {
            const double off = chain.reach(target, {.rounds = 5});
            CHECK(off <= before);
            before = off;
        }
        CHECK(before < 1e-6);
        for (Index i = 0; i < 4; ++i) CHECK(angle_between(chain, i) <= limits[at(i)] + 1e-6);
    }
}

TEST_CASE("bones: a chain of many bones reaches in a few rounds") {
    std::vector<Vec3> joints;
    for (int i = 0; i <= 600; ++i) joints.push_back({0, 0.01 * i, 0});
    BoneChain chain(joints);
    CHECK(chain.reach({2, 1, 1}, {.rounds = 60}) < 1e-8);
    check_lengths(chain);
}

TEST_CASE("bones: a stretched chain folds about the axis that is given") {
    BoneChain chain = finger();
    CHECK(chain.reach({0, 2, 0}, {.axis = Vec3::UnitX()}) < 1e-4);
    for (const Vec3& joint : chain.joints()) CHECK(std::abs(joint.x()) < 1e-9);
    CHECK(std::abs(chain.joints()[2].z()) > 0.1);
}

TEST_CASE("bones: limits are kept by turns and by reaching") {
    const std::vector<double> limits{0.2, 0.5, 0.5, 0.0};
    BoneChain chain = finger(limits);
    chain.turn(1, Vec3(1, 0, 1), 2.0);
    CHECK(angle_between(chain, 1) == doctest::Approx(0.5));
    chain.turn(3, Vec3::UnitX(), 1.0);
    CHECK(angle_between(chain, 3) < 1e-9);
    for (const Vec3& target : {Vec3(3, 1, 1), Vec3(0, -4, 0), Vec3(1, 3.4, 0)}) {
        BoneChain limited = finger(limits);
        limited.reach(target);
        for (Index i = 0; i < 4; ++i) {
            CHECK(angle_between(limited, i) <= limits[at(i)] + 1e-6);
        }
        check_lengths(limited);
    }
}

TEST_CASE("bones: rotations and base determine the chain") {
    BoneChain chain = finger();
    chain.reach({1.5, 2, 0.5});
    chain.set_base({0.3, -1, 2});
    std::vector<Eigen::Quaterniond> rotations;
    for (Index i = 0; i < chain.size(); ++i) rotations.push_back(chain.rotation(i));
    BoneChain again = finger();
    again.set(rotations, {0.3, -1, 2});
    const auto a = chain.joints(), b = again.joints();
    for (std::size_t i = 0; i < a.size(); ++i) CHECK((a[i] - b[i]).norm() < 1e-12);
}

TEST_CASE("bones: bad chains, turns and targets are refused") {
    const auto code_of = [](const auto& action) { return error_of(action).code(); };
    CHECK(code_of([] { BoneChain({{0, 0, 0}}); }) == ErrorCode::invalid_argument);
    CHECK(code_of([] { BoneChain({{0, 0, 0}, {0, 0, 0}}); }) == ErrorCode::invalid_argument);
    CHECK(code_of([] { BoneChain({{0, 0, 0}, {std::nan(""), 0, 0}}); }) == ErrorCode::not_finite);
    CHECK(code_of([] { finger({1.0}); }) == ErrorCode::invalid_argument);
    CHECK(code_of([] { finger({1.0, 1.0, 4.0, 1.0}); }) == ErrorCode::invalid_argument);
    BoneChain chain = finger();
    CHECK(code_of([&] { chain.turn(4, Vec3::UnitX(), 1.0); }) == ErrorCode::out_of_range);
    CHECK(code_of([&] { chain.turn(0, Vec3::Zero(), 1.0); }) == ErrorCode::invalid_argument);
    CHECK(code_of([&] { chain.reach({INFINITY, 0, 0}); }) == ErrorCode::not_finite);
    CHECK(code_of([&] { chain.reach({1e154, 0, 0}); }) == ErrorCode::not_finite);
    CHECK(code_of([&] { chain.set_base({0, 1e154, 0}); }) == ErrorCode::not_finite);
    CHECK(code_of([] { BoneChain({{0, 0, 0}, {1e154, 0, 0}}); }) == ErrorCode::not_finite);
    CHECK(code_of([&] { chain.reach({1, 0, 0}, {.rounds = 0}); }) == ErrorCode::invalid_argument);
    check_lengths(chain);
}

// ---- In a deformer

struct Arm {
    Mesh mesh = make_bar({.across = 6, .along = 40});
    Deformer deformer{mesh};
    Bones bones;

    Arm() {
        deformer.pin(mesh.region("bottom"));
        bones = add_bones(deformer, mesh, {.joints = {{0, -1.5, 0}, {0, 0.5, 0}, {0, 2.5, 0}}});
    }
};

TEST_CASE("bones: each holds the surface around its middle") {
    const Arm arm;
    REQUIRE(arm.bones.handles.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        const Region& held = arm.deformer.handle(arm.bones.handles[i]).region;
        CHECK(held.size() >= 24);
        const double middle = -0.5 + 2.0 * static_cast<double>(i);
        for (const Index v : held.vertices()) {
            CHECK(std::abs(arm.mesh.position(v).y() - middle) < 0.31);
        }
    }
}

TEST_CASE("bones: the surface bends at the joint, and comes back to the bit") {
    Arm arm;
    BoneChain chain = chain_of(arm.deformer, arm.bones);
    chain.turn(1, Vec3::UnitZ(), -kPi / 2.0);
    set_bones(arm.deformer, arm.bones, chain);
    Mesh bent = arm.mesh;
    arm.deformer.solve();
    arm.deformer.apply_to(bent);
    for (const Index v : arm.deformer.handle(arm.bones.handles[1]).region.vertices()) {
        CHECK((bent.position(v) - chain.transforms()[1](arm.mesh.position(v))).norm() < 1e-9);
    }
    CHECK(bounds(bent).max.x() > 1.5);
    CHECK(volume(bent) > 0.8 * volume(arm.mesh));
    const auto joints = chain_of(arm.deformer, arm.bones).joints();
    CHECK((joints[2] - chain.joints()[2]).norm() < 1e-9);
    set_bones(arm.deformer, arm.bones, BoneChain(arm.bones.joints));
    arm.deformer.solve();
    arm.deformer.apply_to(bent);
    for (Index v = 0; v < bent.vertex_count(); ++v) {
        CHECK(bent.position(v) == arm.mesh.position(v));
    }
}

TEST_CASE("bones: the chain is that of the handles, whoever moves them") {
    Arm arm;
    const DeformSnapshot before = arm.deformer.snapshot();
    BoneChain chain = chain_of(arm.deformer, arm.bones);
    chain.reach({1.5, 0.5, 1});
    set_bones(arm.deformer, arm.bones, chain);
    arm.deformer.restore(before);
    CHECK((chain_of(arm.deformer, arm.bones).joints()[2] - Vec3(0, 2.5, 0)).norm() < 1e-12);
    arm.deformer.remove_handle(arm.bones.handles[1]);
    CHECK(error_of([&] { chain_of(arm.deformer, arm.bones); }).code() == ErrorCode::handle_removed);
}

TEST_CASE("bones: the deformer keeps its chains, in snapshots and through a rebase") {
    Arm arm;
    CHECK(bones_of(arm.deformer) == std::vector<Bones>{arm.bones});
    const DeformSnapshot before = arm.deformer.snapshot();
    BoneChain chain = chain_of(arm.deformer, arm.bones);
    chain.turn(1, Vec3::UnitZ(), 0.8);
    set_bones(arm.deformer, arm.bones, chain);
    arm.deformer.solve();
    arm.deformer.rebase();
    const Bones& now = bones_with(arm.deformer, arm.bones.handles[0]);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK((now.joints[i] - chain.joints()[i]).norm() < 1e-12);
        CHECK((chain_of(arm.deformer, now).joints()[i] - now.joints[i]).norm() < 1e-12);
    }
    remove_bones(arm.deformer, now);
    CHECK(bones_of(arm.deformer).empty());
    CHECK(arm.deformer.handles().size() == 1);
    CHECK(error_of([&] { bones_with(arm.deformer, arm.bones.handles[0]); }).code() ==
          ErrorCode::handle_removed);
    arm.deformer.restore(before);
    CHECK(bones_of(arm.deformer) == std::vector<Bones>{arm.bones});
    // One handle less, and the others are no chain.
    arm.deformer.remove_handle(arm.bones.handles[1]);
    CHECK(bones_of(arm.deformer).empty());
    CHECK(arm.deformer.handles().size() == 2);
}

TEST_CASE("bones: joints outside a surface that has an inside are named") {
    const Mesh bar = make_bar({.across = 4, .along = 20});
    Mesh inside_out = bar;
    flip(inside_out);
    const auto laid = [](const Mesh& mesh, std::vector<Vec3> joints) {
        const Error error = error_of([&] {
            bone_regions(mesh, Region::all(mesh.shared_topology()), {.joints = std::move(joints)});
        });
        CHECK(error.code() == ErrorCode::invalid_argument);
        return std::string(error.what());
    };
    for (const Mesh* mesh : {&bar, static_cast<const Mesh*>(&inside_out)}) {
        CHECK(laid(*mesh, {{0, -2, 0}, {2, 0, 0}, {0, 2, 0}}).find("joint 2") != std::string::npos);
        CHECK(laid(*mesh, {{0, -2, 0}, {0, 0, 0}, {0, 9, 0}}).find("joint 3") != std::string::npos);
        CHECK(laid(*mesh, {{0, 0, 0}, {0, 10, 0}}).find("joint 2") != std::string::npos);
        CHECK(laid(*mesh, {{2, -2, 0}, {2, 2, 0}}).find("joint 1") != std::string::npos);
        // The ends may stick out.
        CHECK(bone_regions(*mesh, Region::all(mesh->shared_topology()),
                           {.joints = {{0, -2.6, 0}, {0, 0, 0}, {0, 2.6, 0}}})
                  .size() == 2);
    }
    // A sheet has no inside.
    const Mesh sheet = make_grid({.segments = {20, 20}});
    CHECK(bone_regions(sheet, Region::all(sheet.shared_topology()),
                       {.joints = {{-0.4, 0.1, 0}, {0, 0.1, 0}, {0.4, 0.1, 0}}})
              .size() == 2);
}

TEST_CASE("bones: they hold what they see, and say which bone sees nothing") {
    // Two parallel bars: the bone in the first holds none of the second.
    Arm arm;
    CHECK(error_of([&] {
              bone_regions(arm.mesh, Region::all(arm.mesh.shared_topology()),
                           {.joints = {{0, -1, 0}, {0, 1, 0}, {9, 9, 9}, {9, 12, 9}}});
          }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] {
              add_bones(arm.deformer, arm.mesh, {.joints = {{0, -1.5, 0}, {0, 1.5, 0}}});
          }).code() == ErrorCode::handle_overlap);
    CHECK(arm.deformer.handles().size() == 3);
    CHECK(error_of([&] {
              bone_regions(arm.mesh, Region::all(arm.mesh.shared_topology()),
                           {.joints = {{0, -1, 0}, {0, 1, 0}}, .share = 0.0});
          }).code() == ErrorCode::invalid_argument);
    // Coarse meshes have few vertices beside a bone.
    const Mesh coarse = make_bar({.across = 1, .along = 4});
    const auto regions = bone_regions(coarse, Region::all(coarse.shared_topology()),
                                      {.joints = {{0, -2, 0}, {0, 0, 0}, {0, 2, 0}}});
    for (const Region& region : regions) CHECK(region.size() >= 3);
}

}  // namespace
}  // namespace lissom::test
