// A deformation as plain data: it comes back to the bit, and what makes no sense is refused.

#include "kernel/deform/description.h"

#include <array>
#include <limits>

#include "kernel/deform/handle_changes.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A bar with all that can be held: ends, a removed handle, a mirrored pair, points, stiffness.
struct Held {
    Scene scene = make_scene(make_bar({.width = 1.0, .length = 5.0, .across = 4, .along = 20}));
    Edit edit = make_edit(scene);
    HandleId side, image, points;

    Held() {
        Deformer& d = edit.deformer;
        const HandleId gone = d.add_handle(select_sphere(scene.mesh, {0.5, 1.0, 0.0}, 0.3));
        side = d.add_handle(select_sphere(scene.mesh, {0.5, 0.0, 0.0}, 0.3), {.weight = 3.0});
        image = mirror_handle(d, side, {Vec3::Zero(), Vec3::UnitX(), 0.0});
        d.remove_handle(gone);
        const Index face = face_at({0.0, 1.0, 0.5});
        const MeshPoint middle =
            face_point(scene.mesh.topology(), face, std::array{0.25, 0.25, 0.25, 0.25});
        points = d.add_handle(std::span(&middle, 1), {.gradient = false});
        const Index v = vertex_at({0.0, -1.0, 0.5});
        d.constrain(VertexConstraint{v, scene.mesh.position(v) + Vec3(0.0, 0.0, 0.1), {}});
        set_stiffness(d, select_sphere(scene.mesh, {0.0, -0.5, 0.0}, 0.8), 7.0);
        d.set_transform(edit.high, bend(scene, d.handle(edit.high).center));
        d.set_transform(side, translation({0.1, 0.0, 0.0}));
    }

    DeformDescription described() { return describe(edit.deformer.snapshot()); }
    std::shared_ptr<const RestShape> rest() const { return rest_of(edit.deformer); }
    ErrorCode refused(const DeformDescription& description) const {
        return error_of([&] { snapshot_of(description, rest()); }).code();
    }

  private:
    Index vertex_at(const Vec3& at) const {
        Index best = 0;
        for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
            if ((scene.mesh.position(v) - at).norm() < (scene.mesh.position(best) - at).norm()) {
                best = v;
            }
        }
        return best;
    }
    Index face_at(const Vec3& at) const {
        return scene.mesh.topology().faces_around(vertex_at(at)).front();
    }
};

void check_same(const DeformDescription& a, const DeformDescription& b) {
    REQUIRE(a.handles.size() == b.handles.size());
    for (std::size_t h = 0; h < a.handles.size(); ++h) {
        REQUIRE(a.handles[h].has_value() == b.handles[h].has_value());
        if (!a.handles[h]) continue;
        CHECK(a.handles[h]->vertices == b.handles[h]->vertices);
        CHECK(a.handles[h]->points == b.handles[h]->points);
        CHECK(a.handles[h]->options.weight == b.handles[h]->options.weight);
        CHECK(a.handles[h]->options.gradient == b.handles[h]->options.gradient);
        CHECK(a.handles[h]->pose == b.handles[h]->pose);
        REQUIRE(a.handles[h]->partner.has_value() == b.handles[h]->partner.has_value());
        if (a.handles[h]->partner)
            CHECK(a.handles[h]->partner->value == b.handles[h]->partner->value);
    }
    REQUIRE(a.constraints.size() == b.constraints.size());
    for (std::size_t t = 0; t < a.constraints.size(); ++t) {
        CHECK(a.constraints[t].point == b.constraints[t].point);
        CHECK(a.constraints[t].position == b.constraints[t].position);
        CHECK(a.constraints[t].gradient.has_value() == b.constraints[t].gradient.has_value());
    }
    CHECK(a.stiffness == b.stiffness);
    CHECK(a.bones == b.bones);
}

}  // namespace

TEST_CASE("description: what it makes is described alike, and deforms alike to the bit") {
    Held held;
    const DeformDescription given = held.described();
    CHECK(given.handles.size() == 6);
    CHECK(!given.handles[2]);
    const DeformSnapshot made = snapshot_of(given, held.rest());
    check_same(describe(made), given);
    const std::vector<Vec3> before = held.edit.deformer.solve();
    held.edit.deformer.restore(made);
    CHECK(held.edit.deformer.solve() == before);
    for (const HandleId h : {held.edit.low, held.edit.high, held.side, held.image, held.points}) {
        CHECK(held.edit.deformer.handle(h).center == Held().edit.deformer.handle(h).center);
    }
    CHECK(held.edit.deformer.handle(held.side).image->value == held.image.value);
}

TEST_CASE("description: vertices that two handles hold are named, each once") {
    Held held;
    DeformDescription twice = held.described();
    const std::vector<Index> shared = {twice.handles[0]->vertices[0],
                                       twice.handles[0]->vertices[2]};
    twice.handles[1]->vertices.insert(twice.handles[1]->vertices.end(), shared.begin(),
                                      shared.end());
    const Error error = error_of([&] { snapshot_of(twice, held.rest()); });
    CHECK(error.code() == ErrorCode::handle_overlap);
    CHECK(error.elements().kind == ElementKind::vertex);
    CHECK(error.elements().count == 2);
    CHECK(error.elements().ids == shared);
}

