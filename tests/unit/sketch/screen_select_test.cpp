#include "kernel/sketch/screen_select.h"

#include <algorithm>
#include <set>

#include "tests/unit/sketch/pick_support.h"

using namespace lissom;
using test::PickWorld;

namespace {

using Inside = std::function<bool(const Vec2&)>;

// Vertices of an object inside a shape that are not hidden, by looking at everything.
std::vector<Index> vertices_inside(const PickWorld& world, Index object, const Inside& inside,
                                   const SelectOptions& options) {
    std::vector<Index> found;
    for (Index v = 0; v < world.meshes[at(object)].vertex_count(); ++v) {
        const Vec3 p = world.world(object, v), seen = world.view.project(p);
        if (!(seen.z() > 0.0) || !inside(seen.head<2>())) continue;
        const auto is_own = [&](const auto& facet) {
            const auto& t = facet.triangle;
            return facet.object == object && std::find(t.begin(), t.end(), v) != t.end();
        };
        const auto counts = [&](const auto& facet) {
            return options.back_faces || world.is_front(facet);
        };
        const bool has_face =
            std::any_of(world.facets.begin(), world.facets.end(),
                        [&](const auto& facet) { return is_own(facet) && counts(facet); });
        if (!has_face) continue;
        const auto hides = [&](const auto& facet) { return !is_own(facet) && counts(facet); };
        if (options.through || !world.is_hidden(p, hides)) found.push_back(v);
    }
    return found;
}

void check_vertices(const PickWorld& world, const std::vector<Selected>& selected,
                    const Inside& inside, const SelectOptions& options) {
    REQUIRE(selected.size() == world.meshes.size());
    for (const Selected& one : selected) {
        CHECK(one.vertices.vertices() == vertices_inside(world, one.object, inside, options));
        CHECK(one.faces.empty());
    }
}

double distance_to_stroke(const std::vector<Vec2>& stroke, const Vec2& p) {
    double best = (stroke[0] - p).norm();
    for (std::size_t i = 1; i < stroke.size(); ++i) {
        const Vec2 along = stroke[i] - stroke[i - 1];
        const double t = std::clamp((p - stroke[i - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
        best = std::min(best, (stroke[i - 1] + t * along - p).norm());
    }
    return best;
}

// How often the outline goes around `p`, by the sum of the angles.
int winding(const std::vector<Vec2>& outline, const Vec2& p) {
    double sum = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec2 a = outline[i] - p, b = outline[(i + 1) % outline.size()] - p;
        sum += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    }
    return static_cast<int>(std::lround(sum / (2.0 * kPi)));
}

std::vector<Vec2> random_points(test::Random& random, int count, const View& view) {
    std::vector<Vec2> points;
    for (int i = 0; i < count; ++i) {
        points.emplace_back(random.uniform(-20, view.size.width + 20),
                            random.uniform(-20, view.size.height + 20));
    }
    return points;
}

Selected select_box(const View& view, const SelectOptions& options, const Brush& brush,
                    const Context& context = {}) {
    const SpatialTree tree(make_box({.segments = {1, 1, 1}}));
    PickScene scene;
    scene.add(tree);
    return select_brush(scene, view, brush, options, context).at(0);
}

}  // namespace

TEST_CASE("rectangles, lassos and brushes select the vertices that brute force does") {
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        CAPTURE(seed);
        const Vec3 far = seed % 4 == 0 ? Vec3(4e5, -2e5, 3e5) : Vec3::Zero();
        const PickWorld world = test::random_world(seed, far);
        test::Random random(seed);
        for (int i = 0; i < 4; ++i) {
            const SelectOptions options{.through = i % 2 == 1, .back_faces = i < 2};
            const auto corners = random_points(random, 2, world.view);
            const Vec2 low = corners[0].cwiseMin(corners[1]),
                       high = corners[0].cwiseMax(corners[1]);
            check_vertices(
                world, select_rectangle(world.scene, world.view, corners[0], corners[1], options),
                [&](const Vec2& p) {
                    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
                },
                options);
            const auto outline = random_points(random, 3 + 5 * i, world.view);
            check_vertices(
                world, select_lasso(world.scene, world.view, outline, options),
                [&](const Vec2& p) { return winding(outline, p) != 0; }, options);
            const auto stroke = random_points(random, 1 + i, world.view);
            check_vertices(
                world,
                select_brush(world.scene, world.view, {.stroke = stroke, .radius = 30.0}, options),
                [&](const Vec2& p) { return distance_to_stroke(stroke, p) <= 30.0; }, options);
        }
    }
}

TEST_CASE("what is known is left out, and nothing else: a stroke in pieces is the whole stroke") {
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        CAPTURE(seed);
        const PickWorld world = test::random_world(seed, Vec3::Zero());
        test::Random random(seed);
        const auto stroke = random_points(random, 6, world.view);
        const auto brushed = [&](std::span<const Vec2> points, const SelectOptions& options) {
            return select_brush(world.scene, world.view, {.stroke = points, .radius = 40.0},
                                options);
        };
        const std::vector<Selected> whole = brushed(stroke, {});
        std::vector<Region> found, asked;
        for (const Selected& one : whole) found.push_back(Region::none(one.vertices.topology()));
        asked = found;
        for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
            SelectOptions options;
            std::vector<const Region*> known(world.scene.objects().size(), nullptr);
            for (std::size_t k = 0; k < whole.size(); ++k) known[at(whole[k].object)] = &asked[k];
            options.known = known;
            const auto piece = brushed(std::span(stroke).subspan(i, 2), options);
            for (std::size_t k = 0; k < whole.size(); ++k) {
                const Region all = piece[k].vertices.united(piece[k].unseen);
                CHECK(all.intersected(asked[k]).empty());
                CHECK(piece[k].vertices.intersected(piece[k].unseen).empty());
                found[k] = found[k].united(piece[k].vertices);
                asked[k] = asked[k].united(all);
            }
        }
        for (std::size_t k = 0; k < whole.size(); ++k) {
            CHECK(found[k] == whole[k].vertices);
            CHECK(asked[k] == whole[k].vertices.united(whole[k].unseen));
        }
    }
}

