// Blends of posed meshes.
#include "kernel/deform/poses/pose_space.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

constexpr double kBegin = -1.5, kEnd = 1.5;

// Bends a bar along y about z: fibres keep their distance from the middle one, which keeps its
// length. Below kBegin nothing moves.
Vec3 bent_point(const Vec3& p, double angle) {
    if (p.y() <= kBegin || angle == 0.0) return p;
    const double radius = (kEnd - kBegin) / angle;
    const double turn = angle * (std::min(p.y(), kEnd) - kBegin) / (kEnd - kBegin);
    const Vec3 out(std::cos(turn), std::sin(turn), 0.0), up(-out.y(), out.x(), 0.0);
    const double beyond = std::max(p.y() - kEnd, 0.0);
    return Vec3(-radius, kBegin, p.z()) + (radius + p.x()) * out + beyond * up;
}

Mesh bar() {
    return make_bar({.width = 0.6, .across = 4, .along = 60});
}

Mesh moved(const Mesh& mesh, auto&& move) {
    std::vector<Vec3> positions;
    for (const Vec3& p : mesh.positions()) positions.push_back(move(p));
    Mesh result = mesh;
    result.set_positions(std::move(positions));
    return result;
}

Mesh bent(const Mesh& mesh, double angle) {
    return moved(mesh, [&](const Vec3& p) { return bent_point(p, angle); });
}

Mesh mapped(const Mesh& mesh, const Affine& map) {
    return moved(mesh, [&](const Vec3& p) { return map(p); });
}

double greatest_distance(const Mesh& a, const Mesh& b) {
    double greatest = 0.0;
    for (Index v = 0; v < a.vertex_count(); ++v) {
        greatest = std::max(greatest, (a.position(v) - b.position(v)).norm());
    }
    return greatest;
}

Mesh linear_blend(const Mesh& a, const Mesh& b, double t) {
    std::vector<Vec3> positions;
    for (Index v = 0; v < a.vertex_count(); ++v) {
        positions.push_back((1.0 - t) * a.position(v) + t * b.position(v));
    }
    Mesh result = a;
    result.set_positions(std::move(positions));
    return result;
}

ErrorCode code_of(auto&& work) {
    try {
        work();
    } catch (const Error& e) {
        return e.code();
    }
    return ErrorCode::internal;
}

}  // namespace

TEST_CASE("pose space: no weights give the rest and a pose alone the pose, to the bit and nearby") {
    const Mesh rest = bar(), pose = bent(rest, 2.0), other = bent(rest, -1.0);
    const PoseSpace space(rest, {{"bent", {pose}}, {"back", {other}}});
    CHECK(greatest_distance(space.blend({}), rest) == 0.0);
    CHECK(greatest_distance(space.blend({{"bent", 1.0}}), pose) == 0.0);
    CHECK(greatest_distance(space.blend({{"back", 1.0}, {"bent", 0.0}}), other) == 0.0);
    CHECK(greatest_distance(space.blend({{"bent", 1.0 + 1e-12}}), pose) < 1e-9);
    CHECK(greatest_distance(space.blend({{"bent", 1e-12}}), rest) < 1e-9);
    CHECK(greatest_distance(space.blend({{"bent", 0.5}, {"bent", 0.5}}), pose) == 0.0);
}

TEST_CASE("pose space: a part of a bend is a bend, beyond half a turn as well") {
    const Mesh rest = bar();
    for (const double angle : {0.5 * kPi, 1.5 * kPi, 2.5 * kPi}) {
        CAPTURE(angle);
        const Mesh pose = bent(rest, angle);
        const PoseSpace space(rest, {{"bent", {pose}}});
        for (const double t : {0.25, 0.5, 0.8, 1.2, -0.3}) {
            CAPTURE(t);
            const Mesh expected = bent(rest, t * angle);
            const double error = greatest_distance(space.blend({{"bent", t}}), expected);
            CHECK(error < 0.01 * surface_radius(rest));
            CHECK(error < 0.1 * greatest_distance(linear_blend(rest, pose, t), expected));
        }
    }
}

