// Contacts of a deformed surface: those that a search of all pairs of faces finds.
#include "kernel/deform/contact/contacts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <vector>

#include "kernel/deform/contact/contact_search.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/models.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

using Pairs = std::vector<FacePair>;

Pairs searched(const Mesh& rest, const std::vector<Vec3>& shape) {
    Mesh moved = rest;
    moved.set_positions(shape);
    const Pairs before = self_intersections(rest), after = self_intersections(moved);
    Pairs added;
    std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                        std::back_inserter(added));
    return added;
}

Vec3 center_of(const Scene& scene, const std::vector<Index>& vertices) {
    Vec3 center = Vec3::Zero();
    for (const Index v : vertices) {
        center += scene.mesh.position(v) / static_cast<double>(vertices.size());
    }
    return center;
}

// The upper end turned and pushed through the lower one.
Affine onto_itself(const Scene& scene, double angle) {
    const Vec3 low = center_of(scene, scene.low), high = center_of(scene, scene.high);
    return translation(1.02 * (low - high)) * rotation(scene.across, angle, high);
}

// Solves with the upper end at `move`, and compares both searches. Returns the number of pairs.
std::size_t compared(const Scene& scene, Edit& edit, const Affine& move) {
    edit.deformer.set_transform(edit.high, move);
    const Pairs expected = searched(scene.mesh, edit.deformer.solve());
    CHECK(contacts_of(edit.deformer, scene.mesh) == expected);
    return expected.size();
}

Mesh bar_of_quads() {
    return make_bar({.width = 1.0, .length = 6.0, .across = 4, .along = 24});
}

Mesh triangulated(Mesh mesh) {
    triangulate(mesh);
    return mesh;
}

// A bar that another bar runs through at rest.
Mesh crossed_bars() {
    Mesh mesh = bar_of_quads();
    const Affine across = rotation(Vec3::UnitX(), 0.5 * kPi, Vec3::Zero());
    append(mesh, moved(make_bar({.width = 0.4, .length = 3.0, .across = 2, .along = 8}), across));
    return mesh;
}

// Each vertex by itself moves a little, by a fixed pattern.
std::vector<Vec3> crumpled(const Mesh& mesh, double depth) {
    std::vector<Vec3> shape(mesh.positions().begin(), mesh.positions().end());
    unsigned state = 1;
    const auto next = [&] {
        state = 1664525U * state + 1013904223U;
        return static_cast<double>(state >> 8U) / (1U << 23U) - 1.0;
    };
    for (Vec3& p : shape) p += depth * Vec3(next(), next(), next());
    return shape;
}

// Compares a search with no parts with that of all pairs. Returns the number of pairs.
std::size_t compare(const Mesh& rest, const std::vector<Vec3>& shape) {
    ContactSearch search(rest.shared_topology(), {rest.positions().begin(), rest.positions().end()},
                         {});
    const Pairs expected = searched(rest, shape);
    CHECK(search.find(shape, std::vector<Index>(shape.size(), kNoIndex), {}) == expected);
    return expected.size();
}

}  // namespace

TEST_CASE("contacts: none at rest, nor after a rigid motion of all handles") {
    const Scene scene = make_scene(make_cactus({.vertices = 3000}));
    Edit edit = make_edit(scene);
    CHECK(contacts_of(edit.deformer, scene.mesh).empty());
    const Affine motion =
        translation({3.0, -2.0, 1.0}) * rotation({1.0, 2.0, 3.0}, 1.3, {0.2, 0.1, 0.0});
    edit.deformer.set_transform(edit.low, motion);
    edit.deformer.set_transform(edit.high, motion);
    edit.deformer.solve();
    CHECK(contacts_of(edit.deformer, scene.mesh).empty());
}

TEST_CASE("contacts are the crossings that appear between all pairs of faces") {
    for (const Mesh& mesh : {bar_of_quads(), triangulated(bar_of_quads()), crossed_bars(),
                             triangulated(make_cactus({.vertices = 2500}))}) {
        const Scene scene = make_scene(mesh);
        DeformOptions options;
        options.loose = UnheldParts::stay;
        Edit edit = make_edit(scene, options);
        std::size_t pairs = 0;
        for (const double angle : {0.3, 1.6, 2.9, 5.5}) {
            pairs += compared(scene, edit, rotation(scene.across, angle, Vec3::Zero()));
            pairs += compared(scene, edit, onto_itself(scene, angle));
        }
        CHECK(pairs > 20);
    }
}

TEST_CASE("contacts of models are those between all pairs of faces") {
    for_each_model([](const Scene& scene) {
        if (scene.mesh.vertex_count() > 4000) return;
        Edit edit = make_edit(scene);
        (void)compared(scene, edit, onto_itself(scene, 1.0));
        (void)compared(scene, edit, rotation(scene.across, 2.0, Vec3::Zero()));
    });
}

TEST_CASE("contacts: scaled, soft and falling handles leave nothing out") {
    const Scene scene = make_scene(bar_of_quads());
    for (const HandleOptions& options :
         {HandleOptions{.weight = 1.0}, HandleOptions{.gradient = false},
          HandleOptions{.position = false}}) {
        Edit edit = make_edit(scene, {}, options);
        edit.deformer.constrain({vertex_point(scene.between(0)), Vec3::Zero()});
        (void)compared(scene, edit, onto_itself(scene, 1.0));
    }
    Edit edit = make_edit(scene);
    const Vec3 middle = center_of(scene, scene.high);
    CHECK(compared(scene, edit, onto_itself(scene, 0.5) * scaling({3.0, 0.4, 1.0}, middle)) > 0);
}

