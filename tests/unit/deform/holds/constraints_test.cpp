// Which constraints a deformation may have: positions, gradients, both; handles and single
// vertices.

#include <Eigen/Geometry>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/first_solution.h"
#include "kernel/deform/stats.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Scene bar_scene() {
    BarOptions options;
    options.across = 4;
    options.along = 20;
    return make_scene(make_bar(options));
}

}  // namespace

TEST_CASE("positions only: handles hold, and a similarity of all is reproduced") {
    const Scene scene = bar_scene();
    HandleOptions positions;
    positions.gradient = false;
    Edit edit = make_edit(scene, {}, positions);
    const Affine rigid = rotation({1, -1, 2}, 1.1, {0, 0, 1});
    edit.deformer.set_transform(edit.low, rigid);
    edit.deformer.set_transform(edit.high, rigid);
    CHECK(max_distance(edit.deformer.solve(), mapped(rest_positions_of(edit.deformer), rigid)) <
          1e-9 * scene.size);

    edit.deformer.set_transform(edit.low, {});
    edit.deformer.set_transform(edit.high, translation({1, 0, 0}));
    edit.deformer.solve();
    for (const Index v : scene.high) {
        CHECK(edit.deformer.positions()[v] == scene.mesh.position(v) + Vec3(1, 0, 0));
    }
}

TEST_CASE("gradients only: the handle turns the surface and its vertices find their place") {
    const Scene scene = bar_scene();
    Deformer d(scene.mesh, scene.all());
    d.add_handle(scene.region(scene.low));
    HandleOptions gradients;
    gradients.position = false;
    const HandleId high = d.add_handle(scene.region(scene.high), gradients);
    d.set_transform(high, rotation(Vec3::UnitX(), 0.7, d.handle(high).center));
    d.solve();
    // The end is turned, but stays attached at its own distance instead of rotating in place.
    const Vec3 rest =
        scene.mesh.position(scene.high.back()) - scene.mesh.position(scene.high.front());
    const Vec3 now = d.positions()[scene.high.back()] - d.positions()[scene.high.front()];
    CHECK(rest.norm() > 0.1);
    CHECK((now - Eigen::AngleAxisd(0.7, Vec3::UnitX()) * rest).norm() < 0.06 * rest.norm());
    CHECK(max_distance(d.solve(FrameQuality::preview), solve_first_directly(d)) <
          1e-11 * scene.size);
}

TEST_CASE("vertex constraints: exact positions, and rest again when they go") {
    const Scene scene = bar_scene();
    Deformer d(scene.mesh, scene.all());
    d.add_handle(scene.region(scene.low));
    const Index tip = scene.high.back();
    const Vec3 target = scene.mesh.position(tip) + Vec3(0.5, 0.2, -0.1);
    d.constrain(VertexConstraint{tip, target, {}});
    CHECK(d.solve()[tip] == target);
    CHECK(max_distance(d.solve(FrameQuality::preview), solve_first_directly(d)) <
          1e-11 * scene.size);

    const Index count = stats_of(d).factorizations;
    d.constrain(VertexConstraint{tip, target + Vec3(0.1, 0, 0), {}});
    CHECK(d.solve()[tip] == target + Vec3(0.1, 0, 0));
    CHECK(stats_of(d).factorizations == count);

    d.constrain(VertexConstraint{tip, {}, {}});
    CHECK(d.solve() == rest_positions_of(d));
}

TEST_CASE("vertex constraints: many of them do what a handle does") {
    const Scene scene = bar_scene();
    Edit edit = make_edit(scene);
    const Affine move = bend(scene, edit.deformer.handle(edit.high).center);
    edit.deformer.set_transform(edit.high, move);

    Deformer d(scene.mesh, scene.all());
    d.add_handle(scene.region(scene.low));
    for (const Index v : scene.high)
        d.constrain(VertexConstraint{v, move(scene.mesh.position(v)), move.linear});
    CHECK(max_distance(d.solve(FrameQuality::preview), edit.deformer.solve(FrameQuality::preview)) <
          1e-10 * scene.size);
    CHECK(max_distance(d.solve(), edit.deformer.solve()) < 1e-10 * scene.size);
}

TEST_CASE("vertex constraints: with handles that move, and with gradients alone") {
    const Scene scene = bar_scene();
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    const Index middle = scene.mesh.vertex_count() / 2;
    d.constrain(VertexConstraint{
        middle, {}, Mat3(Eigen::AngleAxisd(0.8, Vec3::UnitY()).toRotationMatrix())});
    d.set_transform(edit.high, translation({0.4, 0, 0}));
    CHECK(max_distance(d.solve(FrameQuality::preview), solve_first_directly(d)) <
          1e-11 * scene.size);
    d.solve();
    CHECK((gradients_of(d)[middle] - Mat3(Eigen::AngleAxisd(0.8, Vec3::UnitY()))).norm() < 1e-12);
    for (const Index v : scene.low) CHECK(d.positions()[v] == scene.mesh.position(v));
}

