#include "kernel/deform/deformer.h"

#include <Eigen/Geometry>
#include <cmath>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/first_solution.h"
#include "kernel/deform/handle_basis.h"
#include "kernel/deform/stats.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/deform/thesis_options.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

std::vector<DeformOptions> formulations() {
    std::vector<DeformOptions> list(6);
    list[1].second = SecondSystem::laplacian;
    list[2].second = SecondSystem::poisson;
    list[3].local_size = LocalSize::scale;
    list[4].weights = LaplacianWeights::uniform;
    list[5] = test::thesis_or_default();
    return list;
}

Scene plain_bar() {
    BarOptions options;
    options.across = 5;
    options.along = 25;
    return make_scene(make_bar(options));
}

}  // namespace

TEST_CASE("at rest: the result is the rest shape to the bit, in every formulation") {
    const Scene scene = plain_bar();
    for (const DeformOptions& options : formulations()) {
        Edit edit = make_edit(scene, options);
        CHECK(edit.deformer.solve(FrameQuality::preview) == rest_positions_of(edit.deformer));
        CHECK(edit.deformer.solve() == rest_positions_of(edit.deformer));
        CHECK(solve_first_directly(edit.deformer).size() ==
              rest_positions_of(edit.deformer).size());
        CHECK(max_distance(solve_first_directly(edit.deformer), rest_positions_of(edit.deformer)) <
              1e-11 * scene.size);
    }
}

TEST_CASE("drag there and back: rest to the bit") {
    const Scene scene = plain_bar();
    Edit edit = make_edit(scene);
    const Vec3 center = edit.deformer.handle(edit.high).center;
    Affine transform;
    for (const double angle : {0.3, 0.7, -0.2, -0.8}) {
        transform = rotation({1, 2, 3}, angle, center) * transform;
        edit.deformer.set_transform(edit.high, transform);
        edit.deformer.solve();
    }
    CHECK(edit.deformer.positions() == rest_positions_of(edit.deformer));

    edit.deformer.set_transform(edit.high, bend(scene, center));
    edit.deformer.solve();
    CHECK(edit.deformer.positions() != rest_positions_of(edit.deformer));
    edit.deformer.reset();
    CHECK(edit.deformer.positions() == rest_positions_of(edit.deformer));
    CHECK(edit.deformer.solve() == rest_positions_of(edit.deformer));
}

TEST_CASE("handles are hard: their vertices go where they were sent, to the bit") {
    const Scene scene = plain_bar();
    for (const DeformOptions& options : formulations()) {
        Edit edit = make_edit(scene, options);
        const Affine move = bend(scene, edit.deformer.handle(edit.high).center);
        edit.deformer.set_transform(edit.high, move);
        edit.deformer.solve();
        for (const Index v : scene.high) {
            CHECK(edit.deformer.positions()[v] == move(scene.mesh.position(v)));
        }
        for (const Index v : scene.low) {
            CHECK(edit.deformer.positions()[v] == scene.mesh.position(v));
        }
    }
}

TEST_CASE("handle basis: equal to the direct solve, and its rows reproduce the preview") {
    const Scene scene = plain_bar();
    for (const DeformOptions& options : formulations()) {
        Edit edit = make_edit(scene, options);
        Deformer& d = edit.deformer;
        d.set_transform(edit.high, bend(scene, d.handle(edit.high).center, 1.3));
        d.set_transform(edit.low, scaling({1.1, 0.9, 1.2}, {0, 1, 0}));
        const std::vector<Vec3> preview = d.solve(FrameQuality::preview);
        CHECK(max_distance(preview, solve_first_directly(d)) < 1e-11 * scene.size);

        const HandleBasis basis = basis_of(d);
        std::vector<Vec3> evaluated = basis.fixed;
        for (std::size_t h = 0; h < basis.handles.size(); ++h) {
            const Affine& t = d.pose(basis.handles[h]).transform;
            for (std::size_t i = 0; i < evaluated.size(); ++i) {
                const Vec4& w = basis.weights[h][i];
                evaluated[i] += t.linear * w.head<3>() + t.translation * w[3];
            }
        }
        CHECK(max_distance(preview, evaluated) < 1e-11 * scene.size);
    }
}