TEST_CASE("contacts: handles that change between solves leave nothing out") {
    const Scene scene = make_scene(bar_of_quads());
    Edit edit = make_edit(scene);
    CHECK(compared(scene, edit, onto_itself(scene, 1.0)) > 0);
    const std::vector<Vec3> shape = edit.deformer.positions();
    // Handles that the shown result knows nothing of.
    set_handle_region(edit.deformer, edit.high, scene.region({scene.between(3), scene.high[0]}));
    CHECK(contacts_of(edit.deformer, scene.mesh) == searched(scene.mesh, shape));
    edit.deformer.remove_handle(edit.high);
    edit.deformer.add_handle(scene.region({scene.between(5)}));
    CHECK(contacts_of(edit.deformer, scene.mesh) == searched(scene.mesh, shape));
    edit.deformer.rebase();
    CHECK(contacts_of(edit.deformer, scene.mesh).empty());
}

TEST_CASE("contacts with what lies outside the region count, wherever that lies by now") {
    Mesh mesh = bar_of_quads();
    const Index count = mesh.vertex_count();
    append(mesh, moved(make_box({.segments = {4, 4, 4}}), translation({2.0, 0.0, 0.0})));
    std::vector<Index> bar(at(count));
    std::iota(bar.begin(), bar.end(), 0);
    const Region region(mesh.shared_topology(), bar);
    Deformer deformer(mesh, region);
    const HandleId all = deformer.add_handle(region);
    deformer.set_transform(all, translation({1.3, 0.0, 0.0}));
    deformer.solve();
    CHECK(!contacts_of(deformer, mesh).empty());
    for (Index v = count; v < mesh.vertex_count(); ++v) {
        mesh.edit_positions()[at(v)] += Vec3(5.0, 0.0, 0.0);
    }
    CHECK(contacts_of(deformer, mesh).empty());
}

TEST_CASE("contacts of crumpled surfaces are those between all pairs of faces") {
    for (const Mesh& mesh : {bar_of_quads(), triangulated(bar_of_quads()), make_grid({}),
                             triangulated(make_grid({})), make_cylinder({}), crossed_bars()}) {
        const double edge =
            (mesh.position(mesh.topology().neighbors(0)[0]) - mesh.position(0)).norm();
        for (const double depth : {0.05, 0.4, 1.5}) {
            const std::size_t pairs = compare(mesh, crumpled(mesh, depth * edge));
            CHECK((pairs > 50 || depth < 1.0));
        }
    }
}

TEST_CASE("contacts: flat folds and surfaces that touch are told from neighbours") {
    Mesh sheet = triangulated(make_grid({.segments = {6, 6}}));
    std::vector<Vec3> shape(sheet.positions().begin(), sheet.positions().end());
    // One half is laid exactly upon the other.
    for (Vec3& p : shape) p.x() = std::abs(p.x());
    CHECK(compare(sheet, shape) > 0);
    // All at one place, or in one line.
    CHECK(compare(sheet, std::vector<Vec3>(shape.size(), Vec3::Ones())) == 0);
    for (Vec3& p : shape) p = Vec3(p.x(), 0.0, 0.0);
    CHECK(compare(sheet, shape) == 0);
}

TEST_CASE("contacts: two bars that touch end to end") {
    Mesh mesh = bar_of_quads();
    append(mesh, moved(bar_of_quads(), translation({0.0, 7.0, 0.0})));
    std::vector<Vec3> shape(mesh.positions().begin(), mesh.positions().end());
    for (const double gap : {0.1, 0.0, -0.1}) {
        for (std::size_t v = shape.size() / 2; v < shape.size(); ++v) {
            shape[v] = mesh.position(index_of(v)) - Vec3(0.01, 1.0 - gap, 0.02);
        }
        CHECK((compare(mesh, shape) > 0) == (gap <= 0.0));
    }
}

TEST_CASE("contacts do not depend on the number of threads, or on the place of the mesh") {
    const Scene scene = make_scene(triangulated(make_cactus({.vertices = 2500})));
    const Vec3 far(1e5, -3e4, 2e4);
    const Scene shifted = make_scene(moved(scene.mesh, translation(far)));
    ContextOptions options;
    options.threads = 2;
    const Context two(options);
    Edit edit = make_edit(scene), away = make_edit(shifted);
    const Affine move = onto_itself(scene, 1.0);
    edit.deformer.set_transform(edit.high, move);
    away.deformer.set_transform(away.high, translation(far) * move * translation(-far));
    edit.deformer.solve();
    away.deformer.solve();
    const Pairs pairs = contacts_of(edit.deformer, scene.mesh);
    CHECK(contacts_of(edit.deformer, scene.mesh, two) == pairs);
    CHECK(std::abs(index_of(contacts_of(away.deformer, shifted.mesh).size()) -
                   index_of(pairs.size())) <= 2);
}

TEST_CASE("contacts: a mesh of another topology, or changed around the region, is refused") {
    const Scene scene = make_scene(bar_of_quads());
    Deformer deformer(scene.mesh, scene.region(scene.high));
    CHECK(error_of([&] { contacts_of(deformer, make_bar({})); }).code() ==
          ErrorCode::topology_mismatch);
    Mesh changed = scene.mesh;
    for (Vec3& p : changed.edit_positions()) p *= 2.0;
    CHECK(error_of([&] { contacts_of(deformer, changed); }).code() == ErrorCode::topology_mismatch);
    CHECK(contacts_of(deformer, scene.mesh).empty());
}
