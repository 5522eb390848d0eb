// Drags that end where the surface touches itself.
#include "kernel/deform/contact/contact_stop.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "kernel/deform/contact/contact_avoid.h"
#include "kernel/deform/contact/contacts.h"
#include "kernel/deform/contact/pose_path.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Scene bar_scene() {
    return make_scene(make_bar({.width = 1.0, .length = 6.0, .across = 4, .along = 24}));
}

// The upper end bends over and comes down onto the lower one.
Affine onto_itself(const Scene& scene) {
    const Box box = bounds(scene.mesh);
    return translation({0.0, -0.8 * (box.max.y() - box.min.y()), 0.0}) *
           rotation(Vec3::UnitZ(), 2.8, {0.3, 0.4 * box.max.y(), 0.0});
}

}  // namespace

TEST_CASE("stop: a free way is gone to its end, as by solve to the bit") {
    const Scene scene = bar_scene();
    Edit stopped = make_edit(scene), solved = make_edit(scene);
    for (const double angle : {0.4, 1.1, -0.3}) {
        for (Edit* edit : {&stopped, &solved}) {
            edit->deformer.set_transform(edit->high, bend(scene, Vec3::Zero(), angle));
        }
        const ContactStop stop = solve_until_contact(stopped.deformer, scene.mesh);
        CHECK(stop.share == 1.0);
        CHECK(stop.contacts.empty());
        CHECK(stopped.deformer.positions() == solved.deformer.solve());
        CHECK(stopped.deformer.pose(stopped.high) == solved.deformer.pose(solved.high));
    }
}

TEST_CASE("stop: no contact at the pose that is reached, and one a thousandth beyond") {
    const Scene scene = bar_scene();
    Edit edit = make_edit(scene), further = make_edit(scene);
    edit.deformer.set_transform(edit.high, onto_itself(scene));
    const DeformSnapshot asked = edit.deformer.snapshot();
    const ContactStop stop = solve_until_contact(edit.deformer, scene.mesh);
    CHECK(stop.share > 0.05);
    CHECK(stop.share < 1.0);
    CHECK(!stop.contacts.empty());
    CHECK(contacts_of(edit.deformer, scene.mesh).empty());
    // The handle stays where the surface does.
    const std::vector<Vec3> reached = edit.deformer.positions();
    CHECK(edit.deformer.solve() == reached);
    CHECK(edit.deformer.pose(edit.high) != asked.poses.handles[at(edit.high.value)]);
    // The way goes on from there, so that the rest of it is stopped at once.
    edit.deformer.set_transform(edit.high, onto_itself(scene));
    const ContactStop again = solve_until_contact(edit.deformer, scene.mesh);
    CHECK(again.share < 0.05);
    CHECK(contacts_of(edit.deformer, scene.mesh).empty());
}

TEST_CASE("stop: what is passed through in between stops as well") {
    const Scene scene = bar_scene();
    Edit edit = make_edit(scene);
    const Vec3 low = scene.mesh.position(scene.low.front()),
               high = scene.mesh.position(scene.high.front());
    // Through the held end, and out on its other side.
    edit.deformer.set_transform(edit.high, translation(1.6 * (low - high)));
    const ContactStop stop = solve_until_contact(edit.deformer, scene.mesh);
    CHECK(stop.share < 1.0);
    CHECK(contacts_of(edit.deformer, scene.mesh).empty());
}

TEST_CASE("stop: a drag that begins in contact may leave it, and gets no deeper") {
    const Scene scene = bar_scene();
    Edit edit = make_edit(scene);
    edit.deformer.set_transform(edit.high, onto_itself(scene));
    edit.deformer.solve();
    const std::size_t before = contacts_of(edit.deformer, scene.mesh).size();
    REQUIRE(before > 0);
    edit.deformer.set_transform(edit.high, translation({0.0, -0.5, 0.0}) * onto_itself(scene));
    (void)solve_until_contact(edit.deformer, scene.mesh);
    CHECK(contacts_of(edit.deformer, scene.mesh).size() <= before);
}

