#include "kernel/mesh/edit/thicken.h"

#include <algorithm>

#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

TEST_CASE("the faces of a box move evenly") {
    for (const double distance : {0.5, -0.2}) {
        Mesh box = make_box({.size = {1, 2, 3}});
        CHECK(offset(box, distance).empty());
        const double d = 2.0 * distance;
        CHECK(volume(box) == Approx((1 + d) * (2 + d) * (3 + d)).epsilon(5e-3));
    }
    Mesh box = make_box();
    const Mesh before = box;
    offset(box, 0.0);
    CHECK(test::same_shape(box, before));
}

TEST_CASE("a sheet becomes a closed shell of its area times the thickness") {
    const Mesh grid = test::decorated(make_grid({.segments = {6, 4}}));
    for (const double outside : {0.0, 0.3, 1.0}) {
        const Shell shell = thicken(grid, {.thickness = 0.01, .outside = outside});
        CHECK(shell.mesh.topology().is_closed());
        CHECK(shell.crossings.empty());
        CHECK(euler_characteristic(shell.mesh.topology()) == 2);
        CHECK(volume(shell.mesh) == Approx(0.01 * area(grid)).epsilon(1e-9));
        CHECK(shell.mesh.vertex_count() == 2 * grid.vertex_count());
        CHECK(test::is_decorated(shell.mesh));
    }
}

TEST_CASE("a closed surface becomes hollow") {
    const Mesh sphere = make_sphere();
    const Shell shell = thicken(sphere, {.thickness = 0.1 * surface_radius(sphere)});
    CHECK(shell.mesh.topology().component_count() == 2);
    CHECK(volume(shell.mesh) < 0.35 * volume(sphere));
    CHECK(volume(shell.mesh) > 0.2 * volume(sphere));
    const Attribute normals{"normal", Domain::vertex, 3, ScalarType::float32, {}};
    Mesh with_normals = sphere;
    Attribute own = normals;
    for (const Vec3& n : vertex_normals(sphere)) {
        own.values.insert(own.values.end(), n.begin(), n.end());
    }
    with_normals.attributes().add(std::move(own));
    const Mesh solid = thicken(with_normals, {.thickness = 0.1}).mesh;
    const std::vector<Vec3> expected = vertex_normals(solid);
    const Attribute& carried = *solid.attributes().find("normal");
    for (Index v = 0; v < solid.vertex_count(); ++v) {
        const Vec3 n(carried.at(v)[0], carried.at(v)[1], carried.at(v)[2]);
        CHECK(n.dot(expected[at(v)]) > 0.99);
    }
}

TEST_CASE("a shell thicker than its body is told") {
    const Mesh bar = make_bar();
    const Box box = [&] {
        Box b;
        for (const Vec3& p : bar.positions()) b.extend(p);
        return b;
    }();
    const double width = (box.max - box.min).minCoeff();
    CHECK(thicken(bar, {.thickness = 0.1 * width}).crossings.empty());
    CHECK_FALSE(thicken(bar, {.thickness = 0.8 * width}).crossings.empty());
    CHECK(thicken(bar, {.thickness = 0.8 * width, .check = false}).crossings.empty());
}

TEST_CASE("shells refuse thicknesses that are none") {
    const Mesh grid = make_grid();
    CHECK_THROWS_AS(thicken(grid, {}), Error);
    CHECK_THROWS_AS(thicken(grid, {.thickness = test::kNaN}), Error);
    CHECK_THROWS_AS(thicken(grid, {.thickness = 1.0, .outside = 2.0}), Error);
    CHECK_THROWS_AS(thicken(Mesh(), {.thickness = 1.0}), Error);
    Mesh box = make_box();
    CHECK_THROWS_AS(offset(box, test::kInfinity), Error);
}

TEST_CASE("shells and offsets refuse lengths beyond the mesh") {
    const Mesh grid = make_grid();
    const double size = bounds(grid).diagonal();
    CHECK_THROWS_AS(thicken(grid, {.thickness = 1e9}), Error);
    CHECK_THROWS_AS(thicken(grid, {.thickness = 1e9, .outside = 0.5}), Error);
    CHECK(thicken(grid, {.thickness = 3.0 * size}).crossings.empty());
    const Mesh before = make_sphere();
    const Vec3 extent = bounds(before).max - bounds(before).min;
    const double depth = extent.minCoeff();
    for (const double distance : {-1.01 * depth, -1e9, 1e9}) {
        Mesh sphere = before;
        CHECK_THROWS_AS(offset(sphere, distance), Error);
        CHECK(hash(sphere) == hash(before));
    }
    Mesh sphere = before;
    offset(sphere, 3.0 * depth);
    CHECK(volume(sphere) > volume(before));
    CHECK_THROWS_AS(thicken(before, {.thickness = 1.01 * depth}), Error);
    CHECK(thicken(before, {.thickness = 1.01 * depth, .outside = 1.0}).mesh.face_count() > 0);
}