TEST_CASE("first system: one affine map for all handles maps the whole surface") {
    const Scene scene = plain_bar();
    Affine map;
    map.linear << 1.2, 0.3, -0.4, 0.1, 0.7, 0.5, -0.6, 0.2, 1.5;
    map.translation = {3.0, -2.0, 1.0};
    for (const DeformOptions& options : formulations()) {
        Edit edit = make_edit(scene, options);
        edit.deformer.set_transform(edit.low, map);
        edit.deformer.set_transform(edit.high, map);
        CHECK(max_distance(edit.deformer.solve(FrameQuality::preview),
                           mapped(rest_positions_of(edit.deformer), map)) < 1e-11 * scene.size);
    }
}

TEST_CASE("similarity: one rigid motion for all handles, or with scaled details one similarity") {
    const Scene scene = plain_bar();
    const Affine rigid = rotation({1, 2, 3}, 2.0, {5, 0, 0});
    Affine similar = rigid;
    similar.linear *= 1.7;
    for (const DeformOptions& options : formulations()) {
        const bool scales = options.local_size == LocalSize::scale;
        Edit edit = make_edit(scene, options);
        const Affine& map = scales ? similar : rigid;
        edit.deformer.set_transform(edit.low, map);
        edit.deformer.set_transform(edit.high, map);
        CHECK(max_distance(edit.deformer.solve(), mapped(rest_positions_of(edit.deformer), map)) <
              1e-9 * scene.size);
    }
}

TEST_CASE("region of interest: nothing moves outside it") {
    const Scene scene = plain_bar();
    Mesh mesh = scene.mesh;
    const Region region = select_box(mesh, {Vec3(-9, -0.2, -9), Vec3(9, 9, 9)});
    const Region top = select_box(mesh, {Vec3(-9, 2.2, -9), Vec3(9, 9, 9)});
    Deformer deformer(mesh, region);
    const HandleId handle = deformer.add_handle(top);
    deformer.set_transform(handle, rotation(Vec3::UnitX(), 0.8, deformer.handle(handle).center));
    deformer.solve();
    deformer.apply_to(mesh);
    Index moved = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.position(v) == scene.mesh.position(v)) continue;
        CHECK(region.contains(v));
        ++moved;
    }
    CHECK(moved > region.size() / 2);
}

TEST_CASE(
    "region of interest: a free patch within a moving surrounding is what a handle-less solve "
    "gives") {
    const Scene scene = plain_bar();
    Deformer deformer(scene.mesh, select_box(scene.mesh, {Vec3(-9, -0.5, -9), Vec3(9, 0.5, 9)}));
    CHECK(deformer.solve() == rest_positions_of(deformer));
}

TEST_CASE("shear: the second system leaves less stretch than the first") {
    const Scene scene = plain_bar();
    const auto max_stretch = [&](const std::vector<Vec3>& x) {
        double greatest = 0.0;
        for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
            for (const Index n : scene.mesh.topology().neighbors(v)) {
                const double rest = (scene.mesh.position(v) - scene.mesh.position(n)).norm();
                greatest = std::max(greatest, std::abs((x[v] - x[n]).norm() / rest - 1.0));
            }
        }
        return greatest;
    };
    for (const DeformOptions& options : formulations()) {
        if (options.local_size == LocalSize::scale) continue;
        Edit edit = make_edit(scene, options);
        Deformer& d = edit.deformer;
        d.set_transform(edit.high, rotation(Vec3::UnitY(), 2.0, d.handle(edit.high).center));
        const double first = max_stretch(d.solve(FrameQuality::preview));
        const double second = max_stretch(d.solve());
        CHECK(second < first);
    }
}

TEST_CASE("translation turns details: the method finds rotations that no handle was given") {
    const Scene scene = plain_bar();
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    d.set_transform(edit.high, translation({4.0, 0.0, 0.0}));
    d.solve();
    // Half way up, the bar leans towards the handle: its axis has turned about z.
    const Index middle = scene.mesh.vertex_count() / 2;
    const Vec3 up = gradients_of(d)[middle] * Vec3::UnitY();
    CHECK(std::atan2(up.x(), up.y()) > 0.3);
}

