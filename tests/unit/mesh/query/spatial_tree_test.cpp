#include "kernel/mesh/query/spatial_tree.h"

#include <algorithm>
#include <random>

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

bool same_point(const SurfacePoint& a, const SurfacePoint& b) {
    return a.face == b.face && a.triangle == b.triangle && a.barycentric == b.barycentric &&
           a.position == b.position && a.distance == b.distance && a.vertex == b.vertex &&
           a.normal == b.normal;
}

// Queries of both trees around the mesh, nearest points and rays, must be equal to the bit.
void check_same_answers(const SpatialTree& tree, const SpatialTree& expected, std::uint32_t seed) {
    REQUIRE(tree.bounds().min == expected.bounds().min);
    REQUIRE(tree.bounds().max == expected.bounds().max);
    test::Random random(seed);
    const Box box = expected.bounds();
    for (int i = 0; i < 60; ++i) {
        const Vec3 from = box.center() + box.diagonal() * random.direction();
        CHECK(same_point(tree.nearest(from), expected.nearest(from)));
        const Vec3 towards = random.in_box(box) - from;
        const auto hits = tree.pick_all(from, towards), others = expected.pick_all(from, towards);
        CHECK(std::equal(hits.begin(), hits.end(), others.begin(), others.end(), same_point));
        const auto first = tree.pick(from, towards);
        REQUIRE(first.has_value() == !others.empty());
        if (first) CHECK(same_point(*first, others[0]));
    }
}

// A twist about y by `turns`, noise as a fraction of the size, then a similarity.
Mesh deformed(const Mesh& mesh, double turns, double noise, const Affine& map, std::uint32_t seed) {
    Mesh result = mesh;
    test::Random random(seed);
    const double size = bounds(mesh).diagonal();
    for (Vec3& p : result.edit_positions()) {
        p = rotation(Vec3::UnitY(), turns * 2.0 * kPi * p.y() / size, Vec3::Zero())(p);
        p = map(p + noise * size * random.direction());
    }
    return result;
}

