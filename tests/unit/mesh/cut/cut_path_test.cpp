#include <array>

#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/cut/trim.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/cut/cut_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// Points around the y axis at a wavy height.
Path ring(double radius, double height, double wave, int count) {
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        // With the top of the mesh on the left, seen from outside.
        const double angle = -2.0 * kPi * i / count;
        points.emplace_back(radius * std::cos(angle), height + wave * std::cos(2.0 * angle),
                            radius * std::sin(angle));
    }
    return {points, true};
}

template <typename Action>
ErrorCode code(const Action& action) {
    return test::error_of(action).code();
}

}  // namespace

TEST_CASE("a closed path cuts along a smooth line near its points") {
    const Mesh mesh = make_bar({.width = 1.0, .length = 4.0, .across = 8, .along = 32});
    const Mesh sphere = make_sphere({.segments = 20, .kind = SphereKind::triangles});
    const Path on_sphere = ring(1.0, 0.1, 0.2, 12);
    const Cut parts = cut(sphere, CutPath{on_sphere});
    test::check_cut(sphere, parts);
    REQUIRE(parts.lines.size() == 1);
    CHECK(bounds(parts.kept.mesh).max.y() == bounds(sphere).max.y());
    CHECK(mean_turn(parts.kept.mesh, parts.lines[0].kept) < 12 * kPi / 180);
    for (const Vec3& p : on_sphere.points()) {
        CHECK(parts.lines[0].kept.nearest(parts.kept.mesh, p).distance <
              1.5 * mean_edge_length(sphere));
    }
    test::check_cut(mesh, cut(mesh, CutPath{ring(0.7, 0.3, 0.3, 16)}));
}

TEST_CASE("the left of the path is kept, or the part with the seed") {
    const Mesh sphere = make_sphere({.segments = 16});
    const Path path = ring(1.0, 0.3, 0.05, 10);
    const Cut left = cut(sphere, CutPath{path});
    CHECK(bounds(left.kept.mesh).max.y() == Approx(1.0));
    const Cut right = cut(sphere, CutPath{path.reversed()});
    CHECK(bounds(right.kept.mesh).min.y() == Approx(-1.0));
    const Cut seeded = cut(sphere, CutPath{path, Vec3(0, -1, 0)});
    CHECK(bounds(seeded.kept.mesh).min.y() == Approx(-1.0));
}

TEST_CASE("a path that keeps more than four fifths is told, unless a seed says what to keep") {
    const Mesh sphere = make_sphere({.segments = 16});
    const Path path = ring(0.6, 0.8, 0.02, 10);
    CHECK(cut(sphere, CutPath{path}).report.warnings.empty());
    const CutReport large = cut(sphere, CutPath{path.reversed()}).report;
    REQUIRE(large.warnings.size() == 1);
    CHECK(large.warnings[0].concern == CutConcern::keeps_most);
    CHECK(large.warnings[0].message.find("the cut keeps ") == 0);
    CHECK(cut(sphere, CutPath{path.reversed(), Vec3(0, -1, 0)}).report.warnings.empty());
    CHECK(cut(sphere, CutPath{path, Vec3(0, -1, 0)}).report.warnings.empty());
}

TEST_CASE("a path through vertices cuts as one through their places does") {
    const Mesh sphere = make_sphere({.segments = 16});
    const Path free = ring(1.0, 0.3, 0.05, 10);
    const Cut a = cut(sphere, CutPath{free});
    const Path line = a.lines[0].kept;
    const Cut again = cut(a.rest.mesh, CutPath{ring(0.9, 0.0, 0.05, 10)});
    test::check_cut(a.rest.mesh, again);
    CHECK(again.lines[0].kept.closed());
    CHECK(line.is_boundary());
}

