// Solves that push apart parts which would run through one another.
#include "kernel/deform/contact/contact_avoid.h"

#include <Eigen/Geometry>
#include <vector>

#include "kernel/deform/contact/contacts.h"
#include "kernel/deform/deform_report.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Scene long_bar() {
    return make_scene(make_bar({.width = 1.0, .length = 8.0, .across = 8, .along = 64}));
}

// The upper end bends over by nearly half a turn and comes to lie so far beside the lower one.
Affine beside(const Scene& scene, double apart) {
    const Box box = bounds(scene.mesh);
    const Vec3 top(0.0, box.max.y(), 0.0);
    return translation({-apart, -0.6 * (box.max.y() - box.min.y()), 0.0}) *
           rotation(Vec3::UnitZ(), 3.1, top);
}

std::size_t contacts_left(const AvoidedContacts& result) {
    return result.contacts.size();
}

}  // namespace

TEST_CASE("avoid: a free result is that of solve to the bit") {
    const Scene scene = long_bar();
    Edit avoiding = make_edit(scene), solved = make_edit(scene);
    for (const double angle : {0.0, 0.4, 1.1, -0.3}) {
        for (Edit* edit : {&avoiding, &solved}) {
            edit->deformer.set_transform(edit->high, bend(scene, Vec3::Zero(), angle));
        }
        const AvoidedContacts result = solve_avoiding_contacts(avoiding.deformer, scene.mesh);
        CHECK(result.before == 0);
        CHECK(result.rounds == 0);
        CHECK(avoiding.deformer.positions() == solved.deformer.solve());
    }
}

TEST_CASE("avoid: two ends that are laid into one another part, and handles stay") {
    const Scene scene = long_bar();
    Edit edit = make_edit(scene), plain = make_edit(scene);
    edit.deformer.set_transform(edit.high, beside(scene, 0.2));
    plain.deformer.set_transform(plain.high, beside(scene, 0.2));
    const std::vector<Vec3> through = plain.deformer.solve();
    const AvoidedContacts result = solve_avoiding_contacts(edit.deformer, scene.mesh);
    REQUIRE(result.before > 20);
    CHECK(result.rounds >= 1);
    CHECK(10 * contacts_left(result) <= at(result.before));
    CHECK(contacts_of(edit.deformer, scene.mesh) == result.contacts);
    for (const std::vector<Index>* held : {&scene.low, &scene.high}) {
        for (const Index v : *held) CHECK(edit.deformer.positions()[at(v)] == through[at(v)]);
    }
    const DeformReport pushed = report_of(edit.deformer, scene.mesh),
                       before = report_of(plain.deformer, scene.mesh);
    CHECK(pushed.stretch < 1.2 * before.stretch);
    CHECK(pushed.flipped.empty());
}

TEST_CASE("avoid: on a whole way through one another, never more contacts than without") {
    const Scene scene = long_bar();
    Edit edit = make_edit(scene), plain = make_edit(scene);
    for (double apart = 1.0; apart > -1.6; apart -= 0.2) {
        CAPTURE(apart);
        edit.deformer.set_transform(edit.high, beside(scene, apart));
        plain.deformer.set_transform(plain.high, beside(scene, apart));
        const AvoidedContacts result = solve_avoiding_contacts(edit.deformer, scene.mesh);
        const std::vector<Vec3> through = plain.deformer.solve();
        CHECK(contacts_of(plain.deformer, scene.mesh).size() == at(result.before));
        CHECK(contacts_left(result) <= at(result.before));
        const bool pushed = 3 * contacts_left(result) <= 2 * at(result.before);
        if (!pushed || result.before == 0) CHECK(edit.deformer.positions() == through);
    }
}

TEST_CASE("avoid: wherever the mesh lies, and however large it is") {
    const Scene scene = long_bar();
    Edit edit = make_edit(scene);
    edit.deformer.set_transform(edit.high, beside(scene, 0.2));
    REQUIRE(solve_avoiding_contacts(edit.deformer, scene.mesh).before > 20);
    const Affine placed = translation({300.0, -200.0, 100.0}) *
                          rotation(Vec3(1.0, 2.0, 3.0).normalized(), 1.0, Vec3::Zero()) *
                          Affine{100.0 * Mat3::Identity(), Vec3::Zero()};
    Scene moved = scene;
    std::vector<Vec3> places;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        places.push_back(placed(scene.mesh.position(v)));
    }
    moved.mesh.set_positions(std::move(places));
    Edit other = make_edit(moved);
    other.deformer.set_transform(other.high, conjugated(beside(scene, 0.2), placed));
    const AvoidedContacts result = solve_avoiding_contacts(other.deformer, moved.mesh);
    CHECK(10 * contacts_left(result) <= at(result.before));
    double apart = 0.0;
    for (std::size_t v = 0; v < edit.deformer.positions().size(); ++v) {
        const Vec3 expected = placed(edit.deformer.positions()[v]);
        apart = std::max(apart, (other.deformer.positions()[v] - expected).norm());
    }
    CHECK(apart < 1e-3 * 100.0 * scene.size);
}

TEST_CASE("avoid: after an error nothing has moved") {
    const Scene scene = long_bar();
    const Context context;
    Edit edit = make_edit(scene);
    edit.deformer.solve();
    const std::vector<Vec3> before = edit.deformer.positions();
    edit.deformer.set_transform(edit.high, beside(scene, 0.2));
    CHECK(error_of([&] { solve_avoiding_contacts(edit.deformer, make_bar({})); }).code() ==
          ErrorCode::topology_mismatch);
    context.cancel();
    CHECK(error_of([&] { solve_avoiding_contacts(edit.deformer, scene.mesh, context); }).code() ==
          ErrorCode::cancelled);
    CHECK(edit.deformer.positions() == before);
}
