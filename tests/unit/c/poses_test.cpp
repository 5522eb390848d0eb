// Poses of deformers and spaces of poses, through the C interface.
#include <cmath>
#include <string>
#include <vector>

#include "kernel/deform/poses/pose_space.h"
#include "kernel/io/poses/pose_targets.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/c/host.h"

namespace lissom::test {
namespace {

Mesh thin_bar() {
    return make_bar({.across = 2, .along = 24});
}

// The upper part turns about z.
Mesh bent_bar(double angle) {
    Mesh mesh = thin_bar();
    for (Vec3& p : mesh.edit_positions()) {
        if (p.y() > 0.0) p = rotation(Vec3::UnitZ(), angle, Vec3::Zero())(p);
    }
    return mesh;
}

Mesh wide_bar() {
    Mesh mesh = thin_bar();
    for (Vec3& p : mesh.edit_positions()) p.x() *= 1.5;
    return mesh;
}

struct HostSpace {
    explicit HostSpace(const Host& host) {
        rest = host.add(thin_bar());
        bent[0] = host.add(bent_bar(0.6));
        bent[1] = host.add(bent_bar(1.2));
        wide = host.add(wide_bar());
        const lissom_named_pose poses[] = {{"wide", &wide, 1}, {"bent", bent, 2}};
        REQUIRE(lissom_pose_space_create(host, rest, poses, 2, &space) == LISSOM_OK);
    }

    lissom_mesh rest{}, bent[2]{}, wide{};
    lissom_pose_space space{};
};

PoseSpace kernel_space() {
    return {thin_bar(), {{"wide", {wide_bar()}}, {"bent", {bent_bar(0.6), bent_bar(1.2)}}}};
}

std::vector<Vec3> frame_of(const Host& host, lissom_pose_space space, double wide, double bent) {
    std::vector<Vec3> points(at(lissom_pose_space_vertex_count(host, space)));
    const double weights[] = {wide, bent};
    const lissom_input list{weights, 2, 0, LISSOM_FLOAT64};
    const lissom_output out{points.data(), points.size(), 0, LISSOM_FLOAT64};
    REQUIRE(lissom_pose_space_read_positions(host, space, &list, &out) == LISSOM_OK);
    return points;
}

struct Drag {
    explicit Drag(const Host& host) : mesh(host.add(thin_bar())) {
        const double origin[] = {0, -1.9, 0}, down[] = {0, -1, 0}, top[] = {0, 1.9, 0},
                     up[] = {0, 1, 0};
        lissom_region foot{}, tip{};
        REQUIRE(lissom_region_plane(host, mesh, origin, down, &foot) == LISSOM_OK);
        REQUIRE(lissom_region_plane(host, mesh, top, up, &tip) == LISSOM_OK);
        REQUIRE(lissom_deformer_create(host, mesh, {0}, nullptr, &deformer) == LISSOM_OK);
        REQUIRE(lissom_deformer_pin(host, deformer, foot) == LISSOM_OK);
        REQUIRE(lissom_deformer_add_handle(host, deformer, tip, nullptr, &handle) == LISSOM_OK);
    }

    lissom_pose pose_at(const Host& host, double angle) const {
        const auto map = transform_of(rotation(Vec3::UnitZ(), angle, Vec3::Zero()));
        lissom_pose pose{};
        REQUIRE(lissom_deformer_set_transform(host, deformer, handle, &map) == LISSOM_OK);
        REQUIRE(lissom_deformer_get_pose(host, deformer, &pose) == LISSOM_OK);
        return pose;
    }

    // Angle of the handle, -pi to pi.
    double angle(const Host& host) const {
        lissom_transform map{};
        REQUIRE(lissom_deformer_get_transform(host, deformer, handle, &map) == LISSOM_OK);
        return std::atan2(map.m[4], map.m[0]);
    }

