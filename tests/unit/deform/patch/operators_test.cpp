#include "kernel/deform/patch/operators.h"

#include <algorithm>
#include <cmath>

#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

WeightedTriangles all_triangles(const Mesh& mesh) {
    std::vector<Index> faces;
    for (Index f = 0; f < mesh.face_count(); ++f) faces.push_back(f);
    return weighted_triangles(mesh.topology(), mesh.positions(), faces);
}

struct Operators {
    std::vector<Vec3> positions;
    WeightedTriangles triangles;
    Rings rings;
    RingGeometry geometry;

    explicit Operators(const Mesh& mesh)
        : positions(mesh.positions().begin(), mesh.positions().end()),
          triangles(all_triangles(mesh)),
          rings(build_rings(mesh.vertex_count(), triangles)),
          geometry(ring_geometry(rings, triangles, positions)) {}
};

}  // namespace

TEST_CASE("laplacian: of positions on a sphere it points inwards with length 2 / radius") {
    SphereOptions options;
    options.radius = 2.0;
    options.segments = 24;
    const Operators o(make_sphere(options));
    const Laplacian l = make_laplacian(o.rings, o.geometry, LaplacianWeights::cotangent, true);
    double error = 0.0;
    for (Index i = 0; i < o.rings.size(); ++i) {
        const Vec3 expected = -2.0 / 4.0 * o.positions[i];
        error += (l.apply(o.rings, o.positions, i) - expected).norm() * o.geometry.area[i];
    }
    CHECK(error / (16.0 * kPi) < 0.05);
}

TEST_CASE("laplacian: zero on positions of an irregular plane, away from its border") {
    GridOptions options;
    options.segments = {12, 9};
    Mesh grid = make_grid(options);
    for (Vec3& p : grid.edit_positions()) {
        p.x() += 0.02 * std::sin(40.0 * p.z());
        p.z() += 0.02 * std::sin(55.0 * p.x());
    }
    const Operators o(grid);
    const Laplacian l = make_laplacian(o.rings, o.geometry, LaplacianWeights::cotangent, true);
    for (Index i = 0; i < o.rings.size(); ++i) {
        if (grid.topology().is_boundary(i)) continue;
        CHECK(l.apply(o.rings, o.positions, i).norm() < 1e-10);
    }
}

TEST_CASE("laplacian: constants are in its kernel, for both weights") {
    const Operators o(make_torus());
    for (const LaplacianWeights weights :
         {LaplacianWeights::cotangent, LaplacianWeights::uniform}) {
        const Laplacian l = make_laplacian(o.rings, o.geometry, weights, true);
        for (Index i = 0; i < o.rings.size(); ++i) {
            double sum = l.self[i];
            for (Index e = o.rings.begin[i]; e < o.rings.begin[i + 1]; ++e) sum += l.neighbor[e];
            CHECK(std::abs(sum) < 1e-9 * std::abs(l.self[i]));
        }
    }
}

TEST_CASE("areas: the mixed Voronoi areas share out the surface") {
    const Mesh mesh = make_torus();
    const Operators o(mesh);
    double sum = 0.0;
    for (const double a : o.geometry.area) sum += a;
    CHECK(sum == doctest::Approx(area(mesh)).epsilon(1e-9));
}

TEST_CASE("cotangents: collapsed and needle triangles stay finite and bounded") {
    const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}, {2, 0, 0}};
    const WeightedTriangles triangles{
        {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}, {1.0, 1.0, 1.0}, {0, 1, 2}};
    const Rings rings = build_rings(5, triangles);
    const RingGeometry g = ring_geometry(rings, triangles, p);
    const double bound = 3.0 / std::tan(0.5 * kPi / 180.0);
    for (const double c : g.cotangent) CHECK(std::abs(c) <= bound);
    for (const double a : g.area) CHECK(a > 0.0);
}

TEST_CASE("surface radius: a sphere's is its radius, wherever it lies") {
    Mesh sphere = make_sphere({3.0, 32, SphereKind::triangles});
    for (Vec3& p : sphere.edit_positions()) p += Vec3(100.0, -7.0, 3.0);
    const Operators o(sphere);
    CHECK(surface_radius_of(o.triangles, o.positions) == doctest::Approx(3.0).epsilon(2e-3));
    CHECK(surface_radius_of(o.triangles, o.positions) ==
          doctest::Approx(surface_radius(sphere)).epsilon(1e-9));
}

TEST_CASE("patch: the order by nearness has every vertex once, and neighbours near each other") {
    SphereOptions options;
    options.segments = 40;
    const Mesh mesh = make_sphere(options);
    const Region all = Region::all(mesh.shared_topology());
    const std::vector<Index> order = near_order(all, 1);
    std::vector<Index> place(static_cast<std::size_t>(mesh.vertex_count()), kNoIndex);
    for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<Index>(i);
    CHECK(std::count(place.begin(), place.end(), kNoIndex) == 0);
    const auto farthest = [&](const auto& at) {
        Index greatest = 0;
        for (Index e = 0; e < mesh.topology().edge_count(); ++e) {
            const auto [a, b] = mesh.topology().edge(e);
            greatest = std::max(greatest, std::abs(at(a) - at(b)));
        }
        return greatest;
    };
    CHECK(4 * farthest([&](Index v) { return place[v]; }) < farthest([](Index v) { return v; }));
    const Patch patch = build_patch(all, mesh.positions(), 1, order);
    for (Index row = 0; row < all.size(); ++row) {
        CHECK(patch.mesh_vertex[patch.of_region[row]] == all.vertices()[row]);
    }
}