TEST_CASE("pose space: rigid motions blend as screws, for each component") {
    Mesh rest = bar();
    append(rest, mapped(bar(), translation({30.0, 0.0, 0.0})));
    const Vec3 axis = Vec3(1.0, 2.0, -0.5).normalized(), about(3.0, -1.0, 2.0);
    const auto screw = [&](double t) {
        return translation(4.0 * t * axis) * rotation(axis, t * 170.0 * kDegree, about);
    };
    const PoseSpace space(rest, {{"away", {mapped(rest, screw(1.0))}}});
    for (const double t : {0.3, 0.5, -0.4, 1.1}) {
        CAPTURE(t);
        CHECK(greatest_distance(space.blend({{"away", t}}), mapped(rest, screw(t))) < 1e-9);
    }
}

TEST_CASE("pose space: a path of shapes passes through them and turns on beyond half a turn") {
    const Mesh rest = bar();
    const auto turn = [&](double degrees) {
        return mapped(rest, rotation(Vec3::UnitX(), degrees * kDegree, {0.0, 2.0, 0.0}));
    };
    const PoseSpace space(rest, {{"turned", {turn(80), turn(160), turn(240)}}});
    CHECK(greatest_distance(space.blend({{"turned", 1.0 / 3.0}}), turn(80)) < 1e-9);
    CHECK(greatest_distance(space.blend({{"turned", 2.0 / 3.0}}), turn(160)) < 1e-9);
    CHECK(greatest_distance(space.blend({{"turned", 1.0}}), turn(240)) == 0.0);
    CHECK(greatest_distance(space.blend({{"turned", 0.5}}), turn(120)) < 1e-9);
    CHECK(greatest_distance(space.blend({{"turned", 0.75}}), turn(180)) < 1e-9);
}

TEST_CASE("pose space: a similarity of all shapes is that of the blend") {
    const Mesh rest = bar(), one = bent(rest, 2.0);
    const Mesh two = moved(rest, [](const Vec3& p) { return Vec3(1.3 * p.x(), p.y(), p.z()); });
    const Affine map = translation({100.0, -20.0, 3.0}) *
                       rotation({1.0, 1.0, 0.3}, 2.2, Vec3::Zero()) *
                       scaling(Vec3::Constant(2.5), Vec3::Zero());
    const std::vector<PoseWeight> weights{{"one", 0.7}, {"two", 0.6}};
    const PoseSpace space(rest, {{"one", {one}}, {"two", {two}}});
    const PoseSpace image(mapped(rest, map),
                          {{"one", {mapped(one, map)}}, {"two", {mapped(two, map)}}});
    CHECK(greatest_distance(image.blend(weights), mapped(space.blend(weights), map)) < 1e-9);
}

TEST_CASE("pose space: poses of different parts do not disturb each other; the rest stays") {
    const Mesh rest = bar();
    const auto mirrored = [](const Mesh& mesh) {
        return moved(mesh, [](const Vec3& p) { return Vec3(p.x(), -p.y(), p.z()); });
    };
    const auto upper = [](const Vec3& p) {
        return p.y() < 0.5 ? p : Vec3(bent_point(p - Vec3(0, 2, 0), 1.5) + Vec3(0, 2, 0));
    };
    const Mesh up = moved(rest, upper), down = mirrored(moved(mirrored(rest), upper));
    const PoseSpace space(rest, {{"up", {up}}, {"down", {down}}});
    const Mesh both = space.blend({{"up", 1.0}, {"down", 1.0}}), half = space.blend({{"up", 0.5}});
    for (Index v = 0; v < rest.vertex_count(); ++v) {
        const Vec3 sum = up.position(v) + down.position(v) - rest.position(v);
        CHECK((both.position(v) - sum).norm() < 1e-9);
        if (std::abs(rest.position(v).y()) < 0.5) CHECK(half.position(v) == rest.position(v));
        if (rest.position(v).y() < 0.0) CHECK((half.position(v) - rest.position(v)).norm() < 1e-9);
    }
}

TEST_CASE("pose space: a component on the surface follows what is below it") {
    Mesh rest = bar();
    const Index body = rest.vertex_count();
    Mesh ball = make_sphere({.radius = 0.1, .segments = 4});
    append(rest, mapped(ball, translation({0.38, 2.2, 0.1})));
    const Mesh pose = bent(rest, 0.75 * kPi);
    const Mesh half = PoseSpace(rest, {{"bent", {pose}}}).blend({{"bent", 0.5}});
    const Mesh expected = bent(rest, 0.375 * kPi);
    double greatest = 0.0;
    for (Index v = body; v < rest.vertex_count(); ++v) {
        greatest = std::max(greatest, (half.position(v) - expected.position(v)).norm());
    }
    CHECK(greatest < 0.01);
}