TEST_CASE("known vertices of another mesh, or where faces are selected, are an error") {
    const View view{Camera({.eye = Vec3(3, 2, 5)}), {200, 200}};
    const Mesh other = make_box();
    const Region region = Region::all(other.shared_topology());
    const std::vector<const Region*> known{&region};
    const std::vector<Vec2> dab{{100.0, 100.0}};
    const auto code = [&](SelectKind kind) {
        return test::error_of([&] {
                   (void)select_box(view, {.kind = kind, .known = known},
                                    {.stroke = dab, .radius = 5.0});
               })
            .code();
    };
    CHECK(code(SelectKind::vertices) == ErrorCode::topology_mismatch);
    CHECK(code(SelectKind::faces) == ErrorCode::invalid_argument);
}

TEST_CASE("a brush selects the faces that it touches, also those larger than it") {
    const View view{Camera({.eye = Vec3(3, 2, 5)}), {200, 200}};
    const Vec2 on_front = view.project(Vec3(0.1, 0.1, 0.5)).head<2>();
    const SelectOptions visible{.kind = SelectKind::faces},
        through{.kind = SelectKind::faces, .through = true};
    const std::vector<Vec2> dab{on_front};
    const Selected front = select_box(view, visible, {.stroke = dab, .radius = 1.0});
    REQUIRE(front.faces.size() == 1);
    CHECK(front.vertices.size() == 4);
    for (const Index v : front.vertices.vertices()) {
        CHECK(make_box({.segments = {1, 1, 1}}).position(v).z() == 0.5);
    }
    CHECK(select_box(view, through, {.stroke = dab, .radius = 1.0}).faces.size() == 2);
    // A stroke over the front, past the edge to the right side; none that starts beside the box.
    const Vec2 on_right = view.project(Vec3(0.5, 0.1, 0.1)).head<2>();
    const std::vector<Vec2> stroke{on_front, on_right}, beside{{2, 2}, {2, 190}};
    CHECK(select_box(view, visible, {.stroke = stroke, .radius = 1.0}).faces.size() == 2);
    CHECK(select_box(view, visible, {.stroke = beside, .radius = 1.0}).faces.empty());
    // A long stroke across that has no end and no corner of a face in it.
    const std::vector<Vec2> across{{0, on_front.y()}, {200, on_front.y()}};
    CHECK(select_box(view, visible, {.stroke = across, .radius = 0.5}).faces.size() >= 2);
    CHECK(select_box(view, visible, {.stroke = {}, .radius = 5.0}).faces.empty());
    const std::vector<Vec2> everywhere{{100, 100}};
    CHECK(select_box(view, visible, {.stroke = everywhere, .radius = 300.0}).faces.size() == 3);
    CHECK(select_box(view, through, {.stroke = everywhere, .radius = 300.0}).faces.size() == 6);
    const SelectOptions front_only{.kind = SelectKind::faces, .through = true, .back_faces = false};
    CHECK(select_box(view, front_only, {.stroke = everywhere, .radius = 300.0}).faces.size() == 3);
}

