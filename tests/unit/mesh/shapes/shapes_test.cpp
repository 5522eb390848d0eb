#include "kernel/mesh/shapes/shapes.h"

#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// Closed, of the genus, outward, without folds between neighbouring faces.
void check_solid(const Mesh& mesh, Index expected_genus) {
    CHECK(mesh.topology().is_closed());
    CHECK(mesh.topology().component_count() == 1);
    CHECK(genus(mesh.topology()) == expected_genus);
    CHECK(volume(mesh) > 0.0);
    CHECK(zero_area_faces(mesh).empty());
    const std::vector<Vec3> of_face = face_normals(mesh), of_vertex = vertex_normals(mesh);
    Index folded = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        for (const Index v : mesh.topology().face(f)) folded += of_face[f].dot(of_vertex[v]) <= 0.0;
    }
    CHECK(folded == 0);
}

template <typename Make>
ErrorCode refusal(const Make& make) {
    return test::error_of([&] { (void)make(); }).code();
}

}  // namespace

TEST_CASE("all shapes are closed, outward and of the genus they look") {
    check_solid(make_box({.segments = {2, 3, 4}}), 0);
    check_solid(make_bar(), 0);
    check_solid(make_sphere(), 0);
    check_solid(make_sphere({.segments = 1}), 0);
    check_solid(make_sphere({.segments = 1, .kind = SphereKind::triangles}), 0);
    check_solid(make_sphere({.segments = 9, .kind = SphereKind::triangles}), 0);
    check_solid(make_cylinder(), 0);
    check_solid(make_cylinder({.segments = 3, .rings = 1, .cap_rings = 1}), 0);
    check_solid(make_torus(), 1);
    check_solid(make_torus({.segments = 8, .tube_segments = 5}), 1);
    CHECK(genus(make_torus({.segments = 3, .tube_segments = 3}).topology()) == 1);
}

TEST_CASE("counts are as documented") {
    CHECK(make_box().vertex_count() == 8);
    CHECK(make_box({.segments = {2, 3, 4}}).face_count() == 2 * (6 + 12 + 8));
    CHECK(make_sphere({.segments = 5}).vertex_count() == 6 * 25 + 2);
    CHECK(make_sphere({.segments = 5, .kind = SphereKind::triangles}).vertex_count() ==
          10 * 25 + 2);
    CHECK(make_torus().vertex_count() == 48 * 24);
    CHECK(make_grid().vertex_count() == 121);
    CHECK(make_cylinder({.segments = 8, .rings = 2, .caps = false}).vertex_count() == 24);
}

TEST_CASE("the bar gives 24,480 vertices between its ends") {
    const Mesh bar = make_bar({.width = 1.0, .length = 4.75, .across = 36, .along = 171});
    CHECK(bar.vertex_count() - bar.find_region("bottom")->size() - bar.find_region("top")->size() ==
          24480);
    CHECK(area(bar) == Approx(2.0 + 4 * 4.75));
    CHECK(volume(bar) == Approx(4.75));
}

TEST_CASE("sphere vertices lie on the sphere") {
    for (const SphereKind kind : {SphereKind::quads, SphereKind::triangles}) {
        const Mesh sphere = make_sphere({.radius = 2.5, .segments = 7, .kind = kind});
        for (const Vec3& p : sphere.positions()) CHECK(p.norm() == Approx(2.5).epsilon(1e-14));
    }
}

TEST_CASE("cylinder and torus converge to their volumes") {
    const Mesh cylinder = make_cylinder({.radius = 0.5, .height = 2, .segments = 200});
    CHECK(volume(cylinder) == Approx(0.5 * kPi).epsilon(1e-3));
    CHECK(area(cylinder) == Approx(2 * kPi + 0.5 * kPi).epsilon(1e-3));
    const Mesh torus =
        make_torus({.radius = 1, .tube_radius = 0.25, .segments = 200, .tube_segments = 100});
    CHECK(volume(torus) == Approx(2 * kPi * kPi * 0.0625).epsilon(3e-3));
    CHECK(area(torus) == Approx(4 * kPi * kPi * 0.25).epsilon(3e-3));
}

TEST_CASE("open shapes have their boundaries and regions") {
    const Mesh grid = make_grid({.size = {2, 3}, .segments = {4, 5}});
    CHECK(area(grid) == Approx(6.0));
    for (const Vec3& n : face_normals(grid)) CHECK(n == Vec3(0, 1, 0));
    CHECK(grid.find_region("border")->size() == 18);
    const Mesh tube = make_cylinder({.caps = false});
    CHECK(tube.topology().boundary_loops().size() == 2);
    CHECK(tube.find_region("top")->size() == 32);
    CHECK(!tube.find_region("caps"));
    const Mesh capped = make_cylinder({.cap_rings = 4});
    CHECK(capped.find_region("caps")->size() == 2 * (4 * 32 + 1));
    CHECK(center(capped, *capped.find_region("top")).y() == Approx(1.0));
}

