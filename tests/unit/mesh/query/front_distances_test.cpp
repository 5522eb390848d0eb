#include "kernel/mesh/query/front_distances.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// A flat square whose inner vertices are moved at random, by less than folds a triangle.
Mesh shuffled_square(Index n, std::uint32_t seed) {
    Mesh mesh = make_grid({.segments = {n, n}});
    test::Random random(seed);
    for (Vec3& p : mesh.edit_positions()) {
        if (std::max(std::abs(p.x()), std::abs(p.z())) > 0.499) continue;
        p.x() += random.uniform(-0.2, 0.2) / n;
        p.z() += random.uniform(-0.2, 0.2) / n;
    }
    triangulate(mesh);
    return mesh;
}

// The farthest that `distance` is from arcs of the unit sphere, as a share of half way around.
double worst_on_sphere(const Mesh& mesh, Index source, const std::vector<double>& distance) {
    double worst = 0.0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const double cosine = mesh.position(v).dot(mesh.position(source));
        worst = std::max(worst, std::abs(distance[v] - std::acos(std::clamp(cosine, -1.0, 1.0))));
    }
    return worst / kPi;
}

}  // namespace

TEST_CASE("a front over a flat square is exact, from vertices and from points") {
    for (const std::uint32_t seed : {1u, 2u, 3u, 4u, 5u}) {
        const Mesh square = shuffled_square(17, seed);
        const Index source = index_of(seed * 50);
        const std::vector<double> from_vertex = front_distances(square, std::array{source});
        const SurfacePoint point = SpatialTree(square).nearest(Vec3(0.11, 0.3, -0.07 * seed));
        const std::vector<double> from_point = front_distances(square, point);
        for (Index v = 0; v < square.vertex_count(); ++v) {
            const Vec3& at = square.position(v);
            CHECK(from_vertex[v] == Approx((at - square.position(source)).norm()).epsilon(1e-9));
            CHECK(from_point[v] == Approx((at - point.position).norm()).epsilon(1e-9));
        }
    }
}

TEST_CASE("a front over a sphere is about as near to the arcs as heat, and converges") {
    double last = 1.0;
    for (const Index segments : {12, 24, 48}) {
        const Mesh mesh = make_sphere({.segments = segments, .kind = SphereKind::triangles});
        const double front = worst_on_sphere(mesh, 17, front_distances(mesh, std::array{17}));
        CHECK(front < 0.7 * last);
        CHECK(front < 1.5 * worst_on_sphere(mesh, 17, heat_distances(mesh, std::array{17})));
        last = front;
    }
    CHECK(last < 0.006);
}

TEST_CASE("a front is nowhere longer than the way along edges nor shorter than straight") {
    const Mesh torus = make_torus();
    const std::array sources{3, 250};
    const std::vector<double> front = front_distances(torus, sources);
    const std::vector<double> edges = edge_distances(torus, sources);
    for (Index v = 0; v < torus.vertex_count(); ++v) {
        const auto straight = [&](Index s) {
            return (torus.position(v) - torus.position(s)).norm();
        };
        CHECK(front[v] <= edges[v] + 1e-12);
        CHECK(front[v] >= std::min(straight(3), straight(250)) - 1e-12);
    }
}

TEST_CASE("a front from several sources is the nearest of each alone") {
    const Mesh square = shuffled_square(15, 9);
    const std::array<Index, 3> sources{0, 100, 230};
    const std::vector<double> front = front_distances(square, sources);
    for (Index v = 0; v < square.vertex_count(); ++v) {
        double nearest = test::kInfinity;
        for (const Index s : sources) {
            nearest = std::min(nearest, (square.position(v) - square.position(s)).norm());
        }
        // Where two fronts meet, a way past the other's ground is only known along edges.
        CHECK(front[v] >= nearest - 1e-12);
        CHECK(front[v] <= nearest * 1.06 + 1e-12);
    }
}

TEST_CASE("a front ends at its limit and at components, and refuses what makes no sense") {
    Mesh mesh = make_grid({.size = {10, 1}, .segments = {10, 1}});
    append(mesh, test::tetrahedron());
    const std::vector<double> distance = front_distances(mesh, std::array{0}, 4.0);
    CHECK(distance[4] == Approx(4.0));
    CHECK(distance[5] == test::kInfinity);
    CHECK(distance.back() == test::kInfinity);
    const auto code = [&](std::span<const Index> sources, double limit) {
        return test::error_of([&] { (void)front_distances(mesh, sources, limit); }).code();
    };
    CHECK(code(std::array{0}, -1.0) == ErrorCode::invalid_argument);
    CHECK(code({}, 1.0) == ErrorCode::invalid_argument);
    CHECK(code(std::array{-1}, 1.0) == ErrorCode::out_of_range);
}

TEST_CASE("a front over collapsed triangles stays finite") {
    Mesh mesh = make_grid({.segments = {8, 8}});
    for (Vec3& p : mesh.edit_positions()) p.x() = std::round(2.0 * p.x()) / 2.0;
    const std::vector<double> front = front_distances(mesh, std::array{0});
    for (const double d : front) CHECK(std::isfinite(d));
    CHECK(front.back() == Approx(std::sqrt(2.0)).epsilon(0.3));
}