TEST_CASE("a lasso and a rectangle select the faces whose middles are seen inside") {
    const SpatialTree tree(make_sphere({.segments = 10}));
    PickScene scene;
    scene.add(tree);
    const View view{Camera({.eye = Vec3(0, 0, 6)}), {400, 400}};
    const SelectOptions visible{.kind = SelectKind::faces},
        through{.kind = SelectKind::faces, .through = true};
    const Vec2 low(0, 0), middle(400, 200), high(400, 400);
    const auto upper = select_rectangle(scene, view, low, middle, visible).at(0);
    const auto whole = select_rectangle(scene, view, low, high, visible).at(0);
    const auto all = select_rectangle(scene, view, low, high, through).at(0);
    const Index faces = tree.topology().face_count();
    CHECK(count_of(all.faces) == faces);
    CHECK(whole.faces.size() < all.faces.size());
    CHECK(std::abs(2 * count_of(upper.faces) - count_of(whole.faces)) <= 20);
    const std::vector<Vec2> outline{low, {400, 0}, middle, {0, 200}};
    CHECK(select_lasso(scene, view, outline, visible).at(0).faces == upper.faces);
    // Round twice is inside too, in either direction, and two points enclose nothing.
    std::vector<Vec2> twice = outline;
    twice.insert(twice.end(), outline.begin(), outline.end());
    CHECK(select_lasso(scene, view, twice, visible).at(0).faces == upper.faces);
    std::reverse(twice.begin(), twice.end());
    CHECK(select_lasso(scene, view, twice, visible).at(0).faces == upper.faces);
    CHECK(select_lasso(scene, view, std::vector{low, high}, visible).at(0).faces.empty());
}

TEST_CASE("what lies behind the camera is never selected") {
    const SpatialTree tree(make_sphere({.segments = 8}));
    PickScene scene;
    scene.add(tree);
    const View inside{Camera({.eye = Vec3(0.1, 0, 0), .target = Vec3(1, 0, 0)}), {100, 100}};
    for (const bool through : {false, true}) {
        const auto all =
            select_rectangle(scene, inside, Vec2(-1e6, -1e6), Vec2(1e6, 1e6), {.through = through});
        CHECK(!all.at(0).vertices.empty());
        for (const Index v : all.at(0).vertices.vertices()) {
            CHECK(tree.positions()[at(v)].x() > 0.1);
        }
    }
}

TEST_CASE("threads select the same, a cancel ends it, and nonsense is refused") {
    const PickWorld world = test::random_world(2);
    ContextOptions threads;
    threads.threads = 2;
    const Vec2 low(0, 0), high(320, 240);
    const auto one = select_rectangle(world.scene, world.view, low, high),
               two = select_rectangle(world.scene, world.view, low, high, {}, Context(threads));
    for (std::size_t i = 0; i < one.size(); ++i) CHECK(one[i].vertices == two[i].vertices);
    const Context cancelled;
    cancelled.cancel();
    const auto code = [](const auto& action) { return test::error_of(action).code(); };
    CHECK(code([&] {
              (void)select_rectangle(world.scene, world.view, low, high, {}, cancelled);
          }) == ErrorCode::cancelled);
    CHECK(code([&] {
              (void)select_rectangle(world.scene, world.view, low, Vec2(test::kNaN, 0));
          }) == ErrorCode::not_finite);
    const std::vector<Vec2> dab{low};
    CHECK(code([&] {
              (void)select_brush(world.scene, world.view, {.stroke = dab, .radius = -1.0});
          }) == ErrorCode::invalid_argument);
}
