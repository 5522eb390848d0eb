#include "kernel/mesh/query/spatial_tree.h"

#include <algorithm>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// The nearest point of a triangle by projection and, outside, by its three sides.
double distance_to_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
    const Vec3 n = (b - a).cross(c - a);
    const auto inside = [&](const Vec3& u, const Vec3& v) {
        return (v - u).cross(p - u).dot(n) >= 0.0;
    };
    if (n.norm() > 0.0 && inside(a, b) && inside(b, c) && inside(c, a)) {
        return std::abs((p - a).dot(n.normalized()));
    }
    double best = test::kInfinity;
    for (const auto& [u, v] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
        const double t =
            std::clamp((p - u).dot(v - u) / std::max((v - u).squaredNorm(), 1e-300), 0.0, 1.0);
        best = std::min(best, (u + t * (v - u) - p).norm());
    }
    return best;
}

double brute_force_distance(const Mesh& mesh, const Vec3& p) {
    double best = test::kInfinity;
    for (const auto& [a, b, c] : triangulate_faces(mesh.topology(), mesh.positions()).triangles) {
        best = std::min(
            best, distance_to_triangle(mesh.position(a), mesh.position(b), mesh.position(c), p));
    }
    return best;
}

// Distances along the ray to all triangles that it hits well inside, ascending.
std::vector<double> brute_force_hits(const Mesh& mesh, const Vec3& origin, const Vec3& direction) {
    std::vector<double> hits;
    for (const auto& [a, b, c] : triangulate_faces(mesh.topology(), mesh.positions()).triangles) {
        Mat3 system;
        system << mesh.position(b) - mesh.position(a), mesh.position(c) - mesh.position(a),
            -direction;
        if (std::abs(system.determinant()) < 1e-14) continue;
        const Vec3 x = system.inverse() * (origin - mesh.position(a));
        if (x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1 && x[2] >= 0) hits.push_back(x[2]);
    }
    std::sort(hits.begin(), hits.end());
    return hits;
}

void check_nearest(const Mesh& mesh, int queries, std::uint32_t seed) {
    const SpatialTree tree(mesh);
    test::Random random(seed);
    Box box = bounds(mesh);
    const Vec3 margin = 0.3 * (box.max - box.min);
    box.min -= margin;
    box.max += margin;
    const double size = box.diagonal();
    for (int i = 0; i < queries; ++i) {
        const Vec3 p = random.in_box(box);
        const SurfacePoint near = tree.nearest(p);
        CHECK(near.distance == Approx(brute_force_distance(mesh, p)).epsilon(1e-9));
        CHECK(std::abs((near.position - p).norm() - near.distance) < 1e-12 * size);
        CHECK(near.barycentric.minCoeff() >= 0.0);
        CHECK(near.barycentric.sum() == Approx(1.0));
        const auto face = mesh.topology().face(near.face);
        for (const Index v : near.triangle) {
            CHECK(std::find(face.begin(), face.end(), v) != face.end());
        }
    }
}

void check_pick(const Mesh& mesh, int queries, std::uint32_t seed) {
    const SpatialTree tree(mesh);
    test::Random random(seed);
    const Box box = bounds(mesh);
    for (int i = 0; i < queries; ++i) {
        const Vec3 origin = box.center() + box.diagonal() * random.direction();
        const Vec3 direction = (random.in_box(box) - origin).normalized();
        const std::vector<double> expected = brute_force_hits(mesh, origin, direction);
        const auto hit = tree.pick(origin, direction);
        REQUIRE(hit.has_value() == !expected.empty());
        if (!hit) continue;
        CHECK(hit->distance == Approx(expected[0]).epsilon(1e-9));
        CHECK((origin + hit->distance * direction - hit->position).norm() < 1e-9 * box.diagonal());
        CHECK(tree.pick_all(origin, direction).size() == expected.size());
    }
}

}  // namespace

TEST_CASE("nearest points are those of brute force") {
    check_nearest(make_sphere({.segments = 6}), 200, 1);
    check_nearest(make_torus({.segments = 20, .tube_segments = 10}), 200, 2);
    check_nearest(make_cactus({.vertices = 2000}), 60, 3);
    check_nearest(test::tetrahedron(), 200, 4);
    if (const auto lion = test::load_off("lion.off")) check_nearest(*lion, 30, 5);
}

TEST_CASE("ray hits are those of brute force") {
    check_pick(make_sphere({.segments = 6}), 200, 1);
    check_pick(make_torus({.segments = 20, .tube_segments = 10}), 200, 2);
    check_pick(make_cactus({.vertices = 2000}), 60, 3);
    if (const auto lion = test::load_off("lion.off")) check_pick(*lion, 30, 4);
}

TEST_CASE("rays through vertices and edges do not slip through") {
    for (const Mesh& mesh :
         {make_sphere({.segments = 7}), make_sphere({.segments = 5, .kind = SphereKind::triangles}),
          make_box({.segments = {3, 4, 5}})}) {
        const SpatialTree tree(mesh);
        test::Random random(7);
        for (Index e = 0; e < mesh.topology().edge_count(); ++e) {
            const auto [a, b] = mesh.topology().edge(e);
            for (const double t : {0.0, 0.5, random.uniform(0, 1), 1.0}) {
                const Vec3 target = (1 - t) * mesh.position(a) + t * mesh.position(b);
                // From inside every direction hits a closed surface.
                CHECK(tree.pick(0.1 * random.direction(), target).has_value());
                CHECK(tree.pick(Vec3::Zero(), target).has_value());
            }
        }
    }
}

