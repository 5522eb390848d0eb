#include "kernel/sketch/picking.h"

#include <algorithm>
#include <set>

#include "tests/unit/sketch/pick_support.h"

using namespace lissom;
using doctest::Approx;
using test::PickWorld;

namespace {

const Vec3 kFar(4e5, -2e5, 3e5);

Vec2 random_cursor(test::Random& random, const View& view) {
    return {random.uniform(0.0, view.size.width), random.uniform(0.0, view.size.height)};
}

// ---- by looking at everything

struct Nearest {
    Index object = kNoIndex, index = kNoIndex;
    double pixels = test::kInfinity;
};

template <typename Counts>
std::optional<Nearest> first_face(const PickWorld& world, const Vec2& cursor,
                                  const Counts& counts) {
    const Ray ray = world.view.ray(cursor);
    Nearest best;
    for (const auto& facet : world.facets) {
        if (!counts(facet)) continue;
        const double t = PickWorld::hit(facet, ray.origin, ray.direction);
        if (t >= 0.0 && t < best.pixels) best = {facet.object, facet.face, t};
    }
    if (best.index == kNoIndex) return std::nullopt;
    return best;
}

// Vertices of faces that count, of which one faces the eye, that no other of them hides.
template <typename Counts>
std::optional<Nearest> first_vertex(const PickWorld& world, const Vec2& cursor,
                                    const PickOptions& options, const Counts& counts) {
    std::set<std::pair<Index, Index>> vertices;
    for (const auto& facet : world.facets) {
        if (!counts(facet)) continue;
        for (const Index v : facet.triangle) vertices.emplace(facet.object, v);
    }
    Nearest best;
    for (const auto& vertex : vertices) {
        const Index object = vertex.first, v = vertex.second;
        const Vec3 p = world.world(object, v), seen = world.view.project(p);
        const double pixels = (seen.head<2>() - cursor).norm();
        if (!(pixels <= options.radius) || seen.z() <= 0.0 || pixels >= best.pixels) continue;
        const bool hidden = !options.through && world.is_hidden(p, [&](const auto& facet) {
            const auto& t = facet.triangle;
            const bool own = facet.object == object && std::find(t.begin(), t.end(), v) != t.end();
            return !own && counts(facet);
        });
        if (!hidden) best = {object, v, pixels};
    }
    if (best.index == kNoIndex) return std::nullopt;
    return best;
}

// The point of an edge that is seen nearest to the cursor, by a golden section: the distance to a
// line falls and then rises.
std::pair<double, Vec3> nearest_on_edge(const View& view, const Vec2& cursor, const Vec3& a,
                                        const Vec3& b) {
    const auto point = [&](double t) { return Vec3(a + t * (b - a)); };
    const auto pixels = [&](double t) {
        return (view.project(point(t)).head<2>() - cursor).norm();
    };
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 100; ++i) {
        const double part = (high - low) * 0.382;
        if (pixels(low + part) < pixels(high - part)) {
            high -= part;
        } else {
            low += part;
        }
    }
    double best = low;
    for (const double t : {0.0, 1.0}) {
        if (pixels(t) < pixels(best)) best = t;
    }
    return {pixels(best), point(best)};
}

std::optional<Nearest> first_edge(const PickWorld& world, const Vec2& cursor,
                                  const PickOptions& options, bool boundaries) {
    Nearest best;
    for (Index object = 0; object < count_of(world.meshes); ++object) {
        const Topology& topology = world.meshes[at(object)].topology();
        for (Index e = 0; e < topology.edge_count(); ++e) {
            const Index a = topology.edge(e).first, b = topology.edge(e).second;
            if (boundaries && !(topology.is_boundary(a) && topology.is_boundary(b))) continue;
            const auto nearest =
                nearest_on_edge(world.view, cursor, world.world(object, a), world.world(object, b));
            const double pixels = nearest.first;
            const Vec3 p = nearest.second;
            if (!(pixels <= options.radius) || pixels >= best.pixels) continue;
            const bool hidden = !options.through && world.is_hidden(p, [&](const auto& facet) {
                const auto has = [&](Index v) {
                    return std::find(facet.triangle.begin(), facet.triangle.end(), v) !=
                           facet.triangle.end();
                };
                // At its ends all faces around touch the edge, between them the two beside it.
                const Vec3 start = world.world(object, a), end = world.world(object, b);
                const double close = 1e-6 * (end - start).norm();
                const bool at_start = (p - start).norm() < close, at_end = (p - end).norm() < close;
                const bool own = (has(a) && has(b)) || (has(a) && at_start) || (has(b) && at_end);
                return facet.object != object || !own;
            });
            if (!hidden) best = {object, e, pixels};
        }
    }
    if (best.index == kNoIndex) return std::nullopt;
    return best;
}

