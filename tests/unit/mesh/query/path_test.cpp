#include "kernel/mesh/query/path.h"

#include <array>
#include <limits>
#include <optional>

#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/query/path_smooth.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

const std::vector<Vec3> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

}  // namespace

TEST_CASE("a free path measures its polyline, closed or open") {
    CHECK(Path(kSquare, false).length() == Approx(3.0));
    CHECK(Path(kSquare, true).length() == Approx(4.0));
    CHECK(Path(kSquare, true).segment_count() == 4);
    CHECK(!Path(kSquare, true).on_mesh());
}

TEST_CASE("the nearest point knows its segment and parameter") {
    const PathPoint near = Path(kSquare, true).nearest(Vec3(-1, 0.25, 0));
    CHECK(near.segment == 3);
    CHECK(near.parameter == Approx(3.75 / 4.0));
    CHECK((near.point - Vec3(0, 0.25, 0)).norm() < 1e-15);
    CHECK(near.distance == Approx(1.0));
    // Of equals the first.
    CHECK(Path(kSquare, true).nearest(Vec3(0.5, 0.5, 0)).segment == 0);
    CHECK(Path(kSquare, false).nearest(Vec3(-1, 5, 0)).parameter == 1.0);
}

TEST_CASE("boundaries have the surface on their left") {
    const Mesh mesh = make_cylinder({.segments = 12, .rings = 2, .caps = false});
    const std::vector<Path> loops = boundaries(mesh);
    REQUIRE(loops.size() == 2);
    for (const Path& loop : loops) {
        CHECK(loop.closed());
        CHECK(loop.is_boundary());
        CHECK(loop.reversed().is_boundary());
        CHECK(loop.follows_edges());
        const std::vector<Vec3> p = loop.points(mesh);
        const Vec3 outward(p[0].x(), 0, p[0].z());
        const Vec3 left = outward.cross(p[1] - p[0]);
        CHECK(left.y() * p[0].y() < 0.0);
        CHECK(loop.length(mesh) == Approx(12 * 2 * 0.5 * std::sin(kPi / 12)));
    }
}

TEST_CASE("a region's outlines are paths") {
    const Mesh mesh = make_box({.segments = {3, 3, 3}});
    const std::vector<Path> outlines = boundaries(*mesh.find_region("top"));
    REQUIRE(outlines.size() == 1);
    CHECK(outlines[0].length(mesh) == Approx(4.0));
    CHECK(!outlines[0].is_boundary());
}

TEST_CASE("the path through vertices is the shortest along edges") {
    const Mesh mesh = make_grid({.size = {4, 4}, .segments = {4, 4}});
    const Path path = path_through(mesh, std::array{0, 2, 12}, false);
    CHECK(path.vertices().front() == 0);
    CHECK(path.vertices().back() == 12);
    CHECK(path.follows_edges());
    CHECK(path.length(mesh) == Approx(4.0));
    const Path around = path_through(mesh, std::array{0, 4, 24, 20}, true);
    CHECK(around.closed());
    CHECK(around.size() == 16);
    CHECK(around.is_boundary());
}

TEST_CASE("components that no path joins are named") {
    Mesh mesh = make_box();
    append(mesh, make_box());
    const Error error = test::error_of([&] { (void)path_through(mesh, std::array{0, 9}, false); });
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(error.elements().ids == std::vector<Index>{0, 9});
}

TEST_CASE("reversing keeps the start of a closed path and swaps the ends of an open one") {
    const Mesh mesh = make_box();
    const Path closed(mesh.shared_topology(), {0, 1, 2, 3}, true);
    CHECK(closed.reversed().vertices() == std::vector<Index>{0, 3, 2, 1});
    const Path open(kSquare, false);
    CHECK(open.reversed().points().front() == kSquare.back());
}

TEST_CASE("smoothing straightens a curve and keeps its ends") {
    std::vector<Vec3> zigzag;
    for (int i = 0; i <= 20; ++i) zigzag.emplace_back(i, i % 2, 0);
    Path path(zigzag, false);
    const double before = path.length();
    smooth_path(path, 50, 0.5);
    CHECK(path.length() < 0.75 * before);
    CHECK(path.points().front() == zigzag.front());
    CHECK(path.points().back() == zigzag.back());
}

TEST_CASE("smoothing a boundary moves its vertices and no others") {
    Mesh mesh = make_grid();
    const Mesh before = mesh;
    const Path boundary = boundaries(mesh)[0];
    smooth_path(mesh, boundary, 5, 0.5);
    CHECK(boundary.length(mesh) < boundary.length(before));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.topology().is_boundary(v)) CHECK(mesh.position(v) == before.position(v));
    }
}

TEST_CASE("smoothing a path for ever can be cancelled, and then moves nothing") {
    constexpr Index kForEver = std::numeric_limits<Index>::max();
    const auto cancelled_smoothing = [](const auto& smooth) {
        std::optional<Context> context;
        int reports = 0;
        ContextOptions options;
        options.progress = [&](std::string_view, double) {
            if (++reports == 3) context->cancel();
        };
        context.emplace(options);
        return test::error_of([&] { smooth(*context); }).code();
    };
    Mesh mesh = make_grid();
    const std::uint64_t before = hash(mesh);
    CHECK(cancelled_smoothing([&](const Context& context) {
              smooth_path(mesh, boundaries(mesh)[0], kForEver, 0.5, context);
          }) == ErrorCode::cancelled);
    CHECK(hash(mesh) == before);
    Path path(kSquare, true);
    CHECK(cancelled_smoothing([&](const Context& context) {
              smooth_path(path, kForEver, 0.5, context);
          }) == ErrorCode::cancelled);
    CHECK(path.points() == kSquare);
}

TEST_CASE("paths that make no sense are refused") {
    const Mesh mesh = make_box(), other = make_box();
    const auto topology = mesh.shared_topology();
    const auto code = [](const auto& action) { return test::error_of(action).code(); };
    CHECK(code([&] { Path(topology, {0}, false); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { Path(topology, {0, 1}, true); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { Path(topology, {0, 0, 1}, false); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { Path(topology, {0, 1, 2, 0}, true); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { Path(topology, {0, 8}, false); }) == ErrorCode::out_of_range);
    CHECK(code([&] {
              Path({Vec3(0, 0, 0), Vec3(test::kNaN, 0, 0)}, false);
          }) == ErrorCode::not_finite);
    const Path path(topology, {0, 1, 2}, false);
    CHECK(code([&] { (void)path.points(other); }) == ErrorCode::topology_mismatch);
    CHECK(code([&] { (void)path.points(); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { (void)path_through(mesh, std::array{1}, false); }) ==
          ErrorCode::invalid_argument);
    CHECK(code([&] {
              (void)path_through(mesh, std::array{1, 1}, false);
          }) == ErrorCode::invalid_argument);
    Path free(kSquare, true);
    CHECK(code([&] { smooth_path(free, -1, 0.5); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { smooth_path(free, 1, 1.5); }) == ErrorCode::invalid_argument);
}
