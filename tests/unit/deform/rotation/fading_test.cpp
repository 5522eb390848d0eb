// Handles whose hold fades with the distance, and outlines that the deformation fades towards.

#include <Eigen/Geometry>
#include <cmath>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/first_solution.h"
#include "kernel/deform/patch/patch_distance.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Scene sheet_scene(Index segments, double size = 1.0) {
    GridOptions options;
    options.size = {4.0 * size, 4.0 * size};
    options.segments = {segments, segments};
    return make_scene(make_grid(options), 0.06);
}

// Mean distance by which vertices within `radius` of the centre stay behind a handle there, which
// lifts and turns, in sizes of its lift.
double slack(const Scene& scene, const HandleOptions& options, double radius,
             const DeformOptions& deform = {}) {
    const double unit = scene.size / make_scene(sheet_scene(8).mesh).size;
    Deformer d(scene.mesh, scene.all(), deform);
    d.add_handle(scene.region(scene.low));
    d.add_handle(scene.region(scene.high));
    const HandleId h = d.add_handle(select_sphere(scene.mesh, {0, 0, 0}, 0.3 * unit), options);
    const Affine move = translation({0, unit, 0}) * rotation(Vec3::UnitX(), 0.5, Vec3::Zero());
    d.set_transform(h, move);
    CHECK(max_distance(d.solve(FrameQuality::preview), solve_first_directly(d)) <
          1e-9 * scene.size);
    const std::vector<Vec3>& x = d.solve();
    double sum = 0.0;
    int count = 0;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        const double r = scene.mesh.position(v).norm();
        if (r <= 0.31 * unit || r > radius * unit) continue;
        sum += (x[v] - move(scene.mesh.position(v))).norm() / unit;
        ++count;
    }
    return sum / count;
}

HandleOptions fading(double falloff) {
    HandleOptions options;
    options.falloff = falloff;
    return options;
}

}  // namespace

TEST_CASE("patch distances: straight over a flat sheet, and as the heat method elsewhere") {
    const Scene sheet = sheet_scene(32);
    const Patch flat = build_patch(sheet.mesh, sheet.all(), 1);
    const Index middle = SpatialTree(sheet.mesh).nearest(Vec3::Zero()).vertex;
    const std::vector<double> d = patch_distances(flat, {{middle, 0.0}}, 1e9);
    const std::vector<double> near = patch_distances(flat, {{middle, 0.0}}, 1.0);
    for (Index v = 0; v < sheet.mesh.vertex_count(); ++v) {
        const double exact = (sheet.mesh.position(v) - sheet.mesh.position(middle)).norm();
        CHECK(std::abs(d[v] - exact) < 0.02);
        CHECK((near[v] == d[v] || (std::isinf(near[v]) && d[v] > 1.0)));
    }
    const Mesh sphere = make_sphere();
    const Patch round = build_patch(sphere, Region::all(sphere.shared_topology()), 1);
    const std::vector<double> over = patch_distances(round, {{0, 0.0}}, 1e9);
    for (Index v = 0; v < sphere.vertex_count(); ++v) {
        const double exact = std::acos(std::clamp(
            sphere.position(v).normalized().dot(sphere.position(0).normalized()), -1.0, 1.0));
        CHECK(std::abs(over[v] - exact * sphere.position(0).norm()) < 0.01 + 0.04 * exact);
    }
}

TEST_CASE("falloff: the surface near the handle follows it, the more the wider") {
    const Scene scene = sheet_scene(32);
    const double without = slack(scene, {}, 0.6), narrow = slack(scene, fading(0.6), 0.6),
                 wide = slack(scene, fading(1.2), 0.6);
    CHECK(narrow < 0.9 * without);
    CHECK(wide < 0.5 * without);
    CHECK(slack(scene, fading(1e-3), 0.6) == doctest::Approx(without));
}

TEST_CASE("falloff: neither scale nor resolution changes what it does") {
    const double fine = slack(sheet_scene(48), fading(1.0), 0.8);
    CHECK(std::abs(slack(sheet_scene(32), fading(1.0), 0.8) - fine) <
          0.1 * slack(sheet_scene(48), {}, 0.8));
    HandleOptions big = fading(100.0);
    CHECK(std::abs(slack(sheet_scene(32, 100.0), big, 0.8) -
                   slack(sheet_scene(32), fading(1.0), 0.8)) < 1e-6);
}

