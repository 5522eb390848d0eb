// Handles with a mirror image: moving one moves both, and a symmetric mesh stays symmetric.

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/deform/holds/mirror.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/query/spatial_tree.h"
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

// Greatest distance of x, reflected across the plane x = 0, from the surface of x.
double outline_asymmetry(const Mesh& mesh, const std::vector<Vec3>& x) {
    Mesh now = mesh;
    now.set_positions(x);
    const SpatialTree tree(now);
    const Affine mirror = reflection(kPlane);
    double worst = 0.0;
    for (const Vec3& p : x) worst = std::max(worst, tree.nearest(mirror(p)).distance);
    return worst;
}

// What the vertices of a region have of the surface.
double area_of(const Mesh& mesh, const Region& region) {
    const Topology& topology = mesh.topology();
    const std::vector<double> areas = face_areas(mesh);
    double sum = 0.0;
    for (Index f = 0; f < topology.face_count(); ++f) {
        double inside = 0.0;
        const auto corners = topology.face(f);
        for (const Index v : corners) inside += region.contains(v) ? 1.0 : 0.0;
        sum += areas[f] * inside / static_cast<double>(corners.size());
    }
    return sum;
}

// Each vertex goes up to `part` of its distance from the middle out or in.
Mesh roughened(Mesh mesh, double part) {
    std::vector<Vec3> x(mesh.positions().begin(), mesh.positions().end());
    for (std::size_t v = 0; v < x.size(); ++v) {
        x[v] *= 1.0 + part * std::sin(7.0 * static_cast<double>(v));
    }
    mesh.set_positions(x);
    return mesh;
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
    const HandleId left = mirror_handle(d, right, kPlane);
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
            CHECK(asymmetry(scene.mesh, pair.deformer.solve(FrameQuality::preview)) <
                  1e-9 * scene.size);
            CHECK(asymmetry(scene.mesh, pair.deformer.solve()) < 1e-9 * scene.size);
            CHECK(max_distance(pair.deformer.positions(), rest_positions_of(pair.deformer)) > 0.1);
        }
    }
}

TEST_CASE("mirrored handles: either moves both, and each goes its own way once one is removed") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    Pair pair = make_pair(scene, {0.5, 0.8, 0}, 0.4);
    Deformer& d = pair.deformer;
    CHECK(d.handle(pair.right).image == pair.left);
    CHECK(d.handle(pair.left).image == pair.right);
    CHECK((d.handle(pair.left).center - reflection(kPlane)(d.handle(pair.right).center)).norm() <
          1e-12);
    d.set_transform(pair.right, kMove);
    const Vec3 p(0.4, 1.0, 0.2), q = reflection(kPlane)(p);
    CHECK((d.pose(pair.left).transform(q) - reflection(kPlane)(kMove(p))).norm() < 1e-12);
    d.set_transform(pair.left, kMove);
    CHECK((d.pose(pair.right).transform(q) - reflection(kPlane)(kMove(p))).norm() < 1e-12);
    d.set_transform(pair.left, {});
    CHECK(d.pose(pair.right).transform.is_identity());
    CHECK(d.solve() == rest_positions_of(d));

    d.remove_handle(pair.left);
    CHECK(!d.handle(pair.right).image);
    d.set_transform(pair.right, kMove);
    d.solve();
}

TEST_CASE("mirrored handles: other vertices for one are other vertices for both") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 6, 30}));
    Pair pair = make_pair(scene, {0.5, 0.8, 0}, 0.4);
    Deformer& d = pair.deformer;
    d.set_transform(pair.right, kMove);
    set_handle_region(d, pair.right, select_sphere(scene.mesh, {0.5, 0.4, 0}, 0.45));
    CHECK(d.handle(pair.left).region == select_sphere(scene.mesh, {-0.5, 0.4, 0}, 0.45));
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
    mirror_handle(d, right, kPlane);
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
    const HandleId image = mirror_handle(d, h, plane);
    CHECK(d.handle(image).region.size() == doctest::Approx(horn.size()).epsilon(0.1));
    CHECK(mirror_residual_of(d, h).max < 0.02);
    d.add_handle(scene.region(scene.low));
    d.set_transform(h, translation({0.0, 0.2 * scene.size, 0.0}));
    d.solve();
    for (const Index v : d.handle(image).region.vertices()) {
        CHECK(d.positions()[v].y() > rest_positions_of(d)[v].y() + 0.19 * scene.size);
    }
}

