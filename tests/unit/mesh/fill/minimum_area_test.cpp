#include "kernel/mesh/fill/minimum_area.h"

#include <functional>
#include <numeric>

#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/fill/fill.h"
#include "kernel/mesh/fill/hole_triangulation.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using namespace lissom::test;
using doctest::Approx;

namespace {

double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.5 * (b - a).cross(c - a).norm();
}

double area_of(std::span<const Vec3> loop, std::span<const Triangle> triangles) {
    double sum = 0.0;
    for (const auto& [a, b, c] : triangles) sum += triangle_area(loop[a], loop[b], loop[c]);
    return sum;
}

// The least area of all triangulations of the part from i to k, by trying all.
double min_area(std::span<const Vec3> loop, std::size_t i, std::size_t k) {
    double least = k - i < 2 ? 0.0 : kInfinity;
    for (std::size_t m = i + 1; m < k; ++m) {
        least = std::min(least, min_area(loop, i, m) + min_area(loop, m, k) +
                                    triangle_area(loop[i], loop[m], loop[k]));
    }
    return least;
}

// The same by a table.
double min_area_by_table(std::span<const Vec3> loop) {
    const std::size_t n = loop.size();
    std::vector<double> cost(n * n, 0.0);
    for (std::size_t length = 2; length < n; ++length) {
        for (std::size_t i = 0; i + length < n; ++i) {
            const std::size_t k = i + length;
            double least = kInfinity;
            for (std::size_t m = i + 1; m < k; ++m) {
                least = std::min(least, cost[i * n + m] + cost[m * n + k] +
                                            triangle_area(loop[i], loop[m], loop[k]));
            }
            cost[i * n + k] = least;
        }
    }
    return cost[n - 1];
}

// A wavy loop of `n` points.
std::vector<Vec3> wavy_loop(Index n, double height) {
    std::vector<Vec3> loop;
    for (Index i = 0; i < n; ++i) {
        const double angle = 2.0 * kPi * i / n, r = 1.0 + 0.3 * std::sin(5.0 * angle);
        loop.emplace_back(r * std::cos(angle), r * std::sin(angle), height * std::sin(3.0 * angle));
    }
    return loop;
}

// Every edge of the loop once in its direction, every other edge once each way.
void check_closes(std::span<const Triangle> triangles, Index n) {
    REQUIRE(count_of(triangles) == n - 2);
    std::map<std::pair<Index, Index>, int> balance;
    for (const Triangle& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    }
    for (const auto& [edge, sum] : balance) {
        const auto [a, b] = edge;
        CHECK(sum == (b - a == 1 ? 1 : a == 0 && b == n - 1 ? -1 : 0));
    }
}

}  // namespace

TEST_CASE("the least area of all triangulations is found") {
    Random random(4);
    for (int trial = 0; trial < 60; ++trial) {
        std::vector<Vec3> loop(at(random.index(8) + 3));
        for (Vec3& p : loop) p = random.in_box({Vec3(0, 0, 0), Vec3(1, 1, 1)});
        const std::vector<Triangle> triangles = minimum_area_triangles(loop);
        check_closes(triangles, count_of(loop));
        CHECK(area_of(loop, triangles) == Approx(min_area(loop, 0, loop.size() - 1)).epsilon(1e-3));
    }
}

TEST_CASE("a flat outline that is not convex is filled inside, without slivers") {
    const std::vector<Vec3> loop = wavy_loop(200, 0.0);
    const std::vector<Triangle> triangles = minimum_area_triangles(loop);
    check_closes(triangles, 200);
    double enclosed = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        enclosed += 0.5 * loop[i].cross(loop[(i + 1) % loop.size()]).z();
    }
    CHECK(area_of(loop, triangles) == Approx(enclosed));
    for (const auto& [a, b, c] : triangles) {
        CHECK((loop[b] - loop[a]).cross(loop[c] - loop[a]).z() > 1e-6);
    }
}