// ---- comparisons

void check_point(const PickWorld& world, const Vec2& cursor, const PickHit& hit) {
    const Vec3 seen = world.view.project(hit.position);
    const double scale = 1.0 + hit.position.norm();
    CHECK(seen.z() == Approx(hit.depth).epsilon(1e-9));
    CHECK((seen.head<2>() - cursor).norm() == Approx(hit.pixels).epsilon(1e-6).scale(1e4));
    const auto corners = world.meshes[at(hit.object)].topology().face(hit.face);
    Vec3 on_face = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::find(corners.begin(), corners.end(), hit.triangle[k]) != corners.end());
        on_face += hit.barycentric[index_of(k)] * world.world(hit.object, hit.triangle[k]);
    }
    CHECK((on_face - hit.position).norm() < 1e-12 * scale);
    CHECK(hit.barycentric.sum() == Approx(1.0));
    CHECK(hit.normal.norm() == Approx(1.0));
    CHECK(std::find(hit.triangle.begin(), hit.triangle.end(), hit.vertex) != hit.triangle.end());
}

void check_faces(const PickWorld& world, const Vec2& cursor, bool back_faces) {
    const auto counts = [&](const auto& facet) { return back_faces || world.is_front(facet); };
    const auto expected = first_face(world, cursor, counts);
    const auto hit = pick(world.scene, world.view, cursor, {.back_faces = back_faces});
    REQUIRE(hit.has_value() == expected.has_value());
    if (!hit) return;
    CHECK(hit->kind == PickKind::face);
    CHECK(hit->object == expected->object);
    CHECK(hit->index == expected->index);
    CHECK(hit->face == hit->index);
    CHECK(hit->pixels == 0.0);
    check_point(world, cursor, *hit);
}

void check_nearest(const PickWorld& world, const Vec2& cursor, const PickOptions& options,
                   const std::optional<Nearest>& expected) {
    const auto hit = pick(world.scene, world.view, cursor, options);
    REQUIRE(hit.has_value() == expected.has_value());
    if (!hit) return;
    CHECK(hit->pixels == Approx(expected->pixels).epsilon(1e-5));
    check_point(world, cursor, *hit);
}

}  // namespace

TEST_CASE("picked faces are those of brute force") {
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        const PickWorld world = test::random_world(seed, seed % 4 == 0 ? kFar : Vec3::Zero());
        test::Random random(seed);
        for (int i = 0; i < 40; ++i) {
            const Vec2 cursor = random_cursor(random, world.view);
            check_faces(world, cursor, true);
            check_faces(world, cursor, false);
        }
    }
}

TEST_CASE("picked vertices are the nearest that no surface hides, as by brute force") {
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        CAPTURE(seed);
        const PickWorld world = test::random_world(seed, seed % 4 == 0 ? kFar : Vec3::Zero());
        test::Random random(seed);
        for (int i = 0; i < 30; ++i) {
            const Vec2 cursor = random_cursor(random, world.view);
            for (const bool back_faces : {true, false}) {
                for (const bool through : {false, true}) {
                    const PickOptions options{.kinds = {PickKind::vertex},
                                              .radius = 15.0,
                                              .back_faces = back_faces,
                                              .through = through};
                    const auto counts = [&](const auto& facet) {
                        return back_faces || world.is_front(facet);
                    };
                    check_nearest(world, cursor, options,
                                  first_vertex(world, cursor, options, counts));
                }
            }
        }
    }
}

TEST_CASE("picked edges and boundaries are the nearest that no surface hides") {
    for (std::uint32_t seed = 1; seed <= 9; ++seed) {
        CAPTURE(seed);
        const PickWorld world = test::random_world(seed, seed % 4 == 0 ? kFar : Vec3::Zero());
        test::Random random(seed);
        for (int i = 0; i < 10; ++i) {
            const Vec2 cursor = random_cursor(random, world.view);
            for (const bool through : {false, true}) {
                for (const auto kind : {PickKind::edge, PickKind::boundary}) {
                    const PickOptions options{.kinds = {kind}, .radius = 6.0, .through = through};
                    check_nearest(world, cursor, options,
                                  first_edge(world, cursor, options, kind == PickKind::boundary));
                }
            }
        }
    }
}

