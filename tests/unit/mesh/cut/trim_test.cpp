#include "kernel/mesh/cut/trim.h"

#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/cut/cut_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// The part of a mesh on one side of a plane, cut along the edges of its faces.
Mesh jagged(const Mesh& mesh, const Vec3& point, const Vec3& normal) {
    return extract(mesh, select_plane(mesh, point, normal)).mesh;
}

void check_trim(const Mesh& mesh, const Trim& trimmed) {
    CHECK(test::is_boundary_of(trimmed.mesh, trimmed.boundary));
    CHECK(euler_characteristic(trimmed.mesh.topology()) == euler_characteristic(mesh.topology()));
    CHECK(trimmed.mesh.topology().boundary_loops().size() ==
          mesh.topology().boundary_loops().size());
    test::check_copies(mesh, {trimmed.mesh, trimmed.map});
    CHECK(area(trimmed.mesh) < area(mesh));
    CHECK(trimmed.turn_after == Approx(mean_turn(trimmed.mesh, trimmed.boundary)));
}

}  // namespace

TEST_CASE("the mean turn of a regular polygon is its outer angle") {
    const Mesh disc = make_cylinder({.segments = 24, .caps = false});
    CHECK(mean_turn(disc, boundaries(disc)[0]) == Approx(15 * kDegree));
    const Mesh grid = make_grid();
    const Path straight = path_through(grid, std::array<Index, 2>{0, 10}, false);
    CHECK(mean_turn(grid, straight) == Approx(0.0));
    CHECK(mean_turn(grid, Path({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, false)) == Approx(kPi / 2));
}

TEST_CASE("jagged boundaries become smooth and lose only a thin strip") {
    const Mesh sphere = make_sphere({.segments = 20, .kind = SphereKind::triangles});
    const Mesh cactus = make_cactus({.vertices = 4000, .ribs = 0, .thorns = 0.0});
    for (const Mesh& mesh :
         {jagged(sphere, {0, 0.2, 0}, {0.3, 1, 0.2}), jagged(cactus, {0, 0.3, 0}, {0.3, 1, 0.2})}) {
        REQUIRE(mesh.topology().boundary_loops().size() == 1);
        const Trim trimmed = trim(mesh, boundaries(mesh)[0]);
        check_trim(mesh, trimmed);
        CHECK(trimmed.turn_before > 25 * kDegree);
        CHECK(trimmed.turn_after < 15 * kDegree);
        CHECK(area(trimmed.mesh) > 0.85 * area(mesh));
        CHECK(trimmed.removed_faces > 0);
    }
}

TEST_CASE("trimming does not depend on size, place or direction of the path") {
    const Mesh mesh = jagged(make_sphere({.segments = 14, .kind = SphereKind::triangles}),
                             {0, 0.2, 0}, {0.3, 1, 0.2});
    const Trim reference = trim(mesh, boundaries(mesh)[0]);
    CHECK(test::same_shape(reference.mesh, trim(mesh, boundaries(mesh)[0].reversed()).mesh));
    for (const double scale : {1e-6, 1e6}) {
        const Affine map = translation(Vec3::Constant(100.0 * scale)) *
                           scaling(Vec3::Constant(scale), Vec3::Zero());
        const Mesh other = test::moved(mesh, map);
        const Trim trimmed = trim(other, boundaries(other)[0]);
        CHECK(trimmed.mesh.face_count() == reference.mesh.face_count());
        CHECK(trimmed.turn_after == Approx(reference.turn_after).epsilon(1e-6));
    }
}

TEST_CASE("a mesh with several boundaries keeps the others to the bit") {
    const Mesh tube = make_cylinder({.segments = 24, .rings = 20, .caps = false});
    const Mesh mesh = jagged(tube, {0, 0.3, 0}, {0.4, -1, 0.1});
    const auto paths = boundaries(mesh);
    REQUIRE(paths.size() == 2);
    const std::size_t cut_end = mean_turn(mesh, paths[0]) > mean_turn(mesh, paths[1]) ? 0 : 1;
    const Trim trimmed = trim(mesh, paths[cut_end]);
    check_trim(mesh, trimmed);
    const auto after = boundaries(trimmed.mesh);
    const auto other = paths[1 - cut_end].points(mesh);
    CHECK((after[0].points(trimmed.mesh) == other || after[1].points(trimmed.mesh) == other));
}

TEST_CASE("what cannot be trimmed is refused") {
    const Mesh mesh = jagged(make_sphere({.segments = 8}), {0, 0.2, 0}, {0.3, 1, 0.2});
    const Path border = boundaries(mesh)[0];
    const auto code = [](const auto& action) { return test::error_of(action).code(); };
    CHECK(code([&] { (void)trim(make_sphere(), border); }) == ErrorCode::topology_mismatch);
    CHECK(code([&] {
              (void)trim(mesh, Path(mesh.shared_topology(), {0, 1, 2}, true));
          }) == ErrorCode::not_a_boundary);
    CHECK(code([&] { (void)trim(mesh, border, {.smoothing = 0.0}); }) ==
          ErrorCode::invalid_argument);
    CHECK(code([&] { (void)trim(mesh, border, {.margin = -1.0}); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { (void)trim(mesh, border, {.margin = 1000.0}); }) ==
          ErrorCode::boundary_conflict);
    CHECK(code([&] { (void)trim(mesh, border, {.slide = 1.0}); }) == ErrorCode::invalid_argument);
    // A band of one quad has no room.
    const Mesh band = make_cylinder({.segments = 12, .rings = 1, .caps = false});
    CHECK(code([&] { (void)trim(band, boundaries(band)[0], {.margin = 3.0}); }) ==
          ErrorCode::boundary_conflict);
}
