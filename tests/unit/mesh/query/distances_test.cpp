#include "kernel/mesh/query/distances.h"

#include <algorithm>
#include <array>

#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// Largest error of `distance` as a fraction of the farthest point's distance.
template <typename Exact>
double worst_error(const Mesh& mesh, const std::vector<double>& distance, const Exact& exact) {
    double worst = 0.0, farthest = 0.0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        worst = std::max(worst, std::abs(distance[v] - exact(mesh.position(v))));
        farthest = std::max(farthest, exact(mesh.position(v)));
    }
    return worst / farthest;
}

// A flat square of obtuse triangles: rows are four times denser than columns and slide to and fro.
Mesh obtuse_square(Index n) {
    Mesh mesh = make_grid({.segments = {n, 4 * n}});
    for (Vec3& p : mesh.edit_positions()) {
        p.x() += 0.8 / n * std::cos(kPi * p.x()) * std::sin(2.0 * n * p.z());
    }
    triangulate(mesh);
    return mesh;
}

}  // namespace

TEST_CASE("edge distances are those of a brute-force relaxation") {
    const Mesh mesh = make_sphere({.segments = 5});
    const std::vector<double> fast = edge_distances(mesh, std::array{3, 40});
    std::vector<double> slow(fast.size(), test::kInfinity);
    slow[3] = slow[40] = 0.0;
    for (std::size_t round = 0; round < slow.size(); ++round) {
        for (Index e = 0; e < mesh.topology().edge_count(); ++e) {
            const auto [a, b] = mesh.topology().edge(e);
            const double length = (mesh.position(a) - mesh.position(b)).norm();
            slow[a] = std::min(slow[a], slow[b] + length);
            slow[b] = std::min(slow[b], slow[a] + length);
        }
    }
    for (std::size_t v = 0; v < slow.size(); ++v) CHECK(fast[v] == Approx(slow[v]));
}

TEST_CASE("edge distances end at the limit and at components") {
    Mesh mesh = make_grid({.size = {10, 1}, .segments = {10, 1}});
    append(mesh, test::tetrahedron());
    const std::vector<double> distance = edge_distances(mesh, std::array{0}, 4.0);
    CHECK(distance[4] == Approx(4.0));
    CHECK(distance[5] == test::kInfinity);
    CHECK(distance.back() == test::kInfinity);
    CHECK(test::error_of([&] { (void)edge_distances(mesh, std::array{0}, -1.0); }).code() ==
          ErrorCode::invalid_argument);
    CHECK(test::error_of([&] { (void)edge_distances(mesh, std::array{-1}); }).code() ==
          ErrorCode::out_of_range);
}

TEST_CASE("heat distances on a sphere are arcs") {
    for (const SphereKind kind : {SphereKind::quads, SphereKind::triangles}) {
        const Mesh mesh = make_sphere({.segments = 24, .kind = kind});
        const Index source = 17;
        const Vec3 from = mesh.position(source);
        const auto arc = [&](const Vec3& p) {
            return std::acos(std::clamp(p.dot(from), -1.0, 1.0));
        };
        CHECK(worst_error(mesh, heat_distances(mesh, std::array{source}), arc) < 0.02);
    }
}

TEST_CASE("heat distances on a sphere converge") {
    double last = 1.0;
    for (const Index segments : {8, 16, 32}) {
        const Mesh mesh = make_sphere({.segments = segments});
        const auto arc = [&](const Vec3& p) {
            return std::acos(std::clamp(p.dot(mesh.position(0)), -1.0, 1.0));
        };
        const double error = worst_error(mesh, heat_distances(mesh, std::array{0}), arc);
        CHECK(error < 0.85 * last);
        last = error;
    }
}

TEST_CASE(
    "heat distances on a plane with boundary are straight, for good and for obtuse triangles") {
    const Mesh grid = make_grid({.segments = {40, 40}});
    const Index corner = 0;
    const auto from_corner = [&](const Vec3& p) { return (p - grid.position(corner)).norm(); };
    CHECK(worst_error(grid, heat_distances(grid, std::array{corner}), from_corner) < 0.04);

    const Mesh square = obtuse_square(20);
    const Index middle = select_sphere(square, Vec3::Zero(), 0.01).vertices().at(0);
    const auto from_middle = [&](const Vec3& p) { return (p - square.position(middle)).norm(); };
    CHECK(worst_error(square, heat_distances(square, std::array{middle}), from_middle) < 0.04);
}

TEST_CASE("heat distances around a concave corner go around it") {
    // An L: the far arm is reached past the inner corner.
    Mesh mesh = make_grid({.size = {2, 2}, .segments = {40, 40}});
    FaceList faces;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        Vec3 middle = Vec3::Zero();
        for (const Index v : mesh.topology().face(f)) middle += mesh.position(v) / 4.0;
        if (middle.x() < 0 || middle.z() < 0) faces.add(mesh.topology().face(f));
    }
    const Mesh l_shape({mesh.positions().begin(), mesh.positions().end()}, std::move(faces));
    const Index from = select_sphere(l_shape, Vec3(1, 0, -1), 1e-9).vertices().at(0);
    const Index to = select_sphere(l_shape, Vec3(-1, 0, 1), 1e-9).vertices().at(0);
    const double around = 2.0 * std::sqrt(2.0);
    CHECK(heat_distances(l_shape, std::array{from})[to] == Approx(around).epsilon(0.03));
}

