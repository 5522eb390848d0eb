#include "kernel/mesh/measure/triangulation.h"

#include <random>

#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

std::vector<Triangle> triangulated(const std::vector<Vec3>& points) {
    std::vector<Triangle> triangles;
    triangulate_polygon(points, triangles);
    return triangles;
}

// Signed areas in the xy plane, smallest and sum.
std::pair<double, double> areas(const std::vector<Vec3>& points) {
    double smallest = test::kInfinity, sum = 0.0;
    for (const auto& [a, b, c] : triangulated(points)) {
        const double area = 0.5 * (points[b] - points[a]).cross(points[c] - points[a]).z();
        smallest = std::min(smallest, area);
        sum += area;
    }
    return {smallest, sum};
}

double shoelace(const std::vector<Vec3>& points) {
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 &a = points[i], &b = points[(i + 1) % points.size()];
        sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    return sum;
}

std::vector<Vec3> star(int spikes, double inner) {
    std::vector<Vec3> points;
    for (int i = 0; i < 2 * spikes; ++i) {
        const double r = i % 2 ? inner : 1.0, angle = kPi * i / spikes;
        points.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    }
    return points;
}

const std::vector<Vec3> kArrow{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5, 1, 0}};
const std::vector<Vec3> kComb{{0, 0, 0}, {7, 0, 0}, {7, 3, 0}, {6, 3, 0}, {6, 1, 0}, {5, 1, 0},
                              {5, 3, 0}, {4, 3, 0}, {4, 1, 0}, {3, 1, 0}, {3, 3, 0}, {2, 3, 0},
                              {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};

}  // namespace

TEST_CASE("concave polygons are covered exactly, without folds") {
    for (const auto& points : {kArrow, kComb, star(5, 0.3), star(12, 0.7)}) {
        CHECK(triangulated(points).size() == points.size() - 2);
        const auto [smallest, sum] = areas(points);
        CHECK(smallest > 0.0);
        CHECK(sum == Approx(shoelace(points)));
    }
}

TEST_CASE("points in line on a polygon's side give no folded triangle") {
    std::vector<Vec3> points;
    for (int i = 0; i < 4; ++i) points.emplace_back(i, 0, 0);
    for (int i = 0; i < 4; ++i) points.emplace_back(3, i + 1, 0);
    points.emplace_back(0, 4, 0);
    const auto [smallest, sum] = areas(points);
    CHECK(smallest >= 0.0);
    CHECK(sum == Approx(12.0));
}

TEST_CASE("a quad is split along its shorter valid diagonal") {
    CHECK(triangulated({{0, 0, 0}, {3, -1, 0}, {4, 0, 0}, {3, 1, 0}})[0] == Triangle{0, 1, 3});
    CHECK(triangulated({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})[0] == Triangle{0, 1, 2});
    // Of the arrow only the diagonal through its notch is inside.
    const auto [smallest, sum] = areas(kArrow);
    CHECK(smallest > 0.0);
}

TEST_CASE("the choice of triangles does not change under similarities") {
    test::Random random(3);
    for (const auto& points : {kArrow, kComb, star(7, 0.4)}) {
        const std::vector<Triangle> expected = triangulated(points);
        for (int i = 0; i < 20; ++i) {
            const Affine map = test::similarity(random, std::pow(10.0, random.uniform(-4, 4)));
            std::vector<Vec3> image;
            for (const Vec3& p : points) image.push_back(map(p));
            CHECK(triangulated(image) == expected);
        }
    }
}

TEST_CASE("triangles know their face and corners") {
    const Mesh mesh = test::patch();
    const Triangulation t = triangulate_faces(mesh.topology(), mesh.positions());
    REQUIRE(t.triangles.size() == 4);
    CHECK(t.face == std::vector<Index>{0, 1, 2, 2});
    for (std::size_t i = 0; i < t.triangles.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            CHECK(mesh.topology().faces().vertices[t.corners[i][k]] == t.triangles[i][k]);
        }
    }
}

TEST_CASE("triangulating a mesh keeps its shape and all it holds") {
    Mesh mesh = test::decorated(make_box({.segments = {3, 3, 3}}));
    const double area_before = area(mesh);
    const Index half = mesh.find_region("half")->size();
    triangulate(mesh);
    CHECK(mesh.topology().is_triangle_mesh());
    CHECK(mesh.face_count() == 108);
    CHECK(area(mesh) == Approx(area_before));
    CHECK(test::is_decorated(mesh));
    CHECK(mesh.find_region("half")->size() == half);
    CHECK(mesh.attributes().find("part")->at(1)[0] == 0.0);
    CHECK(mesh.attributes().find("part")->at(2)[0] == 10.0);
}

TEST_CASE("a triangle mesh is left as it is") {
    Mesh mesh = make_sphere({.segments = 2, .kind = SphereKind::triangles});
    const auto before = mesh.shared_topology();
    triangulate(mesh);
    CHECK(mesh.shared_topology() == before);
}

