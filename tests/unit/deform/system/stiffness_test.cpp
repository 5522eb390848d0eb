// Stiffness of single vertices: stiff parts move rigidly, soft ones take the bend.

#include <Eigen/Geometry>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/first_solution.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/deform/stats.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Scene bar_scene(Index across = 4, double size = 1.0) {
    BarOptions options;
    options.width = size;
    options.length = 5.0 * size;
    options.across = across;
    options.along = 5 * across;
    return make_scene(make_bar(options));
}

// RMS distance of `part` from the rigid image of its rest shape that is nearest.
double unrigidity(const std::vector<Vec3>& rest, const std::vector<Vec3>& now, const Region& part) {
    const auto n = static_cast<Index>(part.size());
    Eigen::Matrix3Xd a(3, n), b(3, n);
    for (Index i = 0; i < n; ++i) {
        a.col(i) = rest[part.vertices()[i]];
        b.col(i) = now[part.vertices()[i]];
    }
    const Eigen::Matrix4d fit = Eigen::umeyama(a, b, false);
    return std::sqrt((b - (fit * a.colwise().homogeneous()).topRows<3>()).squaredNorm() / n);
}

// How far the middle of a bent scene is from rigid, where it has the given stiffness.
double bent_middle(const Scene& scene, double stiffness, const DeformOptions& options = {}) {
    const Box box = bounds(scene.mesh);
    const Vec3 quarter = 0.17 * (box.max - box.min), center = 0.5 * (box.min + box.max);
    Vec3 reach(1e9, 1e9, 1e9);
    Index axis = 0;
    quarter.maxCoeff(&axis);
    reach[axis] = quarter[axis];
    const Region middle = select_box(scene.mesh, {center - reach, center + reach});
    Edit edit = make_edit(scene, options);
    set_stiffness(edit.deformer, middle, stiffness);
    const Affine move = bend(scene, edit.deformer.handle(edit.high).center, 1.2);
    edit.deformer.set_transform(edit.high, move);
    CHECK(max_distance(edit.deformer.solve(FrameQuality::preview),
                       solve_first_directly(edit.deformer)) < 1e-8 * scene.size);
    const std::vector<Vec3>& x = edit.deformer.solve();
    for (const Index v : scene.high) CHECK(x[v] == move(scene.mesh.position(v)));
    return unrigidity(rest_positions_of(edit.deformer), x, middle) / scene.size;
}

}  // namespace

TEST_CASE("stiffness: stiff parts move nearly rigidly, soft ones take more of the bend") {
    for (const SecondSystem second :
         {SecondSystem::blend, SecondSystem::poisson, SecondSystem::laplacian}) {
        DeformOptions options;
        options.second = second;
        const Scene scene = bar_scene();
        const double usual = bent_middle(scene, 1.0, options);
        // Laplacian coordinates alone say nothing of edges, so harmonic bends cost nothing.
        const double share = second == SecondSystem::laplacian ? 0.9 : 0.05;
        CHECK(bent_middle(scene, 1e3, options) < share * usual);
        CHECK(bent_middle(scene, 0.05, options) > 1.1 * usual);
    }
}

TEST_CASE("stiffness: of all vertices it changes nothing, and 1 is as usual") {
    const Scene scene = bar_scene();
    Edit plain = make_edit(scene), stiff = make_edit(scene);
    const Affine move = bend(scene, plain.deformer.handle(plain.high).center);
    plain.deformer.set_transform(plain.high, move);
    stiff.deformer.set_transform(stiff.high, move);
    set_stiffness(stiff.deformer, scene.all(), 1.0);
    CHECK(max_distance(plain.deformer.solve(), stiff.deformer.solve()) < 1e-12 * scene.size);
    set_stiffness(stiff.deformer, scene.all(), 37.0);
    CHECK(max_distance(plain.deformer.solve(), stiff.deformer.solve()) < 1e-9 * scene.size);
}