TEST_CASE("a vertex is seen past its own faces from anywhere in front of them, however far") {
    test::Random random(3);
    for (const Affine& place : {Affine{}, translation(Vec3(1e6, 2e6, -1e6)),
                                scaling(Vec3::Constant(1e-6), Vec3::Zero())}) {
        PickWorld world;
        world.add(make_box({.segments = {5, 5, 5}}), place);
        const double size = std::cbrt(place.linear.determinant());
        for (int i = 0; i < 100; ++i) {
            // Eyes just above the plane of the top face.
            const double angle = random.uniform(0.0, 6.3);
            const Vec3 level(std::cos(angle), 0.0, std::sin(angle));
            const Vec3 eye =
                3.0 * level + Vec3(0.0, 0.5 + std::pow(10.0, random.uniform(-5, 0)), 0);
            world.view = {Camera({.eye = place(eye), .target = place(Vec3(0, 0.5, 0))}),
                          {640, 480}};
            int on_top = 0;
            for (Index v = 0; v < world.meshes[0].vertex_count(); ++v) {
                const Vec3 p = world.meshes[0].position(v);
                if (p.y() < 0.5) continue;
                ++on_top;
                const Vec3 seen = world.view.project(place(p));
                const auto hit = pick(world.scene, world.view, seen.head<2>(),
                                      {.kinds = {PickKind::vertex}, .radius = 1e-3});
                REQUIRE(hit);
                CHECK((hit->position - place(p)).norm() < 0.05 * size);
            }
            CHECK(on_top == 36);
        }
    }
}

TEST_CASE("kinds are preferred in their order, within the radius") {
    PickWorld world;
    world.add(make_grid({.size = {2, 2}, .segments = {2, 2}}),
              rotation(Vec3::UnitX(), kPi / 2, Vec3::Zero()));
    world.view = {Camera({.eye = Vec3(0, 0, 5), .ortho = 2.4}), {240, 240}};
    const PointSet points({Vec3(0.5, 0.5, 0.1)});
    const PolylineSet lines({Vec3(-1, 0.25, 0.1), Vec3(1, 0.25, 0.1)}, {0, 2});
    world.scene.add(points);
    world.scene.add(lines);
    const auto kind_at = [&](double x, double y, std::vector<PickKind> kinds) {
        const auto hit = pick(world.scene, world.view, {120 + 100 * x, 120 - 100 * y},
                              {.kinds = std::move(kinds), .radius = 5.0});
        return hit ? std::optional(hit->kind) : std::nullopt;
    };
    using enum PickKind;
    const std::vector<PickKind> all{face, edge, boundary, vertex, polyline, point};
    CHECK(kind_at(0.5, 0.5, all) == point);
    CHECK(kind_at(0.5, 0.53, all) == point);
    CHECK(kind_at(0.5, 0.27, all) == polyline);
    CHECK(kind_at(0.02, 0.02, all) == vertex);
    CHECK(kind_at(0.98, 0.7, all) == boundary);
    CHECK(kind_at(0.02, 0.7, all) == edge);
    CHECK(kind_at(0.3, 0.7, all) == face);
    CHECK(kind_at(0.98, 0.7, {edge, face}) == edge);
    CHECK(kind_at(0.02, 0.02, {face}) == face);
    CHECK(kind_at(1.03, 0.7, all) == boundary);
    CHECK(!kind_at(1.1, 0.7, all));
    CHECK(!kind_at(0.3, 0.7, {}));
    CHECK(!kind_at(0.3, 0.7, {vertex, edge}));
}

