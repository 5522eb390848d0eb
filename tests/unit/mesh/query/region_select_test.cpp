#include "kernel/mesh/query/region_select.h"

#include <algorithm>
#include <array>

#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;

TEST_CASE("a sphere selects what is within its radius, the surface included") {
    const Mesh mesh = make_box({.size = {2, 2, 2}, .segments = {2, 2, 2}});
    for (const Index v : select_sphere(mesh, Vec3(1, 1, 1), 1.0).vertices()) {
        CHECK((mesh.position(v) - Vec3(1, 1, 1)).norm() <= 1.0);
    }
    CHECK(select_sphere(mesh, Vec3(1, 1, 1), 1.0).size() == 4);
    CHECK(select_sphere(mesh, Vec3(1, 1, 1), 0.0).size() == 1);
    CHECK(select_sphere(mesh, Vec3(9, 9, 9), 1.0).empty());
}

TEST_CASE("a box and a plane include their sides") {
    const Mesh mesh = make_box({.size = {2, 2, 2}, .segments = {2, 2, 2}});
    CHECK(select_box(mesh, {Vec3(0, 0, 0), Vec3(1, 1, 1)}).size() == 7);
    CHECK(select_plane(mesh, Vec3(0, 1, 0), Vec3(0, 5, 0)) == *mesh.find_region("top"));
    CHECK(select_plane(mesh, Vec3(0, -1, 0), Vec3(0, 1, 0)).size() == mesh.vertex_count());
    const double all = test::kInfinity;
    CHECK(select_box(mesh, {Vec3(-all, 0.5, -all), Vec3(all, all, all)}) ==
          *mesh.find_region("top"));
}

TEST_CASE("a geodesic region follows the surface") {
    const Mesh mesh = make_sphere({.segments = 24});
    const Index pole = select_sphere(mesh, Vec3(0, 1, 0), 1e-9).vertices().at(0);
    const Region cap = select_geodesic(mesh, std::array{pole}, 0.25 * kPi);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const double angle = std::acos(std::clamp(mesh.position(v).y(), -1.0, 1.0));
        if (angle < 0.24 * kPi) CHECK(cap.contains(v));
        if (angle > 0.26 * kPi) CHECK(!cap.contains(v));
    }
    CHECK(select_geodesic(mesh, std::array{pole}, 0.0).vertices() == std::vector<Index>{pole});
}

TEST_CASE(
    "labels select the vertices of their faces and unknown ones are answered with the known") {
    Mesh mesh = test::decorated(test::patch());
    mesh.attributes().labels()["material"] = {{"stone", "wood"}, {0, 1, kNoIndex}};
    CHECK(select_group(mesh, "odd").vertices() == std::vector<Index>{0, 2, 3});
    CHECK(select_group(mesh, "even").vertices() == std::vector<Index>{0, 1, 2, 4, 5});
    CHECK(select_material(mesh, "stone").vertices() == std::vector<Index>{0, 1, 2});
    const Error error = test::error_of([&] { (void)select_group(mesh, "evne"); });
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(error.message().find("even, odd") != std::string::npos);
    CHECK(test::error_of([&] { (void)select_label(mesh, "smoothing", "1"); }).code() ==
          ErrorCode::invalid_argument);
}

TEST_CASE("components are selected by number or by a vertex") {
    Mesh mesh = make_box();
    append(mesh, test::tetrahedron());
    CHECK(select_component(mesh, 0).size() == 8);
    CHECK(select_component(mesh, 1).vertices() == std::vector<Index>{8, 9, 10, 11});
    CHECK(select_component_of(mesh, 10) == select_component(mesh, 1));
    CHECK(test::error_of([&] { (void)select_component(mesh, 2); }).code() ==
          ErrorCode::out_of_range);
    CHECK(test::error_of([&] { (void)select_component_of(mesh, 12); }).code() ==
          ErrorCode::out_of_range);
}