TEST_CASE("factors: a drag adds none, a new handle adds one") {
    const Scene scene = plain_bar();
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    d.solve();
    CHECK(stats_of(d).factorizations == 1);
    for (int i = 1; i < 5; ++i) {
        d.set_transform(edit.high, rotation(Vec3::UnitX(), 0.1 * i, Vec3::Zero()));
        d.solve();
    }
    CHECK(stats_of(d).factorizations == 1);
    d.remove_handle(edit.high);
    d.add_handle(scene.region({scene.high.front()}));
    d.solve();
    CHECK(stats_of(d).factorizations == 2);
}

TEST_CASE("stats: sizes add up") {
    const Scene scene = plain_bar();
    Edit edit = make_edit(scene);
    edit.deformer.prepare();
    const DeformStats& s = stats_of(edit.deformer);
    CHECK(s.region_vertices == scene.mesh.vertex_count());
    CHECK(s.constrained_vertices == static_cast<Index>(scene.low.size() + scene.high.size()));
    CHECK(s.free_vertices + s.constrained_vertices == s.region_vertices);
    CHECK(s.handles == 2);
    CHECK(s.displaced_vertices == 0);
    CHECK(s.extended_vertices > 0);
    CHECK(s.factor_bytes > 0);
}

TEST_CASE("one-shot function: the same as a deformer") {
    const Scene scene = plain_bar();
    Edit edit = make_edit(scene);
    const Affine move = bend(scene, edit.deformer.handle(edit.high).center);
    edit.deformer.set_transform(edit.high, move);
    edit.deformer.solve();

    Mesh mesh = scene.mesh;
    const std::vector<HandleMove> moves{{scene.region(scene.low), {}, {}},
                                        {scene.region(scene.high), move, {}}};
    deform(mesh, scene.all(), moves);
    const std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    CHECK(positions == edit.deformer.positions());
}

TEST_CASE("normals: custom normals turn with the surface, from the rest shape each time") {
    Scene scene = plain_bar();
    Attribute normals{"normal", Domain::corner, 3, ScalarType::float32, {}};
    for (Index c = 0; c < scene.mesh.topology().corner_count(); ++c) {
        normals.values.insert(normals.values.end(), {0.0, 0.6, 0.8});
    }
    scene.mesh.attributes().add(normals);
    Mesh mesh = scene.mesh;
    Edit edit = make_edit(scene);
    const Affine turn = rotation(Vec3::UnitX(), 1.1, edit.deformer.handle(edit.high).center);
    edit.deformer.set_transform(edit.high, turn);
    for (int twice = 0; twice < 2; ++twice) {
        edit.deformer.solve();
        edit.deformer.apply_to(mesh);
        const Attribute& n = *mesh.attributes().find("normal");
        const Index face = mesh.topology().faces_around(scene.high.back())[0];
        const auto around = mesh.topology().face(face);
        const auto at = std::find(around.begin(), around.end(), scene.high.back()) - around.begin();
        const auto value = n.at(mesh.topology().first_corner(face) + static_cast<Index>(at));
        CHECK((Vec3(value[0], value[1], value[2]) - turn.linear * Vec3(0.0, 0.6, 0.8)).norm() <
              1e-12);
    }
    edit.deformer.reset();
    edit.deformer.apply_to(mesh);
    CHECK(mesh.attributes().find("normal")->values == normals.values);
}

TEST_CASE("directions: tangents and what morph targets add turn as the surface does") {
    Scene scene = plain_bar();
    Attribute morph{"morph.1.position", Domain::vertex, 3, ScalarType::float32, {}};
    Attribute tangent{"tangent", Domain::vertex, 4, ScalarType::float32, {}};
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        morph.values.insert(morph.values.end(), {0.0, 2.0, 0.0});
        tangent.values.insert(tangent.values.end(), {0.0, 0.0, 1.0, -1.0});
    }
    scene.mesh.attributes().add(morph);
    scene.mesh.attributes().add(tangent);
    Mesh mesh = scene.mesh;
    Edit edit = make_edit(scene);
    const Affine turn = rotation(Vec3::UnitX(), 0.7, edit.deformer.handle(edit.high).center);
    edit.deformer.set_transform(edit.high, turn);
    edit.deformer.solve();
    edit.deformer.apply_to(mesh);
    const auto m = mesh.attributes().find("morph.1.position")->at(scene.high.back());
    const auto t = mesh.attributes().find("tangent")->at(scene.high.back());
    CHECK((Vec3(m[0], m[1], m[2]) - turn.linear * Vec3(0.0, 2.0, 0.0)).norm() < 1e-12);
    CHECK((Vec3(t[0], t[1], t[2]) - turn.linear * Vec3::UnitZ()).norm() < 1e-12);
    CHECK(t[3] == -1.0);
    edit.deformer.reset();
    edit.deformer.apply_to(mesh);
    CHECK(mesh.attributes().find("morph.1.position")->values == morph.values);
}

