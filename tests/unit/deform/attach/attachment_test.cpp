// Meshes that follow the surface they sit on.
#include "kernel/deform/attach/attachment.h"

#include <doctest/doctest.h>

#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/deform/deformer.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Mesh ball_at(const Vec3& center, double radius) {
    Mesh ball = make_sphere({.radius = radius, .segments = 4});
    transform(ball, translation(center));
    return ball;
}

// Two balls on a side of a bar along y, of which the second half lies within.
Mesh buttons() {
    Mesh balls = ball_at({0.55, 0.4, 0.1}, 0.1);
    append(balls, ball_at({0.6, -0.7, -0.2}, 0.15));
    return balls;
}

Mesh bar() {
    return make_bar({.across = 6, .along = 30});
}

// A sheet of cloth beside the bar.
Mesh cloth() {
    Mesh sheet = make_grid({.size = {0.8, 3.0}, .segments = {8, 30}});
    transform(sheet, translation({0.55, 0.0, 0.0}) *
                         rotation(Vec3::UnitX(), kPi / 2, Vec3::Zero()) *
                         rotation(Vec3::UnitZ(), -kPi / 2, Vec3::Zero()));
    return sheet;
}

Mesh bent(const Mesh& mesh, double degrees) {
    Mesh result = mesh;
    Deformer deformer(mesh);
    deformer.pin(mesh.region("bottom"));
    deformer.rotate(deformer.add_handle(mesh.region("top")), Vec3::UnitZ(), degrees * kDegree);
    result.set_positions(deformer.solve());
    return result;
}

double max_difference(const Mesh& a, const Mesh& b) {
    double greatest = 0.0;
    for (Index v = 0; v < a.vertex_count(); ++v) {
        greatest = std::max(greatest, (a.position(v) - b.position(v)).norm());
    }
    return greatest;
}

double max_stretch(const Mesh& rest, const Mesh& now) {
    double greatest = 0.0;
    for (Index e = 0; e < rest.topology().edge_count(); ++e) {
        const auto ends = rest.topology().edge(e);
        const double before = (rest.position(ends.first) - rest.position(ends.second)).norm();
        const double after = (now.position(ends.first) - now.position(ends.second)).norm();
        greatest = std::max(greatest, std::abs(after / before - 1.0));
    }
    return greatest;
}

constexpr AttachmentMode kModes[] = {AttachmentMode::components, AttachmentMode::vertices};

}  // namespace

TEST_CASE("attachment: on the rest shape nothing moves, to the bit") {
    const Mesh surface = bar(), rest = buttons();
    for (const AttachmentMode mode : kModes) {
        Mesh now = rest;
        const Attachment attachment(surface, rest, {mode});
        transform(now, translation({1.0, 2.0, 3.0}));
        attachment.follow(surface, now);
        CHECK(max_difference(now, rest) == 0.0);
    }
}

TEST_CASE("attachment: a similarity of the surface is that of the attached mesh") {
    const Mesh surface = bar();
    const Affine map = translation({3.0, -2.0, 50.0}) *
                       rotation(Vec3(1.0, 2.0, -0.5).normalized(), 2.0, Vec3::Zero()) *
                       scaling(Vec3::Constant(1.7), Vec3::Zero());
    for (const Mesh& rest : {buttons(), cloth()}) {
        for (const AttachmentMode mode : kModes) {
            Mesh moved = surface, expected = rest, now = rest;
            transform(moved, map);
            transform(expected, map);
            Attachment(surface, rest, {.mode = mode, .scale = true}).follow(moved, now);
            CHECK(max_difference(now, expected) < 1e-12 * 50.0);
        }
    }
}

TEST_CASE("attachment: components keep their shape and stay on a surface that bends") {
    const Mesh surface = bar(), rest = buttons();
    Mesh now = rest;
    const Mesh moved = bent(surface, 90.0);
    Attachment(surface, rest).follow(moved, now);
    CHECK(max_stretch(rest, now) < 1e-12);
    const SpatialTree before(surface), after(moved);
    for (Index v = 0; v < rest.vertex_count(); ++v) {
        const double difference =
            before.nearest(rest.position(v)).distance - after.nearest(now.position(v)).distance;
        CHECK(std::abs(difference) < 0.03);
    }
    CHECK(max_difference(now, rest) > 0.3);
}

TEST_CASE("attachment: cloth keeps its distance from a surface that bends") {
    const Mesh surface = bar(), rest = cloth();
    Mesh now = rest;
    const Mesh moved = bent(surface, 60.0);
    Attachment(surface, rest, {AttachmentMode::vertices}).follow(moved, now);
    const SpatialTree after(moved);
    for (Index v = 0; v < rest.vertex_count(); ++v) {
        CHECK(after.nearest(now.position(v)).distance == doctest::Approx(0.05).epsilon(0.05));
    }
    CHECK(max_stretch(rest, now) < 0.5);
}

TEST_CASE("attachment: without scale a component keeps its size on a surface that grows") {
    const Mesh surface = bar(), rest = buttons();
    Mesh grown = surface, now = rest;
    transform(grown, scaling(Vec3::Constant(3.0), Vec3::Zero()));
    Attachment(surface, rest).follow(grown, now);
    CHECK(max_stretch(rest, now) < 1e-12);
    CHECK(SpatialTree(grown).nearest(now.position(0)).distance < 0.2);
}

TEST_CASE("attachment: custom normals turn along") {
    const Mesh surface = bar();
    Mesh rest = buttons();
    std::vector<double> values;
    for (Index v = 0; v < rest.vertex_count(); ++v) values.insert(values.end(), {1.0, 0.0, 0.0});
    rest.attributes().add({"normal", Domain::vertex, 3, ScalarType::float64, values});
    const Affine turn = rotation(Vec3::UnitZ(), 1.0, Vec3::Zero());
    Mesh moved = surface, now = rest;
    transform(moved, turn);
    Attachment(surface, rest).follow(moved, now);
    const std::span<const double> turned = std::as_const(now).attributes().find("normal")->at(0);
    CHECK(turned[0] == doctest::Approx(std::cos(1.0)));
    CHECK(turned[1] == doctest::Approx(std::sin(1.0)));
}

TEST_CASE("attachment: components off the surface are refused by name") {
    const Mesh surface = bar();
    Mesh far = buttons();
    append(far, ball_at({9.0, 0.0, 0.0}, 0.1));
    try {
        const Attachment attachment(surface, far);
        FAIL("it was attached");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_argument);
        CHECK(error.elements().count == 1);
        CHECK(error.elements().ids.front() == buttons().vertex_count());
    }
    CHECK(Attachment(surface, far, {.max_distance = 10.0}).distance() ==
          doctest::Approx(8.4).epsilon(0.01));
    CHECK_THROWS_AS(Attachment(surface, far, {.max_distance = kNone}), Error);
    CHECK_THROWS_AS(Attachment(surface, far, {.max_distance = -1.0}), Error);
}

TEST_CASE("attachment: meshes of another topology are refused, and nothing moves") {
    const Mesh surface = bar(), rest = buttons();
    const Attachment attachment(surface, rest);
    Mesh other = ball_at({0.5, 0.0, 0.0}, 0.1), now = rest;
    const Mesh before = other;
    CHECK_THROWS_AS(attachment.follow(surface, other), Error);
    CHECK_THROWS_AS(attachment.follow(other, now), Error);
    CHECK(max_difference(now, rest) == 0.0);
    CHECK(max_difference(other, before) == 0.0);
}