TEST_CASE("attributes of every domain select vertices, and elements without a value none") {
    Mesh mesh = test::decorated(test::patch());
    CHECK(select_attribute(mesh, "x", 1.0, 1.5).vertices() == std::vector<Index>{1, 2});
    CHECK(select_attribute(mesh, "part", 20, 20).vertices() == std::vector<Index>{1, 2, 4, 5});
    CHECK(select_attribute(mesh, "uv", 101, 101).vertices() == std::vector<Index>{2});
    mesh.attributes().find("x")->values[1] = test::kNaN;
    CHECK(select_attribute(mesh, "x", 1.0, 1.5).vertices() == std::vector<Index>{2});
    const Error error = test::error_of([&] { (void)select_attribute(mesh, "y", 0, 1); });
    CHECK(error.message().find("x, uv, part") != std::string::npos);
    CHECK(test::error_of([&] { (void)select_attribute(mesh, "x", 1, 0); }).code() ==
          ErrorCode::invalid_argument);
}

TEST_CASE("a predicate is asked once for each vertex, in order") {
    const Mesh mesh = make_box();
    std::vector<Index> asked;
    const Region right = select_where(mesh, [&](Index v, const Vec3& p) {
        asked.push_back(v);
        return p.x() > 0;
    });
    CHECK(right == *mesh.find_region("right"));
    CHECK(asked.size() == 8);
    CHECK(std::is_sorted(asked.begin(), asked.end()));
}

TEST_CASE("nonsense is refused") {
    const Mesh mesh = make_box();
    const auto code = [](const auto& action) { return test::error_of(action).code(); };
    const Vec3 zero = Vec3::Zero(), nan(0, test::kNaN, 0);
    CHECK(code([&] { (void)select_sphere(mesh, zero, -1); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { (void)select_sphere(mesh, zero, test::kNaN); }) ==
          ErrorCode::invalid_argument);
    CHECK(code([&] { (void)select_sphere(mesh, nan, 1); }) == ErrorCode::not_finite);
    CHECK(code([&] {
              (void)select_box(mesh, {Vec3(1, 0, 0), zero});
          }) == ErrorCode::invalid_argument);
    CHECK(code([&] { (void)select_plane(mesh, zero, zero); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { (void)select_plane(mesh, nan, Vec3::UnitX()); }) == ErrorCode::not_finite);
    CHECK(code([&] { (void)select_geodesic(mesh, {}, 1); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { (void)select_geodesic(mesh, std::array{99}, 1); }) == ErrorCode::out_of_range);
}

TEST_CASE("a box in fractions of the bounds") {
    Mesh mesh = make_grid({.size = {4, 2}, .segments = {8, 4}});
    for (Vec3& p : mesh.edit_positions()) p += Vec3(0.1, 7.3, -0.7);
    const Box box = bounds(mesh);
    const auto vertices = [&](const Vec3& min, const Vec3& max) {
        return select_fraction(mesh, Box{min, max}).size();
    };
    const double far = test::kInfinity;
    CHECK(vertices({0, 0, 0}, {1, 1, 1}) == mesh.vertex_count());
    CHECK(vertices({1, -far, -far}, {far, far, far}) == 5);
    CHECK(vertices({-far, -far, -far}, {0, far, far}) == 5);
    CHECK(vertices({0.45, -far, -far}, {0.55, far, far}) == 5);
    CHECK(bounds(mesh, select_fraction(mesh, Box{{0.5, 0, 0}, {1, 1, 1}})).max == box.max);
    CHECK(test::error_of([&] {
              (void)vertices({1, 0, 0}, {0, 1, 1});
          }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("the part of a region that is connected with a point") {
    const Mesh mesh = make_grid({.size = {4, 2}, .segments = {8, 4}});
    const Region ends = select_box(mesh, Box{{-9, -9, -9}, {-1.4, 9, 9}})
                            .united(select_box(mesh, Box{{1.4, -9, -9}, {9, 9, 9}}));
    const Region right = connected_part(mesh, ends, {0.3, 5, 0});
    CHECK(right == select_box(mesh, Box{{1.4, -9, -9}, {9, 9, 9}}));
    CHECK(connected_part(ends, right.vertices().back()) == right);
    const Index between = 4;
    REQUIRE_FALSE(ends.contains(between));
    CHECK(test::error_of([&] { (void)connected_part(ends, between); }).code() ==
          ErrorCode::out_of_range);
    CHECK(test::error_of([&] {
              (void)connected_part(mesh, Region::none(mesh.shared_topology()), Vec3::Zero());
          }).code() == ErrorCode::region_empty);
}