// Two triangles to a square in the xy plane, and squares and pentagons that are divided another way
// once they are bent.
Mesh mixed_polygons() {
    FaceList faces;
    std::vector<Vec3> positions;
    for (Index i = 0; i <= 20; ++i) {
        for (const double y : {0.0, 1.0}) positions.emplace_back(i, y, 0.0);
    }
    for (Index i = 0; i < 20; ++i) {
        const Index a = 2 * i, b = a + 2, c = a + 3, d = a + 1;
        if (i % 3 == 0) {
            faces.add({a, b, c});
            faces.add({a, c, d});
        } else if (i % 3 == 1) {
            faces.add({a, b, c, d});
        } else {
            const Index apex = count_of(positions);
            positions.emplace_back(i + 0.5, 1.5, 0.0);
            faces.add({a, b, c, apex, d});
        }
    }
    return Mesh(std::move(positions), std::move(faces));
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

TEST_CASE("a refitted tree gives the answers of a new one") {
    test::Random random(11);
    const Affine far = translation(Vec3(3e7, -1e7, 2e7)) * test::similarity(random, 0.01);
    for (const Mesh& mesh : {make_torus({.segments = 40, .tube_segments = 20}),
                             make_box({.segments = {5, 6, 7}}), mixed_polygons()}) {
        SpatialTree tree(mesh);
        std::uint32_t seed = 20;
        for (const Affine& map : {Affine{}, test::similarity(random, 1e3), far}) {
            for (const double turns : {0.0, 0.2, 3.0}) {
                for (const double noise : {0.0, 0.01, 0.5}) {
                    CAPTURE(turns);
                    CAPTURE(noise);
                    const Mesh moved = deformed(mesh, turns, noise, map, ++seed);
                    tree.refit(moved);
                    CHECK(tree.revision() == moved.revision());
                    check_same_answers(tree, SpatialTree(moved), seed);
                }
            }
        }
    }
}

TEST_CASE("a tree that is refitted to a point and back is as new") {
    const Mesh mesh = make_sphere({.segments = 8});
    SpatialTree tree(mesh);
    Mesh point = mesh;
    for (Vec3& p : point.edit_positions()) p = Vec3(1, 2, 3);
    tree.refit(point);
    CHECK(tree.wear() == 1.0);
    CHECK(tree.nearest(Vec3(1, 2, 5)).distance == Approx(2.0));
    tree.refit(mesh);
    CHECK(tree.wear() == Approx(1.0));
    check_same_answers(tree, SpatialTree(mesh), 30);
}

TEST_CASE("a tree tells its wear: motions leave it as it is, scattered triangles wear it out") {
    const Mesh mesh = make_sphere({.segments = 24});
    test::Random random(12);
    SpatialTree tree(mesh);
    CHECK(tree.wear() == 1.0);
    tree.refit(deformed(mesh, 0.0, 0.0, scaling(Vec3::Constant(7.0), Vec3::Zero()), 1));
    CHECK(tree.wear() == Approx(1.0));
    tree.refit(deformed(mesh, 0.1, 0.0, {}, 1));
    CHECK(tree.wear() < 1.5);
    double last = 1.0;
    for (const double noise : {0.02, 0.1, 0.5}) {
        tree.refit(deformed(mesh, 0.0, noise, {}, 1));
        CHECK(tree.wear() > last);
        last = tree.wear();
    }
    // Two halves of the triangles that lay mixed fly apart.
    FaceList faces;
    std::vector<Vec3> positions;
    for (Index i = 0; i < 2000; ++i) {
        const Vec3 corner = random.in_box({Vec3::Zero(), Vec3::Ones()});
        for (int k = 0; k < 3; ++k) positions.push_back(corner + 0.01 * random.direction());
        faces.add({3 * i, 3 * i + 1, 3 * i + 2});
    }
    Mesh dust(std::move(positions), std::move(faces));
    SpatialTree dust_tree(dust);
    for (Index v = 0; v < dust.vertex_count(); ++v) {
        if (v / 3 % 2 == 0) dust.set_position(v, dust.position(v) + Vec3(20, 0, 0));
    }
    dust_tree.refit(dust);
    CHECK(dust_tree.wear() > 4.0);
    check_same_answers(dust_tree, SpatialTree(dust), 31);
}

TEST_CASE("a refit that is refused or cancelled leaves the tree as it was") {
    const Context context;
    Mesh mesh = make_box({.segments = {3, 3, 3}});
    SpatialTree tree(mesh, context);
    const Mesh other = make_box({.segments = {3, 3, 3}});
    CHECK(test::error_of([&] { tree.refit(other); }).code() == ErrorCode::topology_mismatch);
    const Mesh before = mesh;
    const auto revision = mesh.revision();
    for (Vec3& p : mesh.edit_positions()) p *= 2.0;
    context.cancel();
    CHECK(test::error_of([&] { tree.refit(mesh, context); }).code() == ErrorCode::cancelled);
    CHECK(tree.revision() == revision);
    check_same_answers(tree, SpatialTree(before), 32);
}

TEST_CASE("rays have a limit, and may pass through triangles from behind") {
    const SpatialTree tree(make_sphere({.segments = 16}));
    const Vec3 from(3, 0.1, 0.2), towards(-1, 0, 0);
    const auto first = tree.pick(from, towards);
    REQUIRE(first);
    CHECK(!tree.pick(from, towards, {.limit = 0.99 * first->distance}));
    CHECK(tree.pick(from, towards, {.limit = first->distance})->face == first->face);
    CHECK(tree.pick(from, towards, {.back_faces = false})->face == first->face);
    CHECK(tree.pick(Vec3::Zero(), towards));
    CHECK(!tree.pick(Vec3::Zero(), towards, {.back_faces = false}));
}

TEST_CASE("of a convex surface those vertices are hidden none of whose faces is seen") {
    test::Random random(13);
    const std::vector<Affine> places{
        {}, translation(Vec3(1e6, -3e6, 2e6)), scaling(Vec3(1.0, 1e-5, 1.0), Vec3::Zero())};
    for (const Mesh& shape : {test::tetrahedron(), make_box({.segments = {4, 5, 6}}),
                              make_cylinder({.segments = 17})}) {
        for (const Affine& place : places) {
            const Mesh mesh = test::moved(shape, place);
            const SpatialTree tree(mesh);
            const std::vector<Vec3> normals = face_normals(mesh);
            const double size = bounds(mesh).diagonal();
            int hidden = 0, visible = 0;
            for (int i = 0; i < 60; ++i) {
                // Eyes nearly in the plane of a face, on either side of it.
                const Index f = random.index(mesh.face_count());
                const Vec3 along = normals[f].cross(random.direction()).normalized();
                const double lift = std::pow(10.0, random.uniform(-5.0, 0.0));
                const Vec3 eye = mesh.position(mesh.topology().face(f)[0]) +
                                 size * (3.0 * along + (i % 2 == 0 ? lift : -lift) * normals[f]);
                for (Index v = 0; v < mesh.vertex_count(); ++v) {
                    const Vec3 towards = eye - mesh.position(v);
                    double best = -1.0;
                    for (const Index g : mesh.topology().faces_around(v)) {
                        best = std::max(best, normals[g].dot(towards.normalized()));
                    }
                    if (std::abs(best) < 1e-7) continue;
                    ++(best < 0.0 ? hidden : visible);
                    CHECK(tree.hides(mesh.position(v), towards, {.eye = towards.norm()}) ==
                          (best < 0.0));
                }
            }
            CHECK(hidden > 10);
            CHECK(visible > 50);
        }
    }
}

TEST_CASE("a point is hidden by what lies between it and the eye, and by nothing beyond") {
    const SpatialTree tree(make_grid({.size = {2, 2}, .segments = {2, 2}}));
    const Vec3 up = Vec3::UnitY(), below(0.3, -1, 0.2), above(0.3, 1, 0.2);
    CHECK(tree.hides(below, up));
    CHECK(tree.hides(below, up, {.eye = 1.5}));
    CHECK(!tree.hides(below, up, {.eye = 0.5}));
    CHECK(!tree.hides(below, up, {.slack = 1.1}));
    CHECK(!tree.hides(below, up, {.touching = 1.1}));
    CHECK(tree.hides(below, up, {.back_faces = false}));
    CHECK(tree.hides(above, -up));
    CHECK(!tree.hides(above, -up, {.back_faces = false}));
    CHECK(!tree.hides(above, up));
}

TEST_CASE("a nearest point whose distance has no square is an error, not a triangle") {
    for (const double size : {1e155, 1e300}) {
        CAPTURE(size);
        Mesh ball = make_sphere({.segments = 3});
        for (Vec3& p : ball.edit_positions()) p *= size;
        const SpatialTree tree(ball);
        CHECK(test::error_of([&] { tree.nearest(3.0 * size * Vec3::UnitX()); }).code() ==
              ErrorCode::not_finite);
    }
    const SpatialTree tree(make_sphere({.segments = 3}));
    CHECK(test::error_of([&] { tree.nearest(1e160 * Vec3::UnitX()); }).code() ==
          ErrorCode::not_finite);
    CHECK(tree.nearest(1e150 * Vec3::UnitX()).distance == doctest::Approx(1e150));
}

TEST_CASE("trees of surfaces as far apart as numbers reach are built") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (const double far : {1e150, 1e300, 1.7e308}) {
        std::vector<Vec3> points;
        FaceList faces;
        for (Index f = 0; f < 500; ++f) {
            for (int k = 0; k < 3; ++k) {
                points.emplace_back(far * uniform(random), far * uniform(random), uniform(random));
            }
            faces.add({3 * f, 3 * f + 1, 3 * f + 2});
        }
        const Mesh mesh(std::move(points), std::move(faces));
        const SpatialTree tree(mesh);
        CHECK(tree.boxes().bounds().max.x() > 0.5 * far);
        Index items = 0;
        tree.boxes().visit([](const Box&) { return true; }, [&](Index) { ++items; });
        CHECK(items == 500);
    }
}