    lissom_mesh mesh{};
    lissom_deformer deformer{};
    std::int32_t handle = -1;
};

}  // namespace

TEST_CASE("blends of a space of poses are those of the kernel, to the bit") {
    const Host host;
    const HostSpace own(host);
    const PoseSpace space = kernel_space();
    CHECK(lissom_pose_space_pose_count(host, own.space) == 2);
    CHECK(lissom_pose_space_vertex_count(host, own.space) == thin_bar().vertex_count());
    const char* name = nullptr;
    REQUIRE(lissom_pose_space_pose_name(host, own.space, 1, &name) == LISSOM_OK);
    CHECK(std::string(name) == "bent");
    for (const auto& pair :
         {std::pair(0.0, 0.0), {1.0, 0.0}, {0.0, 1.0}, {0.0, 0.5}, {0.3, 0.7}, {-0.2, 1.4}}) {
        const double wide = pair.first, bent = pair.second;
        CAPTURE(wide);
        CAPTURE(bent);
        const auto expected = space.positions({{"wide", wide}, {"bent", bent}});
        CHECK(frame_of(host, own.space, wide, bent) == expected);
        lissom_mesh mesh{};
        const double weights[] = {wide, bent};
        const lissom_input list{weights, 2, 0, LISSOM_FLOAT64};
        REQUIRE(lissom_pose_space_blend(host, own.space, &list, &mesh) == LISSOM_OK);
        CHECK(host.positions(mesh) == expected);
    }
}

TEST_CASE("a space of poses outlives its meshes, and a job makes the same") {
    const Host host;
    HostSpace own(host);
    const lissom_named_pose poses[] = {{"wide", &own.wide, 1}, {"bent", own.bent, 2}};
    lissom_job job{};
    REQUIRE(lissom_pose_space_begin_create(host, own.rest, poses, 2, &job) == LISSOM_OK);
    lissom_pose_space other{};
    REQUIRE(lissom_job_finish(host, job, &other.id) == LISSOM_OK);
    CHECK(lissom_pose_space_is_valid(host, other));
    for (const lissom_mesh mesh : {own.rest, own.wide, own.bent[0], own.bent[1]}) {
        REQUIRE(lissom_mesh_release(host, mesh) == LISSOM_OK);
    }
    CHECK(frame_of(host, own.space, 0.2, 0.9) == frame_of(host, other, 0.2, 0.9));
    REQUIRE(lissom_pose_space_release(host, other) == LISSOM_OK);
    CHECK_FALSE(lissom_pose_space_is_valid(host, other));
    CHECK(lissom_pose_space_pose_count(host, other) == -1);
}

TEST_CASE("a host with other axes gets the same blend, turned") {
    const Host own_axes;
    auto options = lissom_default_context_options();
    options.space.z_up = true;
    const Host turned_axes(options);
    const auto frame_in = [](const Host& host) {
        return frame_of(host, HostSpace(host).space, 0.4, 0.8);
    };
    // Its meshes are turned on the way in, and their blend on the way out.
    const std::vector<Vec3> expected = frame_in(own_axes), turned = frame_in(turned_axes);
    for (std::size_t v = 0; v < expected.size(); ++v) {
        CHECK((expected[v] - turned[v]).norm() < 1e-9);
    }
}

TEST_CASE("morph targets of a space of poses have a report") {
    const Host host;
    const HostSpace own(host);
    lissom_mesh plain{}, mended{};
    auto report = lissom_default_pose_targets_report(), better = report;
    REQUIRE(lissom_pose_space_targets(host, own.space, nullptr, &plain, &report) == LISSOM_OK);
    CHECK(report.pose_targets == 2);
    CHECK(report.correctives == 1);
    const double at[] = {1.0, 1.0, 0.0, 0.25};
    const lissom_input list{at, 4, 0, LISSOM_FLOAT64};
    REQUIRE(lissom_pose_space_targets(host, own.space, &list, &mended, &better) == LISSOM_OK);
    CHECK(better.correctives == 3);
    CHECK(better.linear_error > 0.0);
    CHECK(better.error < 0.5 * better.linear_error);
    lissom_attribute attribute = lissom_default_attribute();
    CHECK(lissom_mesh_find_attribute(host, mended, "morph.5.position", &attribute) == LISSOM_OK);
    CHECK(lissom_mesh_find_attribute(host, mended, "morph.6.position", &attribute) ==
          LISSOM_OUT_OF_RANGE);
}

TEST_CASE("bad poses of a space are refused, naming the pose") {
    const Host host;
    const HostSpace own(host);
    const lissom_mesh box = host.add(make_box({}));
    lissom_pose_space made{};
    const auto create = [&](const lissom_named_pose& pose, std::int32_t count = 1) {
        return lissom_pose_space_create(host, own.rest, &pose, count, &made);
    };
    CHECK(create({"other", &box, 1}) == LISSOM_TOPOLOGY_MISMATCH);
    CHECK(host.message().find("'other'") != std::string::npos);
    CHECK(create({"", &own.wide, 1}) == LISSOM_INVALID_ARGUMENT);
    CHECK(create({nullptr, &own.wide, 1}) == LISSOM_INVALID_ARGUMENT);
    CHECK(create({"none", nullptr, 1}) == LISSOM_INVALID_ARGUMENT);
    CHECK(create({"none", &own.wide, 0}) == LISSOM_INVALID_ARGUMENT);
    CHECK(create({"wide", &own.wide, 1}, 0) == LISSOM_INVALID_ARGUMENT);
    CHECK(create({"wide", &own.wide, 1}, -1) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_pose_space_create(host, own.rest, nullptr, 1, &made) == LISSOM_INVALID_ARGUMENT);
    const lissom_named_pose twice[] = {{"wide", &own.wide, 1}, {"wide", own.bent, 1}};
    CHECK(lissom_pose_space_create(host, own.rest, twice, 2, &made) == LISSOM_INVALID_ARGUMENT);
    CHECK(made.id == 0);
    double room[3];
    const double one = 1.0;
    const lissom_input few{&one, 1, 0, LISSOM_FLOAT64};
    const lissom_output small{room, 1, 0, LISSOM_FLOAT64};
    lissom_mesh mesh{};
    CHECK(lissom_pose_space_read_positions(host, own.space, &few, &small) ==
          LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_pose_space_blend(host, own.space, &few, &mesh) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_pose_space_targets(host, own.space, &few, &mesh, nullptr) ==
          LISSOM_INVALID_ARGUMENT);
    const double two[] = {0.5, 0.5};
    const lissom_input enough{two, 2, 0, LISSOM_FLOAT64};
    CHECK(lissom_pose_space_read_positions(host, own.space, &enough, &small) ==
          LISSOM_OUT_OF_RANGE);
    const char* name = nullptr;
    CHECK(lissom_pose_space_pose_name(host, own.space, 2, &name) == LISSOM_OUT_OF_RANGE);
    CHECK(lissom_pose_space_pose_name(host, own.space, -1, &name) == LISSOM_OUT_OF_RANGE);
}

TEST_CASE("a pose is a value: handles return to it, and go on turning between two") {
    const Host host;
    const Drag drag(host);
    const lissom_pose rest = drag.pose_at(host, 0.0);
    for (const double angle : {1.0, 2.0, 3.0}) drag.pose_at(host, angle);
    const lissom_pose far = drag.pose_at(host, 4.0);
    REQUIRE(lissom_deformer_set_pose(host, drag.deformer, rest) == LISSOM_OK);
    CHECK(drag.angle(host) == doctest::Approx(0.0));
    lissom_pose half{};
    REQUIRE(lissom_pose_blend(host, rest, far, 0.5, &half) == LISSOM_OK);
    REQUIRE(lissom_deformer_set_pose(host, drag.deformer, half) == LISSOM_OK);
    // Half of 229 degrees, not of the shorter way back.
    CHECK(drag.angle(host) == doctest::Approx(2.0));
    for (const double t : {0.0, 0.2, 0.5, 0.75}) {
        REQUIRE(lissom_deformer_set_blended_pose(host, drag.deformer, rest, far, t) == LISSOM_OK);
        CHECK(drag.angle(host) == doctest::Approx(4.0 * t));
    }
    REQUIRE(lissom_deformer_set_blended_pose(host, drag.deformer, rest, far, 1.0) == LISSOM_OK);
    CHECK(drag.angle(host) == doctest::Approx(4.0 - 2.0 * kPi));
    REQUIRE(lissom_pose_release(host, half) == LISSOM_OK);
    CHECK_FALSE(lissom_pose_is_valid(host, half));
    CHECK(lissom_deformer_set_pose(host, drag.deformer, half) == LISSOM_INVALID_HANDLE);
}

TEST_CASE("poses of another deformer are refused, and the handles stay") {
    const Host host;
    const Drag drag(host), other(host);
    const lissom_pose own = drag.pose_at(host, 0.5), foreign = other.pose_at(host, 1.0);
    CHECK(lissom_deformer_set_pose(host, drag.deformer, foreign) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_deformer_set_blended_pose(host, drag.deformer, own, foreign, 0.5) ==
          LISSOM_INVALID_ARGUMENT);
    lissom_pose made{};
    CHECK(lissom_pose_blend(host, own, foreign, 0.5, &made) == LISSOM_INVALID_ARGUMENT);
    CHECK(made.id == 0);
    CHECK(drag.angle(host) == doctest::Approx(0.5));
    CHECK(lissom_deformer_get_pose(host, drag.deformer, nullptr) == LISSOM_INVALID_ARGUMENT);
    REQUIRE(lissom_deformer_rebase(host, drag.deformer) == LISSOM_OK);
    CHECK(lissom_deformer_set_pose(host, drag.deformer, own) == LISSOM_INVALID_ARGUMENT);
}

}  // namespace lissom::test