TEST_CASE("description: bones are described and made again, and bad ones refused") {
    Held held;
    DeformDescription good = held.described();
    good.bones = {
        {{{0, -1, 0}, {0, 0, 0}, {0, 1, 0}}, {0.5, 1.0}, {held.edit.low, held.edit.high}}};
    check_same(describe(snapshot_of(good, held.rest())), good);
    const auto refused = [&](const auto& spoil) {
        DeformDescription bad = good;
        spoil(bad.bones);
        return held.refused(bad);
    };
    CHECK(refused([](auto& b) { b[0].limits.pop_back(); }) == ErrorCode::invalid_argument);
    CHECK(refused([](auto& b) { b[0].limits[0] = 4.0; }) == ErrorCode::invalid_argument);
    CHECK(refused([](auto& b) { b[0].joints.pop_back(); }) == ErrorCode::invalid_argument);
    CHECK(refused([](auto& b) { b[0].joints[1] = b[0].joints[0]; }) == ErrorCode::invalid_argument);
    CHECK(refused([](auto& b) { b[0].joints[1].x() = NAN; }) == ErrorCode::not_finite);
    CHECK(refused([](auto& b) { b.push_back(b[0]); }) == ErrorCode::invalid_argument);
    CHECK(refused([](auto& b) { b[0].handles[0] = b[0].handles[1]; }) ==
          ErrorCode::invalid_argument);
    for (const Index other : {-5, 2, 99}) {
        CHECK(refused([&](auto& b) { b[0].handles[1] = HandleId{other}; }) ==
              ErrorCode::handle_removed);
    }
}

TEST_CASE("description: partners must be each other's") {
    Held held;
    const DeformDescription good = held.described();
    const auto with_partner = [&](std::size_t handle, std::optional<HandleId> partner) {
        DeformDescription bad = good;
        bad.handles[handle]->partner = partner;
        return held.refused(bad);
    };
    REQUIRE(good.handles[3]->partner->value == 4);
    for (const Index other : {-5, 0, 2, 3, 5, 6, 99}) {
        CAPTURE(other);
        CHECK(with_partner(3, HandleId{other}) == ErrorCode::invalid_argument);
    }
    CHECK(with_partner(3, {}) == ErrorCode::invalid_argument);
    CHECK(with_partner(0, HandleId{1}) == ErrorCode::invalid_argument);
}

TEST_CASE("description: bad poses, stiffness, weights and vertices are refused") {
    Held held;
    const DeformDescription good = held.described();
    const auto changed = [&](const auto& change) {
        DeformDescription bad = good;
        change(bad);
        return held.refused(bad);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(changed([](auto& d) { d.handles[0]->pose.transform.linear.setZero(); }) ==
          ErrorCode::singular_transform);
    CHECK(changed([=](auto& d) { d.handles[0]->pose.transform.translation.x() = nan; }) ==
          ErrorCode::singular_transform);
    CHECK(changed([=](auto& d) { d.handles[0]->pose.local_transform.linear(1, 1) = nan; }) ==
          ErrorCode::singular_transform);
    CHECK(changed([=](auto& d) { d.handles[0]->pose.turn.z() = nan; }) ==
          ErrorCode::singular_transform);
    CHECK(changed([](auto& d) { d.stiffness.pop_back(); }) == ErrorCode::invalid_argument);
    for (const double factor : {0.5e-4, 2e5, nan}) {
        CHECK(changed([=](auto& d) { d.stiffness[3] = factor; }) == ErrorCode::invalid_argument);
    }
    for (const double factor : {1e-4, 1e5}) {
        DeformDescription fine = good;
        fine.stiffness[3] = factor;
        CHECK(describe(snapshot_of(fine, held.rest())).stiffness == fine.stiffness);
    }
    CHECK(changed([](auto& d) { d.handles[0]->vertices.clear(); }) == ErrorCode::region_empty);
    CHECK(changed([](auto& d) { d.handles[0]->vertices[0] = -1; }) == ErrorCode::out_of_range);
    CHECK(changed([](auto& d) {
              d.handles[0]->options.position = d.handles[0]->options.gradient = false;
          }) == ErrorCode::invalid_argument);
    CHECK(changed([](auto& d) { d.handles[5]->points[0].weights[0] = 0.7; }) ==
          ErrorCode::invalid_argument);
}

TEST_CASE("description: a handle that reaches out of its region is refused by name") {
    const Scene scene =
        make_scene(make_bar({.width = 1.0, .length = 5.0, .across = 4, .along = 20}));
    Deformer d(scene.mesh, select_plane(scene.mesh, Vec3::Zero(), Vec3::UnitY()));
    d.add_handle(scene.region(scene.high));
    DeformDescription given = describe(d.snapshot());
    given.handles[0]->vertices.push_back(scene.low[1]);
    const Error error = error_of([&] { snapshot_of(given, rest_of(d)); });
    CHECK(error.code() == ErrorCode::handle_outside_region);
    CHECK(error.elements().count == 1);
    CHECK(error.elements().ids == std::vector<Index>{scene.low[1]});
}