TEST_CASE(
    "stiffness: of all vertices it changes nothing at corners with a single triangle either") {
    const Mesh quads = make_grid({.size = {3.0, 1.0}, .segments = {18, 6}});
    FaceList faces;
    for (Index f = 0; f < quads.face_count(); ++f) {
        const auto q = quads.topology().face(f);
        faces.add({q[0], q[1], q[2]});
        faces.add({q[0], q[2], q[3]});
    }
    Scene scene{Mesh({quads.positions().begin(), quads.positions().end()}, faces), {}, {}, 3.0, {}};
    scene.across = Vec3::UnitZ();
    Index corners = 0;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        const double x = scene.mesh.position(v).x();
        if (x > -1.1 && x < -0.8) scene.low.push_back(v);
        if (x > 0.8 && x < 1.1) scene.high.push_back(v);
        if (scene.mesh.topology().neighbors(v).size() == 2) ++corners;
    }
    REQUIRE(corners == 2);
    Edit plain = make_edit(scene), stiff = make_edit(scene);
    const Affine move = bend(scene, plain.deformer.handle(plain.high).center);
    plain.deformer.set_transform(plain.high, move);
    stiff.deformer.set_transform(stiff.high, move);
    for (const double stiffness : {0.2, 37.0}) {
        set_stiffness(stiff.deformer, scene.all(), stiffness);
        CHECK(max_distance(plain.deformer.solve(), stiff.deformer.solve()) < 1e-9 * scene.size);
    }
}

TEST_CASE("stiffness: neither scale nor resolution changes what it does") {
    const double coarse = bent_middle(bar_scene(6), 20.0), fine = bent_middle(bar_scene(18), 20.0);
    CHECK(std::abs(bent_middle(bar_scene(6, 1e3), 20.0) - coarse) < 1e-9);
    CHECK(std::abs(bent_middle(bar_scene(24), 20.0) - fine) < 0.1 * fine);
}

TEST_CASE("stiffness: similarities of everything stay exact, and changing it refactors") {
    const Scene scene = bar_scene();
    DeformOptions options;
    options.local_size = LocalSize::scale;
    Edit edit = make_edit(scene, options);
    Deformer& d = edit.deformer;
    set_stiffness(d, select_sphere(scene.mesh, {0, 0, 0}, 1.0), 50.0);
    Affine map = rotation({1, 2, 3}, 1.4, {5, 0, 0});
    map.linear *= 1.7;
    d.set_transform(edit.low, map);
    d.set_transform(edit.high, map);
    CHECK(max_distance(d.solve(), mapped(rest_positions_of(d), map)) < 1e-9 * scene.size);
    const Index count = stats_of(d).factorizations;
    set_stiffness(d, scene.region(scene.low), 2.0);
    d.solve();
    CHECK(stats_of(d).factorizations == count + 1);
}

TEST_CASE("stiffness: a real mesh keeps its stiff part") {
    for (const char* name : {"cactus_cinolib.off", "dinosaur.obj", "armadillo_43k.obj"}) {
        const auto path = data_file(std::string("models/") + name);
        if (!path) continue;
        CAPTURE(name);
        const Scene scene = make_scene(load_mesh(*path));
        CHECK(bent_middle(scene, 1e3) < 0.1 * bent_middle(scene, 1.0));
    }
}

TEST_CASE("stiffness: zero, what loses digits and vertices outside are refused") {
    const Scene scene = bar_scene();
    Deformer d(scene.mesh, scene.region(scene.high));
    for (const double factor : {0.0, -1.0, 9e-5, 1.1e5, 1e10, std::nan(""), HUGE_VAL}) {
        CHECK(error_of([&] { set_stiffness(d, scene.region(scene.high), factor); }).code() ==
              ErrorCode::invalid_argument);
    }
    for (const double factor : {1e-4, 1e5}) set_stiffness(d, scene.region(scene.high), factor);
    CHECK(error_of([&] { set_stiffness(d, scene.region(scene.low), 2.0); }).code() ==
          ErrorCode::handle_outside_region);
}