TEST_CASE("threads: the result does not depend on their number") {
    const Scene scene = plain_bar();
    std::vector<std::vector<Vec3>> results;
    for (const int threads : {1, 2, 3}) {
        ContextOptions options;
        options.threads = threads;
        const Context context(options);
        Edit edit = make_edit(scene);
        edit.deformer.set_transform(edit.high, bend(scene, edit.deformer.handle(edit.high).center));
        results.push_back(edit.deformer.solve(FrameQuality::full, context));
    }
    CHECK(results[0] == results[1]);
    CHECK(results[0] == results[2]);
}

TEST_CASE("quads deform nearly as their triangulation") {
    const Scene scene = plain_bar();
    FaceList faces;
    const Triangulation t = triangulate_faces(scene.mesh.topology(), scene.mesh.positions());
    for (const Triangle& triangle : t.triangles) faces.add(triangle);
    const Mesh triangles({scene.mesh.positions().begin(), scene.mesh.positions().end()}, faces);
    const Scene other = make_scene(triangles);
    Edit a = make_edit(scene), b = make_edit(other);
    const Affine move = bend(scene, a.deformer.handle(a.high).center);
    a.deformer.set_transform(a.high, move);
    b.deformer.set_transform(b.high, move);
    CHECK(max_distance(a.deformer.solve(), b.deformer.solve()) < 0.2 * scene.size);
}

TEST_CASE("deformer: all of a mesh, a pin and a turned handle give the bent mesh in a few lines") {
    Mesh mesh = make_cactus();
    const Mesh rest = mesh;
    Deformer d(mesh);
    const HandleId base = d.pin(*mesh.find_region("base"));
    const HandleId tip = d.add_handle(*mesh.find_region("tip"));
    d.rotate(tip, Vec3::UnitZ(), kPi / 3);
    mesh.set_positions(d.solve());

    Deformer same(rest, Region::all(rest.shared_topology()));
    same.add_handle(*rest.find_region("base"));
    const HandleId handle = same.add_handle(*rest.find_region("tip"));
    same.set_transform(handle, rotation(Vec3::UnitZ(), kPi / 3, Vec3::Zero()),
                       same.handle(handle).center);
    Mesh wanted = rest;
    same.solve();
    same.apply_to(wanted);
    CHECK(hash(mesh) == hash(wanted));
    CHECK(d.pose(base).at_rest());
    CHECK(mesh.position(d.handle(base).region.vertices()[0]) ==
          rest.position(d.handle(base).region.vertices()[0]));
}

TEST_CASE("deformer: handles turn and move on from where they are, counting full turns") {
    const Scene scene = make_scene(make_bar());
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    for (int step = 0; step < 5; ++step) d.rotate(edit.high, {0, 0, 2}, 0.4 * kPi);
    CHECK((d.pose(edit.high).turn - Vec3(0, 0, 2.0 * kPi)).norm() < 1e-9);
    d.translate(edit.high, {1, 2, 3});
    d.translate(edit.high, {0, 0, 1});
    const Vec3 center = d.handle(edit.high).center;
    CHECK((d.pose(edit.high).transform(center) - center - Vec3(1, 2, 4)).norm() < 1e-9);
    CHECK(error_of([&] { d.rotate(edit.high, Vec3::Zero(), 1.0); }).code() ==
          ErrorCode::invalid_argument);
    CHECK(error_of([&] { d.translate(edit.high, {NAN, 0, 0}); }).code() == ErrorCode::not_finite);
    d.remove_handle(edit.high);
    CHECK(error_of([&] { d.rotate(edit.high, Vec3::UnitX(), 1.0); }).code() ==
          ErrorCode::handle_removed);
}