TEST_CASE("a region is cut out along all its outlines") {
    const Mesh sphere = make_sphere({.segments = 20, .kind = SphereKind::triangles});
    const Region band = select_plane(sphere, {0, -0.4, 0}, {0, 1, 0})
                            .intersected(select_plane(sphere, {0, 0.4, 0}, {0, -1, 0}));
    const Cut parts = cut(sphere, CutRegion{band});
    test::check_cut(sphere, parts);
    CHECK(parts.lines.size() == 2);
    CHECK(parts.kept.mesh.topology().component_count() == 1);
    CHECK(parts.rest.mesh.topology().component_count() == 2);
    REQUIRE(parts.report.warnings.size() == 1);
    CHECK(parts.report.warnings[0].concern == CutConcern::several_outlines);
    CHECK(parts.report.warnings[0].message.find("2 outlines") != std::string::npos);
    CHECK(parts.report.warnings[0].message.find("1 piece kept, 2 pieces left") !=
          std::string::npos);
    CHECK(preview_cut(sphere, CutRegion{band}).report.warnings.size() == 1);
    for (const CutLine& line : parts.lines) {
        CHECK(mean_turn(parts.kept.mesh, line.kept) < 12 * kPi / 180);
    }
    const Mesh cactus = make_cactus({.vertices = 4000});
    const Cut arm = cut(cactus, CutRegion{*cactus.find_region("left_arm")});
    test::check_cut(cactus, arm);
    CHECK(arm.report.warnings.empty());
    CHECK(arm.kept.mesh.vertex_count() < cactus.vertex_count() / 3);
}

TEST_CASE("loose components go with their side of a path and with their region") {
    Mesh mesh = make_sphere({.segments = 12});
    append(mesh, test::moved(make_sphere({.segments = 3}), translation({0, 3, 0})));
    const Cut parts = cut(mesh, CutPath{ring(1.0, 0.1, 0.0, 10)});
    CHECK(parts.report.whole_components == 1);
    CHECK(parts.kept.mesh.topology().component_count() == 2);
    const Cut cap = cut(mesh, CutRegion{select_plane(mesh, {0, 0.3, 0}, {0, 1, 0})});
    CHECK(cap.kept.mesh.topology().component_count() == 2);
    const Region low = select_plane(mesh, {0, -0.3, 0}, {0, -1, 0});
    CHECK(cut(mesh, CutRegion{low}).kept.mesh.topology().component_count() == 1);
}

TEST_CASE("paths and regions that cannot be cut are refused") {
    const Mesh sphere = make_sphere({.segments = 12});
    const Mesh torus = make_torus();
    const Mesh grid = make_grid();
    const auto cut_path = [](const Mesh& mesh, const Path& path) {
        return code([&] { (void)cut(mesh, CutPath{path}); });
    };
    CHECK(cut_path(sphere, Path({{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, false)) ==
          ErrorCode::invalid_argument);
    CHECK(cut_path(sphere, Path({{0, 0, 1}, {0, 0, 1.1}, {0, 0, 1.2}}, true)) ==
          ErrorCode::invalid_argument);
    // There and back again.
    CHECK(cut_path(sphere, Path({{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, 0.99}}, true)) ==
          ErrorCode::invalid_argument);
    const Mesh tube = make_cylinder({.caps = false});
    CHECK(cut_path(tube, boundaries(tube)[0]) == ErrorCode::boundary_conflict);
    std::vector<Vec3> around_tube;
    for (int i = 0; i < 8; ++i) {
        around_tube.emplace_back(1.0 + 0.35 * std::cos(i * kPi / 4), 0.35 * std::sin(i * kPi / 4),
                                 0.0);
    }
    CHECK(cut_path(torus, Path(around_tube, true)) == ErrorCode::boundary_conflict);
    const auto cut_region = [](const Mesh& mesh, const Region& region) {
        return code([&] { (void)cut(mesh, CutRegion{region}); });
    };
    CHECK(cut_region(sphere, Region::all(sphere.shared_topology())) == ErrorCode::invalid_argument);
    CHECK(cut_region(sphere, Region::none(sphere.shared_topology())) == ErrorCode::region_empty);
    CHECK(cut_region(sphere, Region::all(torus.shared_topology())) == ErrorCode::topology_mismatch);
    CHECK(cut_region(grid, select_plane(grid, Vec3::Zero(), {1, 0, 0})) ==
          ErrorCode::boundary_conflict);
    CHECK(code([&] {
              (void)cut(sphere, CutPath{ring(1, 0, 0, 8), {}, 0.5});
          }) == ErrorCode::invalid_argument);
}