TEST_CASE("points and lines are picked with their place, hidden by surfaces unless drawn on top") {
    test::Random random(5);
    const PickWorld shapes = test::random_world(2);
    std::vector<Vec3> cloud;
    for (int i = 0; i < 300; ++i) {
        cloud.push_back(random.in_box({Vec3::Constant(-1.5), Vec3::Constant(1.5)}));
    }
    const PointSet points(cloud);
    std::vector<Index> offsets;
    for (Index i = 0; i <= 300; i += 10) offsets.push_back(i);
    const PolylineSet lines(cloud, offsets), loops(cloud, offsets, true);
    const Affine place = rotation(Vec3(1, 2, 3), 0.7, Vec3(0.1, 0.2, 0.3));
    for (const bool on_top : {false, true}) {
        PickScene scene = shapes.scene;
        const Index point_object = scene.add(points, {.to_world = place, .on_top = on_top});
        const Index line_object = scene.add(lines, {.to_world = place, .on_top = on_top});
        const auto is_hidden = [&](const Vec3& p) {
            const double depth = shapes.view.camera.to_camera(p).z();
            return !on_top &&
                   shapes.is_hidden(
                       p, [](const auto&) { return true; }, 2.0 * shapes.view.pixel_length(depth));
        };
        int points_hit = 0, lines_hit = 0;
        for (int i = 0; i < 60; ++i) {
            const Vec2 cursor = random_cursor(random, shapes.view);
            double nearest = 12.0;
            Index expected = kNoIndex;
            for (Index k = 0; k < 300; ++k) {
                const Vec3 p = place(cloud[at(k)]), seen = shapes.view.project(p);
                const double pixels = (seen.head<2>() - cursor).norm();
                if (pixels < nearest && !is_hidden(p))
                    std::tie(nearest, expected) = std::tuple(pixels, k);
            }
            const auto hit =
                pick(scene, shapes.view, cursor, {.kinds = {PickKind::point}, .radius = 12.0});
            REQUIRE(hit.has_value() == (expected != kNoIndex));
            if (hit) CHECK(hit->index == expected);
            if (hit) CHECK(hit->object == point_object);
            points_hit += hit.has_value();
            const auto line =
                pick(scene, shapes.view, cursor, {.kinds = {PickKind::polyline}, .radius = 12.0});
            if (!line) continue;
            CHECK(line->object == line_object);
            const Index first = offsets[at(line->index)] + line->segment;
            const Vec3 a = cloud[at(first)], b = cloud[at(first + 1)];
            CHECK((place(a + line->along * (b - a)) - line->position).norm() < 1e-12);
            CHECK(!is_hidden(line->position));
            ++lines_hit;
        }
        CHECK(points_hit > 5);
        CHECK(points_hit < 60);
        CHECK(lines_hit > 5);
    }
    CHECK(loops.segments().size() == 300);
    CHECK(lines.segments().size() == 270);
}

TEST_CASE("a line that runs behind the camera is picked in front of it") {
    const PolylineSet line({Vec3(0.5, 0, -10), Vec3(0.5, 0, 10)}, {0, 2});
    PickScene scene;
    scene.add(line);
    const View view{Camera({.eye = Vec3::Zero(), .target = Vec3(0, 0, -1)}), {200, 100}};
    const auto hit = pick(scene, view, Vec2(190, 50), {.kinds = {PickKind::polyline}});
    REQUIRE(hit);
    CHECK(hit->pixels < 1e-6);
    CHECK((view.project(hit->position).head<2>() - Vec2(190, 50)).norm() < 1e-6);
    CHECK(hit->depth > 0.0);
    CHECK(!pick(scene, view, Vec2(10, 50), {.kinds = {PickKind::polyline}}));
}

TEST_CASE("all that lies under the cursor, the nearest first and each thing once") {
    PickWorld world;
    world.add(make_sphere({.segments = 6}), {});
    world.view = {Camera({.eye = Vec3(0.2, 0.3, 5)}), {200, 200}};
    const auto pick_these = [&](PickOptions options, std::size_t most = 1000) {
        return pick_all(world.scene, world.view, Vec2(103, 98), options, most);
    };
    CHECK(pick_these({}).size() == 1);
    const auto faces = pick_these({.through = true});
    REQUIRE(faces.size() == 2);
    CHECK(faces[0].depth < faces[1].depth);
    CHECK(pick_these({.back_faces = false, .through = true}).size() == 1);
    for (const auto kind : {PickKind::vertex, PickKind::edge}) {
        const auto seen = pick_these({.kinds = {kind}, .radius = 40.0});
        const auto all = pick_these({.kinds = {kind}, .radius = 40.0, .through = true});
        CHECK(seen.size() > 3);
        CHECK(all.size() > seen.size());
        std::set<Index> ids;
        for (std::size_t i = 0; i < all.size(); ++i) {
            ids.insert(all[i].index);
            if (i > 0) CHECK(all[i].pixels > all[i - 1].pixels - 1e-5);
        }
        CHECK(ids.size() == all.size());
        CHECK(pick_these({.kinds = {kind}, .radius = 40.0}, 2).size() == 2);
    }
}

