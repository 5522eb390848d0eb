// Handles with a mirror image: moving one moves both, and a symmetric mesh stays symmetric.

#include <Eigen/Geometry>
#include <array>

#include "kernel/deform/holds/mirror.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

const MirrorPlane kPlane{Vec3::Zero(), Vec3::UnitX(), 0.0};

// Greatest distance of x from its own mirror image across the plane x = 0.
double asymmetry(const Mesh& mesh, const std::vector<Vec3>& x) {
    std::vector<Index> all(static_cast<std::size_t>(mesh.vertex_count()));
    for (Index v = 0; v < mesh.vertex_count(); ++v) all[v] = v;
    const Affine mirror = reflection(kPlane);
    const std::vector<Index> other = counterparts(mesh.positions(), all, all, mirror, 1e-6);
    double worst = 0.0;
    for (const Index v : all) {
        REQUIRE(other[v] != kNoIndex);
        worst = std::max(worst, (x[other[v]] - mirror(x[v])).norm());
    }
    return worst;
}

struct Pair {
    Deformer deformer;
    HandleId right, left;
};

// What lies low, or behind where nothing does.
Region held_part(const Scene& scene) {
    const Box box = bounds(scene.mesh);
    const Index axis = box.max.y() > box.max.z() ? 1 : 2;
    std::vector<Index> vertices;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        if (scene.mesh.position(v)[axis] < 0.8 * box.min[axis]) vertices.push_back(v);
    }
    return scene.region(vertices);
}

// The low end held, and a handle of what lies around `at` with its mirror image.
Pair make_pair(const Scene& scene, const Vec3& at, double radius, const HandleOptions& options = {},
               const DeformOptions& deform = {}) {
    Deformer d(scene.mesh, scene.all(), deform);
    const HandleId right = d.add_handle(select_sphere(scene.mesh, at, radius), options);
    const HandleId left = d.mirror_handle(right, kPlane);
    d.add_handle(held_part(scene));
    return {std::move(d), right, left};
}

const Affine kMove = translation({0.3, 0.2, 0.15}) * rotation({1, 0.4, -0.3}, 0.7, {0.5, 1, 0});

}  // namespace

TEST_CASE("mirrored handles: a symmetric mesh deforms symmetrically") {
    const std::vector<std::pair<Mesh, Vec3>> shapes{{make_bar({1.0, 5.0, 6, 30}), {0.5, 0.8, 0}},
                                                    {make_torus(), {1.0, 0.0, 0.3}},
                                                    {make_sphere(), {0.9, 0.1, 0.2}}};
    for (const auto& [mesh, at] : shapes) {
        for (const int kind : {0, 1, 2}) {
            const Scene scene = make_scene(mesh);
            HandleOptions options;
            if (kind == 1) options.weight = 2.0;
            if (kind == 2) options.falloff = 0.5;
            Pair pair = make_pair(scene, at, 0.45, options);
            pair.deformer.set_transform(pair.right, kMove);
            CHECK(asymmetry(scene.mesh, pair.deformer.preview()) < 1e-9 * scene.size);
            CHECK(asymmetry(scene.mesh, pair.deformer.solve()) < 1e-9 * scene.size);
            CHECK(greatest_distance(pair.deformer.positions(), pair.deformer.rest_positions()) >
                  0.1);
        }
    }
}

TEST_CASE("mirrored handles: either moves both, and each goes its own way once one is removed") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    Pair pair = make_pair(scene, {0.5, 0.8, 0}, 0.4);
    Deformer& d = pair.deformer;
    CHECK(d.mirrored_handle(pair.right) == pair.left);
    CHECK(d.mirrored_handle(pair.left) == pair.right);
    CHECK((d.handle_center(pair.left) - reflection(kPlane)(d.handle_center(pair.right))).norm() <
          1e-12);
    d.set_transform(pair.right, kMove);
    const Vec3 p(0.4, 1.0, 0.2), q = reflection(kPlane)(p);
    CHECK((d.transform(pair.left)(q) - reflection(kPlane)(kMove(p))).norm() < 1e-12);
    d.set_transform(pair.left, kMove);
    CHECK((d.transform(pair.right)(q) - reflection(kPlane)(kMove(p))).norm() < 1e-12);
    d.set_transform(pair.left, {});
    CHECK(d.transform(pair.right).is_identity());
    CHECK(d.solve() == d.rest_positions());

    d.remove_handle(pair.left);
    CHECK(!d.mirrored_handle(pair.right));
    d.set_transform(pair.right, kMove);
    d.solve();
}