TEST_CASE("vertex constraints: where the surface lies by itself they hardly bend it") {
    const Scene scene = bar_scene();
    Edit free = make_edit(scene), held = make_edit(scene);
    const Index middle = scene.mesh.vertex_count() / 2;
    const Vec3 shift(0.3, 0, 0.1);
    // Up to where the field of turns takes over.
    for (const double angle : {0.5, 1.0, 1.5, 2.0}) {
        CAPTURE(angle);
        const Vec3 center = free.deformer.handle(free.high).center;
        const Affine move = translation(shift) * rotation(scene.mesh.position(scene.high.back()) -
                                                              scene.mesh.position(scene.low.back()),
                                                          angle, center);
        free.deformer.set_transform(free.high, move);
        held.deformer.set_transform(held.high, move);
        const std::vector<Vec3> expected = free.deformer.solve();
        held.deformer.constrain(VertexConstraint{middle, expected[middle], {}});
        const double off = max_distance(held.deformer.solve(), expected) / scene.size;
        CHECK(off < 0.03);
    }
}

TEST_CASE("several handles: each holds, in any order of adding") {
    const Scene scene = bar_scene();
    const Region low = scene.region(scene.low), high = scene.region(scene.high);
    const Region middle = select_box(scene.mesh, {Vec3(-9, -0.2, -9), Vec3(9, 0.2, 9)});
    const Affine lift = translation({0.5, 0.0, 0.2}),
                 turn = rotation(Vec3::UnitY(), 1.0, Vec3::Zero());
    std::vector<std::vector<Vec3>> results;
    for (const bool reversed : {false, true}) {
        Deformer d(scene.mesh, scene.all());
        std::vector<std::pair<Region, Affine>> handles{{low, {}}, {middle, lift}, {high, turn}};
        if (reversed) std::reverse(handles.begin(), handles.end());
        for (const auto& [region, transform] : handles)
            d.set_transform(d.add_handle(region), transform);
        results.push_back(d.solve());
    }
    CHECK(max_distance(results[0], results[1]) < 1e-9 * scene.size);
    for (const Index v : middle.vertices()) CHECK(results[0][v] == lift(scene.mesh.position(v)));
}

TEST_CASE("components: each is held by its own handle and does not feel the other") {
    Mesh a = make_sphere(), b = make_torus();
    std::vector<Vec3> positions(a.positions().begin(), a.positions().end());
    FaceList faces = a.topology().faces();
    for (const Vec3& p : b.positions()) positions.push_back(p + Vec3(5, 0, 0));
    for (Index f = 0; f < b.face_count(); ++f) {
        std::vector<Index> face;
        for (const Index v : b.topology().face(f)) face.push_back(v + a.vertex_count());
        faces.add(face);
    }
    const Mesh both(positions, faces);
    Deformer d(both, Region::all(both.shared_topology()));
    const auto near = [&](const Vec3& p) { return select_sphere(both, p, 0.4); };
    d.add_handle(near({0, 1, 0}));
    const HandleId pulled = d.add_handle(near({0, -1, 0}));
    d.add_handle(near({6.1, 0, 0}));
    d.set_transform(pulled, translation({0, -1, 0}));
    d.solve();
    double moved = 0.0;
    for (Index v = a.vertex_count(); v < both.vertex_count(); ++v) {
        moved = std::max(moved, (d.positions()[v] - both.position(v)).norm());
    }
    CHECK(moved < 1e-11);
    CHECK(max_distance(d.positions(), rest_positions_of(d)) > 0.9);
}

TEST_CASE("open boundaries: a sheet bends, whatever hangs over its rim") {
    GridOptions options;
    options.size = {4.0, 1.0};
    options.segments = {32, 8};
    const Scene scene = make_scene(make_grid(options));
    for (const SecondSystem second :
         {SecondSystem::blend, SecondSystem::laplacian, SecondSystem::poisson}) {
        DeformOptions chosen;
        chosen.second = second;
        Edit edit = make_edit(scene, chosen);
        edit.deformer.set_transform(
            edit.high, translation({-1.0, 1.2, 0.0}) * rotation(Vec3::UnitZ(), 1.2, {1.9, 0, 0}));
        const std::vector<Vec3>& x = edit.deformer.solve();
        for (const Vec3& p : x) {
            CHECK(p.allFinite());
            // Straight rows across the sheet stay so: no rippling of the free rims.
            CHECK(p.norm() < 4.0);
        }
        double worst = 0.0;
        for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
            for (const Index n : scene.mesh.topology().neighbors(v)) {
                const double rest = (scene.mesh.position(v) - scene.mesh.position(n)).norm();
                worst = std::max(worst, std::abs((x[v] - x[n]).norm() / rest - 1.0));
            }
        }
        CHECK(worst < 0.6);
    }
}

TEST_CASE("vertices without faces: rest, unless a handle takes them along") {
    Mesh box = make_box();
    std::vector<Vec3> positions(box.positions().begin(), box.positions().end());
    positions.emplace_back(9, 9, 9);
    positions.emplace_back(8, 8, 8);
    const Mesh mesh(positions, box.topology().faces());
    Deformer d(mesh, Region::all(mesh.shared_topology()));
    d.add_handle({mesh.shared_topology(), {0, 1}});
    const HandleId handle = d.add_handle({mesh.shared_topology(), {7, mesh.vertex_count() - 1}});
    d.set_transform(handle, translation({1, 0, 0}));
    d.solve();
    CHECK(d.positions()[mesh.vertex_count() - 2] == Vec3(9, 9, 9));
    CHECK(d.positions()[mesh.vertex_count() - 1] == Vec3(9, 8, 8));
}