TEST_CASE("heat distances lie between half the way along edges and all of it") {
    for (const char* name : {"lion.off", "fertility.off", "cube_noisy.off"}) {
        const auto mesh = test::load_off(name);
        if (!mesh) continue;
        const std::vector<double> heat = heat_distances(*mesh, std::array{0});
        const std::vector<double> edges = edge_distances(*mesh, std::array{0});
        const double farthest = *std::max_element(edges.begin(), edges.end());
        for (std::size_t v = 0; v < heat.size(); ++v) {
            CHECK(heat[v] <= edges[v]);
            CHECK(heat[v] > 0.55 * edges[v] - 0.03 * farthest);
        }
    }
}

TEST_CASE("distances scale with the mesh and do not depend on its frame") {
    const Mesh mesh = make_torus();
    const std::vector<double> before = heat_distances(mesh, std::array{5});
    test::Random random(6);
    for (const double scale : {1e-4, 1e5}) {
        const Mesh image = test::moved(mesh, test::similarity(random, scale));
        const std::vector<double> after = heat_distances(image, std::array{5});
        for (std::size_t v = 0; v < before.size(); ++v) {
            CHECK(after[v] == Approx(scale * before[v]).epsilon(1e-6));
        }
    }
}

TEST_CASE("several sources and components: the nearest source, infinity where there is none") {
    Mesh mesh = make_sphere({.segments = 12});
    const Index count = mesh.vertex_count();
    append(mesh, mesh);
    append(mesh, Mesh({{0, 0, 0}}, FaceList{}));
    const HeatDistances solver(mesh);
    const std::vector<double> one = solver.from(std::array{7});
    const std::vector<double> both = solver.from(std::array{7, count + 7});
    for (Index v = 0; v < count; ++v) {
        CHECK(one[count + v] == test::kInfinity);
        CHECK(both[v] == Approx(both[count + v]).epsilon(1e-9));
        CHECK(both[v] == Approx(one[v]).epsilon(1e-9));
    }
    CHECK(one[7] == 0.0);
    CHECK(both[2 * count] == test::kInfinity);
}

TEST_CASE("long thin meshes keep their far distances") {
    const Mesh tube =
        make_cylinder({.radius = 0.05, .height = 40, .segments = 8, .rings = 3200, .caps = false});
    const Region start = select_box(tube, {Vec3(-1, -20, -1), Vec3(1, -20, 1)});
    const std::vector<double> distance = heat_distances(tube, start.vertices());
    CHECK(*std::max_element(distance.begin(), distance.end()) == Approx(40).epsilon(0.02));
}

TEST_CASE("faces without area do no harm") {
    Mesh mesh = make_grid({.size = {1, 1}, .segments = {20, 20}});
    triangulate(mesh);
    // Flattens a row of triangles onto their edge.
    for (Index v = 0; v <= 20; ++v)
        mesh.edit_positions()[21 * 10 + v].z() = mesh.position(21 * 9).z();
    CHECK(zero_area_faces(mesh).size() > 10);
    const std::vector<double> distance = heat_distances(mesh, std::array{0});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        CHECK(distance[v] == Approx((mesh.position(v) - mesh.position(0)).norm()).epsilon(0.15));
    }
}

TEST_CASE("queries without sense are refused") {
    const auto code = [](const auto& action) { return test::error_of(action).code(); };
    const HeatDistances solver(make_box());
    CHECK(code([&] { (void)solver.from({}); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { (void)solver.from(std::array{8}); }) == ErrorCode::out_of_range);
    CHECK(code([] { HeatDistances{Mesh()}; }) == ErrorCode::mesh_empty);
}

TEST_CASE("distances from a point of the surface that is no vertex") {
    const Mesh sphere = make_sphere({.segments = 24});
    const Vec3 at = Vec3(0.3, 0.8, 0.4).normalized();
    const SurfacePoint from = SpatialTree(sphere).nearest(at);
    const double radius = sphere.position(0).norm();
    const auto exact = [&](const Vec3& p) {
        return radius * std::atan2(p.cross(at).norm(), p.dot(at));
    };
    const std::vector<double> distance = HeatDistances(sphere).from_point(from);
    CHECK(worst_error(sphere, distance, exact) < 0.02);
    // Near the point it is as good as far from it.
    for (const Index corner : from.triangle) {
        CHECK(distance[corner] ==
              Approx((sphere.position(corner) - from.position).norm()).epsilon(0.2));
    }
    const Region near = select_around(sphere, from, 0.5 * radius);
    for (Index v = 0; v < sphere.vertex_count(); ++v) {
        CHECK(near.contains(v) == (distance[v] <= 0.5 * radius));
    }
    Mesh two = make_grid();
    append(two, test::tetrahedron());
    const SurfacePoint on_grid = SpatialTree(two).nearest({0.21, 0, 0.13});
    CHECK(HeatDistances(two).from_point(on_grid).back() == test::kInfinity);
    CHECK(edge_distances(two, on_grid).back() == test::kInfinity);
}

TEST_CASE("distances from a point of the surface end at the limit, and are the same up to it") {
    const Mesh mesh = make_sphere({1.0, 12, SphereKind::triangles});
    const SurfacePoint point = SpatialTree(mesh).nearest({0.3, 0.8, 0.4});
    const std::vector<double> all = edge_distances(mesh, point);
    for (const double limit : {0.0, 0.05, 0.4, 1.0, 10.0}) {
        const std::vector<double> some = edge_distances(mesh, point, limit);
        for (std::size_t v = 0; v < all.size(); ++v) {
            CHECK(some[v] == (all[v] <= limit ? all[v] : test::kInfinity));
        }
    }
    CHECK(test::error_of([&] { (void)edge_distances(mesh, point, -1.0); }).code() ==
          ErrorCode::invalid_argument);
}