TEST_CASE("a long loop is closed with about the least area") {
    for (const Index n : {301, 360, 601}) {
        for (const double height : {0.0, 0.3, 1.5}) {
            const std::vector<Vec3> loop = wavy_loop(n, height);
            const std::vector<Triangle> triangles = minimum_area_triangles(loop);
            check_closes(triangles, n);
            const double least = min_area_by_table(loop);
            CHECK(area_of(loop, triangles) < 1.01 * least);
        }
    }
    check_closes(minimum_area_triangles(wavy_loop(20001, 0.5)), 20001);
}

TEST_CASE("chords that are taken are not used") {
    for (const Index n : {8, 60, 400}) {
        const std::vector<Vec3> loop = wavy_loop(n, 0.4);
        const auto taken = [&](Index i, Index k) {
            const Index apart = std::min(k - i, n - (k - i));
            return apart == 2 && i % 3 == 0;
        };
        const std::vector<Triangle> triangles = minimum_area_triangles(loop, taken);
        check_closes(triangles, n);
        for (const Triangle& t : triangles) {
            for (int k = 0; k < 3; ++k) {
                const Index a = std::min(t[k], t[(k + 1) % 3]), b = std::max(t[k], t[(k + 1) % 3]);
                if (b - a > 1 && !(a == 0 && b == n - 1)) CHECK(!taken(a, b));
            }
        }
    }
    CHECK(minimum_area_triangles(wavy_loop(5, 0.0), [](Index, Index) { return true; }).empty());
}

TEST_CASE("a loop of one point, of a line, or of two points") {
    check_closes(minimum_area_triangles(std::vector<Vec3>(12, Vec3(1, 1, 1))), 12);
    std::vector<Vec3> line;
    for (int i = 0; i < 9; ++i) line.emplace_back(i, 0, 0);
    check_closes(minimum_area_triangles(line), 9);
    CHECK(error_of([] { minimum_area_triangles(std::vector<Vec3>(2)); }).code() ==
          ErrorCode::invalid_argument);
}

TEST_CASE("a hole is filled with the least area, and refined if wanted") {
    const Mesh sphere = make_sphere({.segments = 16});
    Mesh open = remove(sphere, select_plane(sphere, Vec3(0, 0.6, 0), Vec3(0, 1, 0))).mesh;
    for (Vec3& p : open.edit_positions()) p.y() += 0.4 * p.x() * p.x() - 0.4 * p.z() * p.z();
    Mesh by_area = open, by_angle = open, refined = open;
    const Path hole = boundaries(open)[0];
    const FillReport report =
        fill(by_area, hole, {.method = FillMethod::area, .subdivide = false, .fair = false});
    fill(by_angle, hole, {.subdivide = false, .fair = false});
    CHECK(by_area.topology().is_closed());
    CHECK(report.face_count == report.loop_size - 2);
    CHECK(report.vertex_count == 0);
    CHECK(area(by_area) <= area(by_angle) * (1.0 + 1e-9));
    fill(refined, hole, {.method = FillMethod::area});
    CHECK(refined.topology().is_closed());
    CHECK(refined.vertex_count() > by_area.vertex_count());
}

TEST_CASE("a hole is not filled by an edge that the mesh has") {
    // A hole 0 1 2 3, with the shorter of its diagonals as an edge.
    FaceList faces;
    faces.add({0, 1, 4});
    faces.add({1, 2, 4});
    faces.add({2, 0, 4});
    faces.add({0, 2, 3});
    Mesh mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}}, std::move(faces));
    REQUIRE(boundaries(mesh)[0].size() == 4);
    fill(mesh, boundaries(mesh)[0],
         {.method = FillMethod::area, .subdivide = false, .fair = false});
    CHECK(mesh.topology().is_closed());
    CHECK(mesh.face_count() == 6);
}

TEST_CASE("a hole whose chords are all edges already is filled around a new vertex") {
    const Mesh open = tetrahedron();
    HolePatch patch(open);
    const std::vector<Index> loop{0, 1, 2, 3};
    triangulate_hole_by_area(patch, loop, {});
    CHECK(patch.new_vertex_count() == 1);
    CHECK(patch.triangles().size() == 4);
}