TEST_CASE(
    "mirrored handles: sides of unlike vertices, and nearly symmetric ones, are not refused") {
    const std::vector<std::pair<Mesh, Vec3>> shapes{
        {moved(make_sphere(), rotation({1, 0.3, 0.2}, 0.7, Vec3::Zero())), {0.8, 0.5, 0.2}},
        {moved(make_torus(), rotation(Vec3::UnitY(), 0.05, Vec3::Zero())), {1.0, 0.1, 0.1}},
        {roughened(make_bar({1.0, 5.0, 6, 30}), 0.01), {0.5, 0.8, 0}}};
    for (const auto& [mesh, at] : shapes) {
        const Scene scene = make_scene(mesh);
        Pair pair = make_pair(scene, at, 0.45);
        Deformer& d = pair.deformer;
        CHECK(area_of(scene.mesh, d.handle(pair.left).region) ==
              doctest::Approx(area_of(scene.mesh, d.handle(pair.right).region)).epsilon(0.3));
        const MirrorResidual residual = mirror_residual_of(d, pair.right);
        CHECK(residual.mean <= residual.max);
        CHECK(residual.max < 0.03);
        d.set_transform(pair.right, translation({0.3, 0.2, 0.15}));
        d.solve();
        CHECK(outline_asymmetry(scene.mesh, d.positions()) < 0.05 * scene.size);
    }
}

TEST_CASE("mirrored handles: what differs much is told with what helps, and is done") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 6, 30}));
    Deformer d(scene.mesh, scene.all());
    const HandleId side = d.add_handle(select_sphere(scene.mesh, {0.5, 0.8, 0}, 0.4));
    // Beside the middle.
    mirror_handle(d, side, {Vec3(0.05, 0, 0), Vec3::UnitX(), 0.0});
    const MirrorResidual residual = mirror_residual_of(d, side);
    CHECK(residual.max * scene.size == doctest::Approx(0.1).epsilon(0.5));
    CHECK(residual.warning.find("through the middle") != std::string::npos);
    const HandleId other = d.add_handle(select_sphere(scene.mesh, {0.5, -1.2, 0}, 0.4));
    CHECK(error_of([&] { mirror_residual_of(d, other); }).code() == ErrorCode::invalid_argument);
    mirror_handle(d, other, {Vec3(0.05, 0, 0), Vec3::UnitX(), 0.2});
    CHECK(mirror_residual_of(d, other).warning.empty());
}

TEST_CASE("mirrored handles: the rim of an image gives way to what another handle holds") {
    const Mesh mesh = moved(make_sphere(), rotation({1, 0.3, 0.2}, 0.7, Vec3::Zero()));
    const Scene scene = make_scene(mesh);
    Deformer d(scene.mesh, scene.all());
    std::vector<Index> low, high;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3& p = mesh.position(v);
        if (p.y() < 0.0) low.push_back(v);
        if (p.y() >= 0.0 && p.y() < 0.5 && p.x() > 0.1) high.push_back(v);
    }
    d.add_handle(scene.region(low));
    const HandleId right = d.add_handle(scene.region(high));
    const HandleId left = mirror_handle(d, right, kPlane);
    CHECK(d.handle(left).region.size() > count_of(high) / 2);
    for (const Index v : d.handle(left).region.vertices()) CHECK(mesh.position(v).y() >= 0.0);
}

TEST_CASE("mirrored handles: the front of a thin plate is not mirrored onto its back") {
    Mesh plate = make_bar({1.0, 5.0, 6, 30});
    std::vector<Vec3> x(plate.positions().begin(), plate.positions().end());
    // As thin as one side lies in front of the other.
    for (Vec3& p : x) p.z() = 0.02 * p.z() + 0.03 * p.x();
    plate.set_positions(x);
    const Scene scene = make_scene(plate);
    Deformer d(scene.mesh, scene.all());
    const std::vector<Vec3> normals = vertex_normals(plate);
    std::vector<Index> front;
    for (Index v = 0; v < plate.vertex_count(); ++v) {
        const Vec3& p = plate.position(v);
        if (normals[v].z() > 0.9 && p.x() > 0.1 && p.x() < 0.4 && std::abs(p.y()) < 1.0) {
            front.push_back(v);
        }
    }
    const HandleId right = d.add_handle(scene.region(front));
    const HandleId left = mirror_handle(d, right, kPlane);
    CHECK(d.handle(left).region.size() == count_of(front));
    for (const Index v : d.handle(left).region.vertices()) CHECK(normals[v].z() > 0.0);
}

TEST_CASE("mirrored handles: no counterpart, and handles across the plane, are refused") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    Deformer d(scene.mesh, scene.all());
    const HandleId low = d.add_handle(scene.region(scene.low));
    const Error meets = error_of([&] { mirror_handle(d, low, kPlane); });
    CHECK(meets.code() == ErrorCode::handle_overlap);
    CHECK(meets.elements().count == scene.low.size());
    const Error alone = error_of([&] {
        mirror_handle(d, low, {Vec3(7, 0, 0), Vec3::UnitX(), 0.0});
    });
    CHECK(alone.code() == ErrorCode::invalid_argument);
    CHECK(alone.elements().count == scene.low.size());
    CHECK(error_of([&] {
              mirror_handle(d, low, {Vec3::Zero(), Vec3::Zero(), 0.0});
          }).code() == ErrorCode::invalid_argument);
    const HandleId side = d.add_handle(select_sphere(scene.mesh, {0.5, 0.8, 0}, 0.4));
    mirror_handle(d, side, kPlane);
    CHECK(error_of([&] { mirror_handle(d, side, kPlane); }).code() == ErrorCode::invalid_argument);
    CHECK(d.handles().size() == 3);
}
