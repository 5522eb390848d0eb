// Morph targets of a pose space.
#include "kernel/io/poses/pose_targets.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Turns the vertices of a bar about `axis`, the more the higher they are.
Mesh wound(const Mesh& rest, const Vec3& axis, double angle) {
    Mesh mesh = rest;
    for (Vec3& p : mesh.edit_positions()) {
        const double share = std::clamp(0.25 * (p.y() + 2.0), 0.0, 1.0);
        p = rotation(axis, share * angle, {0.0, -2.0, 0.0})(p);
    }
    return mesh;
}

PoseSpace two_poses() {
    const Mesh rest = make_bar({.across = 2, .along = 20});
    return {rest,
            {{"left", {wound(rest, Vec3::UnitZ(), 1.5)}},
             {"turned", {wound(rest, Vec3::UnitY(), 1.0), wound(rest, Vec3::UnitY(), 2.0)}}}};
}

// Distance of the targets of a mesh, as an engine sums them, from the blend.
double distance_at(const PoseSpace& space, const Mesh& mesh, const PoseTargetReport& report,
                   const std::vector<PoseWeight>& at, const std::string& semantic = "position") {
    const std::vector<double> weights = target_weights(report.targets, at);
    const Mesh goal = space.blend(at);
    const bool is_normal = semantic == "normal";
    const std::vector<Vec3> from = vertex_normals(mesh), to = vertex_normals(goal);
    double greatest = 0.0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        Vec3 sum = is_normal ? from[v] : mesh.position(v);
        for (std::size_t t = 0; t < weights.size(); ++t) {
            const std::string name = "morph." + std::to_string(t + 1) + "." + semantic;
            const auto change = mesh.attributes().find(name)->at(v);
            sum += weights[t] * Vec3(change[0], change[1], change[2]);
        }
        greatest = std::max(greatest, (sum - (is_normal ? to[v] : goal.position(v))).norm());
    }
    return greatest;
}

ErrorCode code_of(const PoseSpace& space, const std::vector<std::vector<PoseWeight>>& correctives) {
    try {
        pose_targets(space, {.correctives = correctives});
    } catch (const Error& e) {
        return e.code();
    }
    return ErrorCode::internal;
}

}  // namespace

TEST_CASE("pose targets: they give the blend at rest, the poses, and the weights of correctives") {
    const PoseSpace space = two_poses();
    const std::vector<std::vector<PoseWeight>> correctives{
        {{"left", 0.5}}, {{"left", 0.25}}, {{"left", 1.0}, {"turned", 1.0}}, {{"left", -0.5}}};
    PoseTargetReport report;
    const Mesh mesh = pose_targets(space, {.correctives = correctives}, &report);
    REQUIRE(report.targets.size() == 7);
    std::vector<std::vector<PoseWeight>> exact = correctives;
    exact.insert(exact.end(), {{}, {{"left", 1.0}}, {{"turned", 1.0}}, {{"turned", 0.5}}});
    for (const auto& at : exact) {
        CHECK(distance_at(space, mesh, report, at) < 1e-9);
        CHECK(distance_at(space, mesh, report, at, "normal") < 1e-9);
    }
    CHECK(distance_at(space, mesh, report, {{"left", 0.75}}) > 1e-3);
    CHECK(report.error < 0.5 * report.linear_error);
    CHECK(report.linear_error > 0.1);
}

TEST_CASE("pose targets: without correctives the error is that of a linear blend") {
    const Mesh rest = make_bar({.across = 2, .along = 20});
    const Mesh pose = wound(rest, Vec3::UnitZ(), 1.5);
    const PoseSpace space(rest, {{"left", {pose}}});
    PoseTargetReport report;
    pose_targets(space, {}, &report);
    CHECK(report.error == report.linear_error);
    double greatest = 0.0;
    for (int k = 1; k <= 10; ++k) {
        const double t = 0.1 * k;
        const std::vector<Vec3> blend = space.positions({{"left", t}});
        for (Index v = 0; v < rest.vertex_count(); ++v) {
            const Vec3 linear = (1.0 - t) * rest.position(v) + t * pose.position(v);
            greatest = std::max(greatest, (linear - blend[v]).norm());
        }
    }
    CHECK(report.error == doctest::Approx(greatest));
}

TEST_CASE("pose targets: they have their names, and come back from a glTF file") {
    PoseTargetReport report;
    const Mesh mesh =
        pose_targets(two_poses(), {.correctives = {{{"turned", 1.0}, {"left", 0.5}}}}, &report);
    const std::string text = encode_mesh(mesh, "gltf");
    const char* names = R"("targetNames":["left","turned","turned=0.5","left=0.5,turned=1"])";
    CHECK(text.find(names) != std::string::npos);
    const Mesh loaded = decode_mesh(encode_mesh(mesh, "glb"), "glb");
    CHECK(loaded.attributes().find("morph.4.position"));
}

TEST_CASE("pose targets: morph targets of the rest are left out") {
    Mesh rest = make_bar({.across = 2, .along = 20});
    const std::vector<double> zeros(3 * static_cast<std::size_t>(rest.vertex_count()), 0.0);
    for (const char* name : {"morph.1.position", "morph.9.position"}) {
        rest.attributes().add({name, Domain::vertex, 3, ScalarType::float32, zeros});
    }
    const PoseSpace space(rest, {{"left", {wound(rest, Vec3::UnitZ(), 1.0)}}});
    const Mesh mesh = pose_targets(space);
    CHECK(mesh.attributes().find("morph.1.position"));
    CHECK(!mesh.attributes().find("morph.9.position"));
}

TEST_CASE("pose targets: correctives without sense are refused") {
    const PoseSpace space = two_poses();
    CHECK(code_of(space, {{}}) == ErrorCode::invalid_argument);
    CHECK(code_of(space, {{{"left", 0.0}}}) == ErrorCode::invalid_argument);
    CHECK(code_of(space, {{{"left", 1.0}}}) == ErrorCode::invalid_argument);
    CHECK(code_of(space, {{{"left", 0.5}}, {{"left", 0.5}}}) == ErrorCode::invalid_argument);
    CHECK(code_of(space, {{{"turned", 0.5}}}) == ErrorCode::invalid_argument);
    CHECK(code_of(space, {{{"left", 1.5}}, {{"left", 2.5}}}) == ErrorCode::invalid_argument);
    CHECK(code_of(space, {{{"lift", 0.5}}}) == ErrorCode::out_of_range);
    CHECK(code_of(space, {{{"left", kNone}}}) == ErrorCode::not_finite);
}