TEST_CASE("very many things behind a wall do not hide a corner of it") {
    PickWorld world;
    const Affine far = translation(Vec3(0, 0, -20)) * scaling(Vec3::Constant(0.05), Vec3::Zero());
    world.add(make_sphere({.segments = 24}), far);
    world.add(make_sphere({.segments = 24}), translation(Vec3(0, 0.1, 0)) * far);
    world.add(make_grid({.size = {2, 2}, .segments = {2, 2}}),
              rotation(Vec3::UnitX(), kPi / 2, Vec3(0.04, 0.03, 0)));
    for (const bool ortho : {false, true}) {
        CameraOptions camera{.eye = Vec3(0, 0, 5), .up = Vec3(0.1, 1, 0)};
        if (ortho) camera.ortho = 2.5;
        world.view = {Camera(camera), {300, 300}};
        for (const auto kind : {PickKind::vertex, PickKind::edge}) {
            const auto hit =
                pick(world.scene, world.view, Vec2(150, 150), {.kinds = {kind}, .radius = 40.0});
            REQUIRE(hit);
            CHECK(hit->object == 2);
            const auto all = pick_all(world.scene, world.view, Vec2(150, 150),
                                      {.kinds = {kind}, .radius = 40.0}, 100000);
            for (const PickHit& one : all) CHECK(one.object == 2);
        }
    }
}

TEST_CASE("a polygon that the ray hits where its triangles meet is hit once") {
    PickWorld world;
    world.add(make_box({.segments = {1, 1, 1}}), {});
    world.view = {Camera({.eye = Vec3(0, 0, 5), .ortho = 2.0}), {100, 100}};
    const auto hits = pick_all(world.scene, world.view, Vec2(60, 40), {.through = true});
    REQUIRE(hits.size() == 2);
    CHECK(hits[0].face != hits[1].face);
}

TEST_CASE("of what is seen at one place the nearer is picked, also through the surface") {
    PickWorld world;
    world.add(make_box({.segments = {2, 2, 2}}), {});
    world.view = {Camera({.eye = Vec3(0, 0, 5), .ortho = 2.0}), {100, 100}};
    const auto hit =
        pick(world.scene, world.view, Vec2(50, 50), {.kinds = {PickKind::vertex}, .through = true});
    REQUIRE(hit);
    CHECK(hit->position.z() == 0.5);
}

TEST_CASE("picks without sense are refused, and a scene without surfaces is empty") {
    const View view{Camera(), {100, 100}};
    const PickScene nothing;
    const auto code = [](const auto& action) { return test::error_of(action).code(); };
    CHECK(!pick(nothing, view, Vec2(50, 50), {.kinds = {PickKind::vertex, PickKind::face}}));
    CHECK(code([&] { (void)pick(nothing, view, Vec2(test::kNaN, 0)); }) == ErrorCode::not_finite);
    CHECK(code([&] { (void)pick(nothing, view, Vec2(0, 0), {.radius = -1}); }) ==
          ErrorCode::invalid_argument);
    CHECK(code([&] {
              (void)pick(nothing, {Camera(), {0, 10}}, Vec2(0, 0));
          }) == ErrorCode::invalid_argument);
    CHECK(code([] { PointSet{{Vec3(0, test::kInfinity, 0)}}; }) == ErrorCode::not_finite);
    CHECK(code([] { PolylineSet({Vec3::Zero()}, {0, 2}); }) == ErrorCode::invalid_argument);
    const PointSet points({Vec3::Zero()});
    PickScene scene;
    for (const Vec3& flat : {Vec3(1, 0, 1), Vec3(1, 1, test::kNaN)}) {
        CHECK(code([&] {
                  scene.add(points, {.to_world = {Mat3(flat.asDiagonal()), Vec3::Zero()}});
              }) == ErrorCode::invalid_argument);
    }
    CHECK(scene.objects().empty());
    const Affine tiny = scaling(Vec3::Constant(1e-30), Vec3::Zero());
    CHECK(scene.add(points, {.to_world = tiny}) == 0);
}