TEST_CASE("axis-parallel rays along the grid of a box hit it") {
    const Mesh mesh = make_box({.segments = {4, 4, 4}});
    const SpatialTree tree(mesh);
    for (int i = 0; i <= 4; ++i) {
        for (int j = 0; j <= 4; ++j) {
            const auto hit = tree.pick(Vec3(-0.5 + 0.25 * i, -0.5 + 0.25 * j, 5), Vec3(0, 0, -3));
            REQUIRE(hit);
            CHECK(hit->distance == Approx(4.5));
        }
    }
}

TEST_CASE("exact ties go to the smallest face") {
    const Mesh mesh = make_grid({.size = {2, 2}, .segments = {2, 2}});
    const SpatialTree tree(mesh);
    const SurfacePoint near = tree.nearest(Vec3(0, 1, 0));
    CHECK(near.face == 0);
    CHECK(near.vertex == 4);
    CHECK(near.distance == 1.0);
    CHECK(tree.pick(Vec3(0, 1, 0), Vec3(0, -1, 0))->face == 0);
    // All hits at one distance, in the order of the faces.
    Index last = -1;
    for (const SurfacePoint& hit : tree.pick_all(Vec3(0, 1, 0), Vec3(0, -1, 0))) {
        CHECK(hit.face >= last);
        last = hit.face;
    }
    CHECK(last == 3);
}

TEST_CASE("hits from behind count and carry the triangle's normal") {
    const SpatialTree tree(make_sphere({.segments = 8}));
    const auto inside = tree.pick(Vec3::Zero(), Vec3(1, 0.1, 0.05));
    REQUIRE(inside);
    CHECK(inside->normal.dot(Vec3(1, 0, 0)) > 0.9);
    CHECK(!tree.pick(Vec3(5, 0, 0), Vec3(1, 0, 0)));
    CHECK(tree.pick(Vec3(5, 0, 0), Vec3(-1e-200, 0, 0)).has_value());
}

TEST_CASE("the search within a limit stops at it") {
    const SpatialTree tree(make_sphere({.segments = 16}));
    CHECK(!tree.nearest_within(Vec3(3, 0, 0), 1.9));
    REQUIRE(tree.nearest_within(Vec3(3, 0, 0), 2.1));
    CHECK(tree.nearest_within(Vec3(3, 0, 0), 2.1)->distance == Approx(2.0));
    CHECK(!tree.nearest_within(Vec3(3, 0, 0), -1.0));
}

TEST_CASE("triangles without area are found as segments") {
    FaceList faces;
    faces.add({0, 1, 2});
    faces.add({1, 3, 2});
    const Mesh mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}}, std::move(faces));
    const SpatialTree tree(mesh);
    CHECK(tree.nearest(Vec3(0.3, 1, 0)).distance == Approx(1.0));
    CHECK(tree.nearest(Vec3(0.3, 1, 0)).normal == Vec3::Zero());
    CHECK(!tree.pick(Vec3(0.3, 1, 0), Vec3(0, -1, 0)));
}

TEST_CASE("many equal triangles do not overflow the tree") {
    FaceList faces;
    std::vector<Vec3> positions;
    for (Index i = 0; i < 3000; ++i) {
        positions.insert(positions.end(), {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)});
        faces.add({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const SpatialTree tree(Mesh(std::move(positions), std::move(faces)));
    CHECK(tree.nearest(Vec3(0.2, 0.2, 1)).face == 0);
    CHECK(tree.pick(Vec3(0.2, 0.2, 1), Vec3(0, 0, -1))->face == 0);
}

TEST_CASE("queries are the same after a similarity, up to its scale") {
    const Mesh mesh = make_torus({.segments = 20, .tube_segments = 10});
    const SpatialTree tree(mesh);
    test::Random random(8);
    const Affine map = test::similarity(random, 1e4);
    const SpatialTree image(test::moved(mesh, map));
    for (int i = 0; i < 100; ++i) {
        const Vec3 p = 2.0 * random.direction();
        CHECK(image.nearest(map(p)).distance == Approx(1e4 * tree.nearest(p).distance));
    }
}

TEST_CASE("a tree is an image of one revision and is charged to the context") {
    const Context context;
    Mesh mesh = make_box();
    mesh.set_position(0, Vec3(-1, -1, -1));
    {
        const SpatialTree tree(mesh, context);
        CHECK(tree.revision() == mesh.revision());
        CHECK(context.memory()->used() >= tree.memory_bytes());
        mesh.set_position(0, Vec3(-2, -1, -1));
        CHECK(tree.revision() != mesh.revision());
        CHECK(tree.bounds().min == Vec3(-1, -1, -1));
    }
    CHECK(context.memory()->used() == 0);
}

TEST_CASE("queries without sense are refused") {
    const auto code = [](const auto& action) { return test::error_of(action).code(); };
    const SpatialTree tree(make_box());
    CHECK(code([&] { (void)tree.pick(Vec3::Zero(), Vec3::Zero()); }) ==
          ErrorCode::invalid_argument);
    CHECK(code([&] { (void)tree.pick(Vec3(test::kNaN, 0, 0), Vec3::UnitX()); }) ==
          ErrorCode::not_finite);
    CHECK(code([&] { (void)tree.nearest(Vec3(0, test::kInfinity, 0)); }) == ErrorCode::not_finite);
    CHECK(code([] { SpatialTree{Mesh()}; }) == ErrorCode::mesh_empty);
}
