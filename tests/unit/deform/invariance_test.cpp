// What the result must not depend on: the frame, the scale, the order of vertices, and left and
// right.

#include <Eigen/Geometry>
#include <numeric>
#include <random>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/deform/thesis_options.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A shape without flat parts, so that no vertex is displaced.
Scene torus_scene() {
    return make_scene(make_torus());
}

Scene moved_bar() {
    BarOptions options;
    options.across = 4;
    options.along = 20;
    return make_scene(make_bar(options));
}

std::vector<Vec3> bent(const Scene& scene, const DeformOptions& options, const Affine& map = {}) {
    Edit edit = make_edit(scene, options);
    const Affine inverse{map.linear.inverse(), -map.linear.inverse() * map.translation};
    // The bend is told in the space before `map`.
    const Vec3 center = inverse(edit.deformer.handle(edit.high).center);
    const Affine move = translation({0.2, 0.1, -0.1}) * rotation({1.0, 0.2, 0.5}, 0.9, center);
    edit.deformer.set_transform(edit.high, conjugated(move, map));
    return edit.deformer.solve();
}

// Greatest deviation between bending a mapped scene and mapping the bent scene, relative to its
// size.
double deviation(const Scene& scene, const Affine& map, const DeformOptions& options = {}) {
    Scene other = scene;
    other.mesh = moved(scene.mesh, map);
    other.size = surface_radius(other.mesh);
    return max_distance(bent(other, options, map), mapped(bent(scene, options), map)) / other.size;
}

Affine similarity(double scale) {
    Affine map = rotation({0.3, -0.5, 0.9}, 2.1, {1.0, 2.0, 3.0});
    map.linear *= scale;
    map.translation *= scale;
    return map;
}

}  // namespace

TEST_CASE("frame: a rigid motion of everything moves the result along") {
    CHECK(deviation(torus_scene(), similarity(1.0)) < 1e-9);
    CHECK(deviation(moved_bar(), similarity(1.0)) < 1e-6);
}

TEST_CASE("frame: so it is for every second system and for scaled details") {
    for (const SecondSystem second :
         {SecondSystem::blend, SecondSystem::laplacian, SecondSystem::poisson}) {
        for (const LocalSize size : {LocalSize::keep, LocalSize::scale}) {
            DeformOptions options;
            options.second = second;
            options.local_size = size;
            CHECK(deviation(torus_scene(), similarity(1.0), options) < 1e-9);
        }
    }
}

TEST_CASE("scale: small and large models deform alike") {
    for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
        CHECK(deviation(torus_scene(), similarity(scale)) < 1e-9);
        CHECK(deviation(moved_bar(), similarity(scale)) < 1e-6);
    }
}

TEST_CASE("offset: a model far from the origin loses only the digits its coordinates lack") {
    CHECK(deviation(torus_scene(), translation({1e6, -1e6, 1e6})) < 1e-6);
}

TEST_CASE("literal weights of the thesis depend on scale, the default does not") {
    if (!test::kHasThesis) return;
    const DeformOptions literal = test::thesis_or_default();
    CHECK(deviation(torus_scene(), similarity(100.0), literal) > 1e-4);
    CHECK(deviation(torus_scene(), similarity(100.0)) < 1e-9);
}

TEST_CASE("mirror: left and right are treated alike") {
    const Scene scene = torus_scene();
    Affine mirror;
    mirror.linear(0, 0) = -1.0;
    Scene other = scene;
    FaceList faces;
    for (Index f = 0; f < scene.mesh.face_count(); ++f) {
        const auto face = scene.mesh.topology().face(f);
        faces.add(std::vector<Index>(face.rbegin(), face.rend()));
    }
    std::vector<Vec3> positions(scene.mesh.positions().begin(), scene.mesh.positions().end());
    other.mesh = Mesh(mapped(positions, mirror), faces);
    CHECK(max_distance(bent(other, {}, mirror), mapped(bent(scene, {}), mirror)) <
          1e-9 * scene.size);
}

TEST_CASE("order: renumbered vertices and faces give the same surface") {
    for (const bool flat : {false, true}) {
        const Scene scene = flat ? moved_bar() : torus_scene();
        const Index n = scene.mesh.vertex_count();
        std::vector<Index> to(static_cast<std::size_t>(n));
        std::iota(to.begin(), to.end(), 0);
        std::shuffle(to.begin(), to.end(), std::mt19937(5));
        Scene other = scene;
        std::vector<Vec3> positions(static_cast<std::size_t>(n));
        for (Index v = 0; v < n; ++v) positions[to[v]] = scene.mesh.position(v);
        FaceList faces;
        for (Index f = scene.mesh.face_count(); f-- > 0;) {
            std::vector<Index> face;
            for (const Index v : scene.mesh.topology().face(f)) face.push_back(to[v]);
            std::rotate(face.begin(), face.begin() + 1, face.end());
            faces.add(face);
        }
        other.mesh = Mesh(positions, faces);
        for (Index& v : other.low) v = to[v];
        for (Index& v : other.high) v = to[v];
        const std::vector<Vec3> a = bent(scene, {}), b = bent(other, {});
        std::vector<Vec3> renumbered;
        for (Index v = 0; v < n; ++v) renumbered.push_back(b[to[v]]);
        CHECK(max_distance(a, renumbered) < (flat ? 1e-6 : 1e-9) * scene.size);
    }
}