TEST_CASE("regions of a box are its sides") {
    const Mesh box = make_box({.size = {2, 4, 6}, .segments = {2, 3, 4}});
    CHECK((center(box, *box.find_region("left")) - Vec3(-1, 0, 0)).norm() < 1e-15);
    CHECK((center(box, *box.find_region("top")) - Vec3(0, 2, 0)).norm() < 1e-15);
    CHECK((center(box, *box.find_region("back")) - Vec3(0, 0, -3)).norm() < 1e-15);
    CHECK(box.find_region("front")->size() == 12);
}

TEST_CASE("the cactus is one closed manifold of about the vertices asked for") {
    for (const Index vertices : {2000, 9000, 30000}) {
        for (const Index ribs : {0, 8, 12, 20}) {
            CAPTURE(vertices);
            CAPTURE(ribs);
            const Mesh cactus = make_cactus({.vertices = vertices, .ribs = ribs});
            CHECK(std::abs(cactus.vertex_count() - vertices) <= vertices / 10);
            check_solid(cactus, 0);
        }
    }
}

TEST_CASE("the cactus stands on the ground and has the height and regions asked for") {
    const Mesh cactus = make_cactus({.height = 3.0});
    CHECK(bounds(cactus).min.y() == Approx(0.0));
    CHECK(bounds(cactus).max.y() == Approx(3.0).epsilon(0.01));
    CHECK(std::abs(surface_centroid(cactus).z()) < 0.01);
    CHECK(center(cactus, *cactus.find_region("tip")).y() > 2.5);
    CHECK(center(cactus, *cactus.find_region("base")).y() < 0.2);
    CHECK(center(cactus, *cactus.find_region("left_arm")).x() < -0.5);
    CHECK(center(cactus, *cactus.find_region("right_arm")).x() > 0.5);
    CHECK(cactus.find_region("left_tip")->minus(*cactus.find_region("left_arm")).empty());
    CHECK(cactus.find_region("right_tip")->size() > 20);
}

TEST_CASE("ribs and thorns shape the cactus, and scale with it") {
    const double smooth = area(make_cactus({.rib_depth = 0, .thorns = 0}));
    const double ribbed = area(make_cactus({.thorns = 0}));
    CHECK(area(make_cactus()) > ribbed);
    CHECK(volume(make_cactus({.thorns = 0})) < volume(make_cactus({.rib_depth = 0, .thorns = 0})));
    CHECK(area(make_cactus({.height = 4, .rib_depth = 0, .thorns = 0})) == Approx(4 * smooth));
}

TEST_CASE("nonsense is refused") {
    const double nan = test::kNaN;
    const ErrorCode invalid = ErrorCode::invalid_argument;
    CHECK(refusal([] { return make_box({.size = {1, 0, 1}}); }) == invalid);
    CHECK(refusal([] { return make_box({.segments = {1, 0, 1}}); }) == invalid);
    CHECK(refusal([&] { return make_bar({.width = nan}); }) == invalid);
    CHECK(refusal([] { return make_bar({.along = 0}); }) == invalid);
    CHECK(refusal([] { return make_sphere({.radius = -1}); }) == invalid);
    CHECK(refusal([] { return make_cylinder({.segments = 2}); }) == invalid);
    CHECK(refusal([] { return make_cylinder({.height = test::kInfinity}); }) == invalid);
    CHECK(refusal([] { return make_grid({.segments = {0, 1}}); }) == invalid);
    CHECK(refusal([] { return make_torus({.radius = 1, .tube_radius = 1}); }) == invalid);
    CHECK(refusal([] { return make_cactus({.vertices = 100}); }) == invalid);
    CHECK(refusal([] { return make_cactus({.ribs = 3}); }) == invalid);
    CHECK(refusal([] { return make_cactus({.vertices = 2000, .ribs = 40}); }) == invalid);
    CHECK(refusal([&] { return make_cactus({.rib_depth = nan}); }) == invalid);
    CHECK(refusal([&] { return make_cactus({.height = 0}); }) == invalid);
}

TEST_CASE("more faces than can be numbered are refused before memory is taken") {
    const Index most = std::numeric_limits<Index>::max();
    const ErrorCode range = ErrorCode::out_of_range;
    CHECK(refusal([&] { return make_box({.segments = {most, most, most}}); }) == range);
    CHECK(refusal([&] { return make_bar({.along = most}); }) == range);
    CHECK(refusal([&] { return make_sphere({.segments = most}); }) == range);
    CHECK(refusal([&] { return make_grid({.segments = {most, most}}); }) == range);
    CHECK(refusal([&] { return make_torus({.segments = most, .tube_segments = most}); }) == range);
    CHECK(refusal([&] { return make_cylinder({.segments = most, .rings = most}); }) == range);
}