TEST_CASE("mirrored handles: other vertices for one are other vertices for both") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 6, 30}));
    Pair pair = make_pair(scene, {0.5, 0.8, 0}, 0.4);
    Deformer& d = pair.deformer;
    d.set_transform(pair.right, kMove);
    d.set_handle_region(pair.right, select_sphere(scene.mesh, {0.5, 0.4, 0}, 0.45));
    CHECK(d.handle_region(pair.left) == select_sphere(scene.mesh, {-0.5, 0.4, 0}, 0.45));
    CHECK(asymmetry(scene.mesh, d.solve()) < 1e-9 * scene.size);
}

TEST_CASE("mirrored handles: of points of faces") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    Deformer d(scene.mesh, scene.all());
    d.add_handle(scene.region(scene.low));
    const SurfacePoint hit = SpatialTree(scene.mesh).nearest(Vec3(0.5, 0.8, 0.1));
    const Index face = hit.face;
    const std::vector<MeshPoint> points{
        face_point(scene.mesh.topology(), face, std::array{0.4, 0.3, 0.2, 0.1})};
    const HandleId right = d.add_handle(points);
    d.mirror_handle(right, kPlane);
    d.set_transform(right, kMove);
    CHECK(asymmetry(scene.mesh, d.solve()) < 1e-9 * scene.size);
}

TEST_CASE("mirrored handles: a real mesh, as far as it is symmetric") {
    const auto path = data_file("models/spot.obj");
    if (!path) return;
    const Scene scene = make_scene(load_mesh(*path));
    Deformer d(scene.mesh, scene.all());
    // One horn and its image.
    Index tip = 0;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        if (scene.mesh.position(v).y() > scene.mesh.position(tip).y()) tip = v;
    }
    const MirrorPlane plane{Vec3::Zero(), Vec3::UnitX(), 0.01 * scene.size};
    const Region horn = select_sphere(scene.mesh, scene.mesh.position(tip), 0.1 * scene.size);
    const HandleId h = d.add_handle(horn);
    const HandleId image = d.mirror_handle(h, plane);
    CHECK(d.handle_region(image).size() == horn.size());
    d.add_handle(scene.region(scene.low));
    d.set_transform(h, translation({0.0, 0.2 * scene.size, 0.0}));
    d.solve();
    for (const Index v : d.handle_region(image).vertices()) {
        CHECK(d.positions()[v].y() > d.rest_positions()[v].y() + 0.19 * scene.size);
    }
}

TEST_CASE("mirrored handles: no counterpart, and handles across the plane, are refused") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    Deformer d(scene.mesh, scene.all());
    const HandleId low = d.add_handle(scene.region(scene.low));
    const Error meets = error_of([&] { d.mirror_handle(low, kPlane); });
    CHECK(meets.code() == ErrorCode::handle_overlap);
    CHECK(meets.elements().count == scene.low.size());
    const Error alone = error_of([&] {
        d.mirror_handle(low, {Vec3(7, 0, 0), Vec3::UnitX(), 0.0});
    });
    CHECK(alone.code() == ErrorCode::invalid_argument);
    CHECK(alone.elements().count == scene.low.size());
    CHECK(error_of([&] {
              d.mirror_handle(low, {Vec3::Zero(), Vec3::Zero(), 0.0});
          }).code() == ErrorCode::invalid_argument);
    const HandleId side = d.add_handle(select_sphere(scene.mesh, {0.5, 0.8, 0}, 0.4));
    d.mirror_handle(side, kPlane);
    CHECK(error_of([&] { d.mirror_handle(side, kPlane); }).code() == ErrorCode::invalid_argument);
    CHECK(d.handles().size() == 3);
}