TEST_CASE("falloff: similarities of everything are exact, and so is rest") {
    const Scene scene = make_scene(make_torus());
    DeformOptions options;
    options.local_size = LocalSize::scale;
    Edit edit = make_edit(scene, options, fading(0.5));
    Affine map = rotation({1, 2, 3}, 1.4, {5, 0, 0});
    map.linear *= 1.7;
    edit.deformer.set_transform(edit.low, map);
    edit.deformer.set_transform(edit.high, map);
    CHECK(max_distance(edit.deformer.solve(), mapped(rest_positions_of(edit.deformer), map)) <
          1e-9 * scene.size);
    edit.deformer.set_transform(edit.low, {});
    edit.deformer.set_transform(edit.high, {});
    CHECK(edit.deformer.solve() == rest_positions_of(edit.deformer));
}

TEST_CASE("transition: the deformation fades towards the outline, and 0 is as usual") {
    const Scene scene = sheet_scene(40);
    const Region inner = select_sphere(scene.mesh, {0, 0, 0}, 1.6);
    const auto lifted = [&](double transition, const HandleOptions& options) {
        DeformOptions deform;
        deform.transition = transition;
        Deformer d(scene.mesh, inner, deform);
        const HandleId h = d.add_handle(select_sphere(scene.mesh, {0, 0, 0}, 0.3), options);
        d.set_transform(h, translation({0, 1, 0}) * rotation(Vec3::UnitX(), 0.3, Vec3::Zero()));
        const std::vector<Vec3> x = d.solve();
        CHECK(max_distance(d.solve(FrameQuality::preview), solve_first_directly(d)) <
              1e-9 * scene.size);
        double rim = 0.0;
        for (std::size_t row = 0; row < x.size(); ++row) {
            const double r = rest_positions_of(d)[row].norm();
            if (r > 1.3) rim = std::max(rim, (x[row] - rest_positions_of(d)[row]).norm());
        }
        return rim;
    };
    const double usual = lifted(0.0, {});
    CHECK(lifted(0.4, {}) < 0.9 * usual);
    CHECK(lifted(0.9, {}) < 0.5 * lifted(0.4, {}));
    // With positions or gradients alone, softly, and with a falloff.
    HandleOptions kinds[4];
    kinds[0].gradient = false;
    kinds[1].weight = 5.0;
    kinds[2].falloff = 0.5;
    kinds[3].position = false;
    for (const HandleOptions& options : kinds) {
        const double plain = lifted(0.0, options), faded = lifted(0.8, options);
        CHECK(faded < plain);
        CHECK(std::isfinite(faded));
    }
}

TEST_CASE("fading: real meshes stay finite and held") {
    for (const char* name : {"cactus_cinolib.off", "lion.off", "spot.obj"}) {
        const auto path = data_file(std::string("models/") + name);
        if (!path) continue;
        CAPTURE(name);
        const Scene scene = make_scene(load_mesh(*path));
        Edit edit = make_edit(scene, {}, fading(0.5 * scene.size));
        const Affine move = bend(scene, edit.deformer.handle(edit.high).center);
        edit.deformer.set_transform(edit.high, move);
        bool finite = true;
        for (const Vec3& p : edit.deformer.solve()) finite = finite && p.allFinite();
        CHECK(finite);
        for (const Index v : scene.high) {
            CHECK(edit.deformer.positions()[v] == move(scene.mesh.position(v)));
        }
    }
}

TEST_CASE("fading: distances below zero are refused") {
    const Scene scene = sheet_scene(8);
    Deformer d(scene.mesh, scene.all());
    CHECK(error_of([&] { d.add_handle(scene.region(scene.low), fading(-1.0)); }).code() ==
          ErrorCode::invalid_argument);
    DeformOptions options;
    options.transition = -1.0;
    CHECK(error_of([&] { Deformer(scene.mesh, scene.all(), options); }).code() ==
          ErrorCode::invalid_argument);
}