TEST_CASE("stop: after an error nothing has moved") {
    const Scene scene = bar_scene();
    ContextOptions options;
    int calls = 0;
    options.progress = [&](std::string_view, double) { ++calls; };
    const Context context(options);
    Edit edit = make_edit(scene);
    edit.deformer.solve();
    const std::vector<Vec3> before = edit.deformer.positions();
    edit.deformer.set_transform(edit.high, onto_itself(scene));
    const HandlePose asked = edit.deformer.pose(edit.high);
    CHECK(error_of([&] { solve_until_contact(edit.deformer, make_bar({})); }).code() ==
          ErrorCode::topology_mismatch);
    context.cancel();
    CHECK(error_of([&] { solve_until_contact(edit.deformer, scene.mesh, context); }).code() ==
          ErrorCode::cancelled);
    CHECK(edit.deformer.positions() == before);
    CHECK(edit.deformer.pose(edit.high) == asked);
}

TEST_CASE("stop: handles farther away than boxes reach are refused, and nothing moves") {
    const Scene scene = bar_scene();
    Edit edit = make_edit(scene);
    const std::vector<Vec3> before = edit.deformer.solve();
    for (const double far : {1e40, 1e200, 1e308}) {
        edit.deformer.set_transform(edit.high, translation({far, 0.0, 0.0}));
        CHECK(error_of([&] { solve_until_contact(edit.deformer, scene.mesh); }).code() ==
              ErrorCode::not_finite);
        CHECK(error_of([&] { solve_avoiding_contacts(edit.deformer, scene.mesh); }).code() ==
              ErrorCode::not_finite);
        CHECK(edit.deformer.positions() == before);
    }
}

TEST_CASE("stop: a constraint of a vertex moves in proportion") {
    const Scene scene = bar_scene();
    Edit edit = make_edit(scene);
    const Index v = scene.between(30);
    const Vec3 at_rest = scene.mesh.position(v), away = at_rest + Vec3(0.4, 0.1, 0.0);
    edit.deformer.constrain({.point = vertex_point(v), .position = at_rest});
    edit.deformer.solve();
    edit.deformer.constrain({.point = vertex_point(v), .position = away});
    const ContactStop stop = solve_until_contact(edit.deformer, scene.mesh);
    CHECK(stop.share == 1.0);
    CHECK((edit.deformer.positions()[at(v)] - away).norm() < 1e-9);
}

TEST_CASE("the way of a handle: its ends, a rotation about a far point, and full turns") {
    const Scene scene = bar_scene();
    Edit edit = make_edit(scene);
    const DeformSnapshot rest = edit.deformer.snapshot();
    const Vec3 about(2.0, 1.0, 0.0);
    edit.deformer.set_transform(edit.high, rotation(Vec3::UnitZ(), 2.0, about));
    const DeformSnapshot bent = edit.deformer.snapshot();
    const PosePath path(*rest.rest, *rest.constraints, rest.poses, bent.poses);
    const std::size_t h = at(edit.high.value);
    CHECK(path.at(1.0) == bent.poses);
    CHECK((path.at(0.0).handles[h].transform.linear - Mat3::Identity()).norm() < 1e-12);
    const Affine half = path.at(0.5).handles[h].transform,
                 expected = rotation(Vec3::UnitZ(), 1.0, about);
    CHECK((half.linear - expected.linear).norm() < 1e-9);
    CHECK((half.translation - expected.translation).norm() < 1e-9);
    edit.deformer.rotate(edit.high, Vec3::UnitZ(), 2.0 * kPi);
    const DeformSnapshot wound = edit.deformer.snapshot();
    const PosePath turn(*rest.rest, *rest.constraints, rest.poses, wound.poses);
    CHECK(turn.at(0.5).handles[h].turn.norm() == doctest::Approx(1.0 + kPi));
    CHECK(turn.length() > path.length());
}