namespace {

// A lantern: `sides` polygons between two poles, with `between` corners on each of the lines that
// join them. The poles are near each other, so that the diagonal between them is the shortest of
// every polygon.
Mesh lantern(Index sides, Index between) {
    std::vector<Vec3> points{{0, 0.1, 0}, {0, -0.1, 0}};
    const auto corner = [&](Index side, Index k) { return 2 + (side % sides) * between + k; };
    for (Index side = 0; side < sides; ++side) {
        const double angle = 2.0 * kPi * side / sides;
        for (Index k = 0; k < between; ++k) {
            const double t = kPi * (k + 1) / (between + 1), r = std::sin(t);
            points.emplace_back(r * std::cos(angle), 0.1 * std::cos(t), r * std::sin(angle));
        }
    }
    FaceList faces;
    for (Index side = 0; side < sides; ++side) {
        std::vector<Index> face{0};
        for (Index k = 0; k < between; ++k) face.push_back(corner(side + 1, k));
        face.push_back(1);
        for (Index k = between; k > 0; --k) face.push_back(corner(side, k - 1));
        faces.add(face);
    }
    return {std::move(points), std::move(faces)};
}

}  // namespace

TEST_CASE("polygons that share a diagonal are split along others") {
    for (const Index sides : {2, 3, 5, 12}) {
        for (const Index between : {1, 2, 3, 7, 60, 140}) {
            CAPTURE(sides);
            CAPTURE(between);
            Mesh mesh = lantern(sides, between);
            triangulate(mesh);
            CHECK(mesh.topology().is_triangle_mesh());
            CHECK(mesh.topology().is_closed());
            CHECK(mesh.face_count() == sides * 2 * between);
        }
    }
}

TEST_CASE("polygons are not split along an edge that the mesh has") {
    for (const Index sides : {3, 4, 7}) {
        Mesh mesh = lantern(sides, 1);
        triangulate(mesh, std::vector<Index>{1});
        const std::span<const Index> ring = mesh.topology().neighbors(0);
        REQUIRE(std::find(ring.begin(), ring.end(), 1) != ring.end());
        triangulate(mesh);
        CHECK(mesh.face_count() == 2 * sides);
    }
}

TEST_CASE("chosen faces alone are triangulated") {
    Mesh mesh = make_box();
    triangulate(mesh, std::vector<Index>{1, 4});
    CHECK(mesh.face_count() == 8);
    const Error error = test::error_of([&] { triangulate(mesh, std::vector<Index>{8}); });
    CHECK(error.code() == ErrorCode::out_of_range);
    CHECK(error.elements().ids == std::vector<Index>{8});
}

namespace {

// The outline whose corner i has the radius radius(i) at the angle angle(i).
template <typename Radius, typename Angle>
std::vector<Vec3> polar_outline(Index n, const Radius& radius, const Angle& angle) {
    std::vector<Vec3> points;
    for (Index i = 0; i < n; ++i) {
        const double r = radius(i), a = angle(i);
        points.emplace_back(r * std::cos(a), r * std::sin(a), 0.0);
    }
    return points;
}

// Outlines of n corners, n even, that wind once around what they enclose.
std::vector<std::vector<Vec3>> large_outlines(Index n) {
    const auto around = [&](Index i) { return 2.0 * kPi * i / n; };
    std::vector<std::vector<Vec3>> outlines;
    outlines.push_back(polar_outline(
        n, [](Index) { return 1.0; }, around));
    outlines.push_back(polar_outline(
        n, [](Index i) { return i % 4 < 2 ? 1.0 : 0.9; }, around));
    outlines.push_back(polar_outline(
        n, [](Index i) { return i % 2 ? 1.0 : 1e-3; }, around));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0.5, 1.0);
    outlines.push_back(polar_outline(
        n, [&](Index) { return uniform(random); }, around));
    // A band wound up ten times, out and back.
    const auto place = [&](Index i) { return (i < n / 2 ? i : n - 1 - i) / (0.5 * n); };
    outlines.push_back(polar_outline(
        n, [&](Index i) { return (i < n / 2 ? 0.2 : 0.17) + place(i); },
        [&](Index i) { return 20.0 * kPi * place(i); }));
    return outlines;
}

}  // namespace

TEST_CASE("polygons of very many corners are triangulated without overlap, and soon") {
    for (const Index n : {34, 400, 4000, 100000}) {
        for (const std::vector<Vec3>& points : large_outlines(n)) {
            CAPTURE(n);
            CAPTURE(points[1]);
            double area = 0.0, total = 0.0;
            for (Index i = 0; i < n; ++i) area += 0.5 * points[i].cross(points[(i + 1) % n]).z();
            std::vector<Triangle> triangles;
            triangulate_polygon(points, triangles);
            CHECK(triangles.size() == static_cast<std::size_t>(n) - 2);
            for (const Triangle& t : triangles) {
                const Vec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
                total += 0.5 * (b - a).cross(c - a).norm();
            }
            CHECK(total == doctest::Approx(std::abs(area)).epsilon(1e-9));
        }
    }
}

TEST_CASE("outlines that cross themselves are triangulated, and soon") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<Vec3> points;
    for (int i = 0; i < 50000; ++i) {
        points.emplace_back(uniform(random), uniform(random), uniform(random));
    }
    std::vector<Triangle> triangles;
    triangulate_polygon(points, triangles);
    CHECK(triangles.size() == 49998);
    std::vector<int> used(points.size(), 0);
    for (const Triangle& t : triangles) {
        for (const Index corner : t) used[corner] = 1;
    }
    CHECK(std::count(used.begin(), used.end(), 1) == 50000);
}

TEST_CASE("large polygons without a plane have as many triangles as others") {
    for (const double scale : {0.0, 1.0}) {
        std::vector<Vec3> points;
        for (int i = 0; i < 5000; ++i) points.emplace_back(scale * i, 0.0, 0.0);
        std::vector<Triangle> triangles;
        triangulate_polygon(points, triangles);
        CHECK(triangles.size() == 4998);
    }
}