TEST_CASE("pose space: flat faces, and faces that a pose makes flat, keep poses exact") {
    FaceList faces;
    for (const auto& face : {std::array{0, 1, 4}, {0, 4, 2}, {1, 3, 4}, {4, 3, 2}}) {
        faces.add(face);
    }
    // The first face has no area.
    const Mesh rest({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0, 0}}, faces);
    Mesh pose = rest;
    pose.set_positions({{0, 0, 0}, {0, 1, 0}, {0, 0.5, 0}, {-0.3, 1, 2}, {0, 0.5, 0.3}});
    const PoseSpace space(rest, {{"pose", {pose}}});
    CHECK(greatest_distance(space.blend({{"pose", 1.0 + 1e-12}}), pose) < 1e-9);
    CHECK(greatest_distance(space.blend({{"pose", 1e-12}}), rest) < 1e-9);
    CHECK(space.blend({{"pose", 0.5}}).position(3).allFinite());
}

TEST_CASE("pose space: vertices without faces go straight") {
    FaceList faces;
    faces.add({0, 1, 2});
    const Mesh rest({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}, faces);
    Mesh pose = rest;
    pose.set_position(3, {7, 5, 5});
    const Mesh half = PoseSpace(rest, {{"pose", {pose}}}).blend({{"pose", 0.5}});
    CHECK((half.position(3) - Vec3(6, 5, 5)).norm() < 1e-12);
    CHECK(half.position(1) == rest.position(1));
}

TEST_CASE("pose space: custom normals turn along") {
    Mesh rest = bar();
    std::vector<double> values;
    for (Index v = 0; v < rest.vertex_count(); ++v) values.insert(values.end(), {0.0, 0.0, 1.0});
    rest.attributes().add({"normal", Domain::vertex, 3, ScalarType::float64, values});
    const Affine turn = rotation(Vec3::UnitX(), 90.0 * kDegree, Vec3::Zero());
    const Mesh half = PoseSpace(rest, {{"turned", {mapped(rest, turn)}}}).blend({{"turned", 0.5}});
    const auto normal = half.attributes().find("normal")->at(0);
    CHECK(normal[1] == doctest::Approx(-std::sqrt(0.5)));
    CHECK(normal[2] == doctest::Approx(std::sqrt(0.5)));
}

TEST_CASE("pose space: bad input is refused") {
    const Mesh rest = bar(), pose = bent(rest, 1.0);
    const auto make = [&](const std::vector<NamedPose>& poses) {
        return code_of([&] { PoseSpace(rest, poses); });
    };
    CHECK(make({}) == ErrorCode::invalid_argument);
    CHECK(make({{"none", {}}}) == ErrorCode::invalid_argument);
    CHECK(make({{"", {pose}}}) == ErrorCode::invalid_argument);
    CHECK(make({{"a", {pose}}, {"a", {pose}}}) == ErrorCode::invalid_argument);
    CHECK(make({{"other", {make_sphere()}}}) == ErrorCode::topology_mismatch);
    CHECK(code_of([&] { PoseSpace(Mesh(), {{"a", {Mesh()}}}); }) == ErrorCode::mesh_empty);
    const PoseSpace space(rest, {{"bent", {pose}}});
    const auto blend = [&](const std::string& name, double weight) {
        return code_of([&] { space.blend({{name, weight}}); });
    };
    CHECK(blend("bend", 0.5) == ErrorCode::out_of_range);
    CHECK(blend("bent", kNone) == ErrorCode::not_finite);
    CHECK(blend("bent", std::numeric_limits<double>::infinity()) == ErrorCode::not_finite);
    CHECK(blend("bent", 1e300) == ErrorCode::not_finite);
}

TEST_CASE("pose space: equal faces of another topology are the same") {
    const Mesh rest = bar(), pose = bent(rest, 1.0);
    const Mesh loaded({pose.positions().begin(), pose.positions().end()}, pose.topology().faces());
    const PoseSpace space(rest, {{"bent", {loaded}}});
    CHECK(greatest_distance(space.blend({{"bent", 1.0}}), pose) == 0.0);
}

TEST_CASE("pose space: a cancel stops it") {
    const Mesh rest = bar(), pose = bent(rest, 1.0);
    const Context context;
    context.cancel();
    CHECK(code_of([&] { PoseSpace(rest, {{"bent", {pose}}}, context); }) == ErrorCode::cancelled);
}
