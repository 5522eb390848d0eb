#include "kernel/mesh/edit/subdivide.h"

#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

constexpr std::array kSchemes{SubdivisionScheme::midpoint, SubdivisionScheme::loop,
                              SubdivisionScheme::catmull_clark};

Mesh l_shaped_plate() {
    FaceList faces;
    faces.add({0, 1, 2, 3, 4, 5});
    return {{{0, 0, 0}, {3, 0, 0}, {3, 0.2, 0}, {0.2, 0.2, 0}, {0.2, 3, 0}, {0, 3, 0}},
            std::move(faces)};
}

}  // namespace

TEST_CASE("every scheme keeps topology, old ids and what the mesh holds") {
    for (const SubdivisionScheme scheme : kSchemes) {
        for (const Mesh& mesh : {test::decorated(make_torus({.segments = 6, .tube_segments = 4})),
                                 test::decorated(test::patch())}) {
            const Mesh fine = subdivide(mesh, {.levels = 2, .scheme = scheme});
            CHECK(euler_characteristic(fine.topology()) == euler_characteristic(mesh.topology()));
            CHECK(fine.topology().boundary_loops().size() ==
                  mesh.topology().boundary_loops().size());
            CHECK(test::is_decorated(fine));
            for (const Index v : mesh.find_region("half")->vertices()) {
                CHECK(fine.find_region("half")->contains(v));
            }
        }
    }
}

TEST_CASE("midpoints keep the shape exactly") {
    const Mesh box = make_box({.size = {1, 2, 3}});
    const Mesh fine = subdivide(box, {.levels = 3});
    CHECK(fine.face_count() == 6 * 64);
    CHECK(area(fine) == Approx(area(box)).epsilon(1e-14));
    CHECK(volume(fine) == Approx(volume(box)).epsilon(1e-14));
    for (Index v = 0; v < 8; ++v) CHECK(fine.position(v) == box.position(v));
}

TEST_CASE("triangles become four, polygons one quad a corner") {
    const Mesh fine = subdivide(test::patch());
    CHECK(fine.face_count() == 4 + 4 + 4);
    CHECK(fine.vertex_count() == 6 + 8 + 1);
    CHECK(fine.topology().face(0).size() == 3);
    CHECK(fine.topology().face(8).size() == 4);
    CHECK(area(fine) == Approx(2.0));
}

TEST_CASE("a polygon that does not see itself from its middle does not fold") {
    const Mesh plate = l_shaped_plate();
    const Mesh fine = subdivide(plate, {.levels = 2});
    CHECK(area(fine) == Approx(area(plate)));
    for (const Vec3& n : face_normals(fine)) CHECK(n.z() > 0.999);
}

TEST_CASE("attributes are linear within faces, so that linear ones stay exact") {
    for (const SubdivisionScheme scheme : kSchemes) {
        const Mesh mesh = test::decorated(make_box({.segments = {2, 1, 1}}));
        const Mesh fine = subdivide(mesh, {.levels = 1, .scheme = SubdivisionScheme::midpoint});
        for (Index v = 0; v < fine.vertex_count(); ++v) {
            CHECK(fine.attributes().find("x")->values[v] == Approx(fine.position(v).x()));
        }
        // Corner values stay within the range of their face, whatever the scheme.
        const Mesh smooth = subdivide(mesh, {.levels = 2, .scheme = scheme});
        const Attribute &uv = *smooth.attributes().find("uv"),
                        &part = *smooth.attributes().find("part");
        for (Index f = 0; f < smooth.face_count(); ++f) {
            for (Index c = smooth.topology().first_corner(f);
                 c < smooth.topology().first_corner(f + 1); ++c) {
                const double within = uv.at(c)[0] - 10.0 * part.values[f];
                CHECK(within >= 0.0);
                CHECK(within <= 3.0);
            }
        }
    }
}

TEST_CASE("smooth schemes round a box off toward a smaller, rounder one") {
    Mesh box = make_box({.segments = {2, 2, 2}});
    for (const SubdivisionScheme scheme :
         {SubdivisionScheme::loop, SubdivisionScheme::catmull_clark}) {
        double last = volume(box);
        double lost = last;
        for (Index level = 1; level <= 3; ++level) {
            const double now = volume(subdivide(box, {.levels = level, .scheme = scheme}));
            CHECK(now < last);
            CHECK(last - now < lost);
            lost = last - now;
            last = now;
        }
    }
}

TEST_CASE("regular Catmull-Clark vertices are those of the uniform cubic B-spline") {
    Mesh grid = make_grid({.size = {4, 4}, .segments = {4, 4}});
    grid.edit_positions()[12].y() = 1.0;  // the middle
    const Mesh fine = subdivide(grid, {.scheme = SubdivisionScheme::catmull_clark});
    CHECK(fine.position(12).y() == Approx(36.0 / 64.0));
    CHECK(fine.position(7).y() == Approx(6.0 / 64.0));
    CHECK(fine.position(6).y() == Approx(1.0 / 64.0));
}

TEST_CASE("regular Loop vertices have the weights of the box spline") {
    Mesh grid = make_grid({.size = {4, 4}, .segments = {4, 4}});
    triangulate(grid);
    grid.edit_positions()[12].y() = 1.0;
    REQUIRE(grid.topology().valence(12) == 6);
    const Mesh fine = subdivide(grid, {.scheme = SubdivisionScheme::loop});
    CHECK(fine.position(12).y() == Approx(10.0 / 16.0));
    CHECK(fine.position(grid.topology().neighbors(12)[0]).y() == Approx(1.0 / 16.0));
}

TEST_CASE("boundaries are curves of their own") {
    for (const SubdivisionScheme scheme :
         {SubdivisionScheme::loop, SubdivisionScheme::catmull_clark}) {
        Mesh grid = make_grid({.size = {4, 4}, .segments = {4, 4}});
        Mesh bent = grid;
        bent.edit_positions()[12].y() = 5.0;
        const Mesh a = subdivide(grid, {.scheme = scheme}), b = subdivide(bent, {.scheme = scheme});
        for (Index v = 0; v < a.vertex_count(); ++v) {
            if (a.topology().is_boundary(v)) CHECK(a.position(v) == b.position(v));
        }
    }
}

TEST_CASE("subdivision commutes with affine maps") {
    test::Random random(10);
    const Affine map = test::similarity(random, 7.0);
    const Mesh mesh = make_cylinder({.segments = 8, .rings = 3});
    for (const SubdivisionScheme scheme : kSchemes) {
        const Mesh a = test::moved(subdivide(mesh, {.scheme = scheme}), map);
        const Mesh b = subdivide(test::moved(mesh, map), {.scheme = scheme});
        REQUIRE(a.vertex_count() == b.vertex_count());
        for (Index v = 0; v < a.vertex_count(); ++v) {
            CHECK((a.position(v) - b.position(v)).norm() < 1e-12);
        }
    }
}

TEST_CASE("levels below 0 and results beyond counting are refused") {
    const Mesh box = make_box();
    CHECK(hash(subdivide(box, {.levels = 0})) == hash(box));
    CHECK(test::error_of([&] { (void)subdivide(box, {.levels = -1}); }).code() ==
          ErrorCode::invalid_argument);
    ContextOptions options;
    options.memory_limit = 1000000;
    CHECK(test::error_of([&] { (void)subdivide(box, {.levels = 40}, Context(options)); }).code() ==
          ErrorCode::memory_limit);
}

namespace {

bool keeps_shape(const Mesh& mesh, const Mesh& fine) {
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (fine.position(v) != mesh.position(v)) return false;
    }
    return std::abs(area(fine) - area(mesh)) < 1e-12 * area(mesh);
}

}  // namespace

TEST_CASE("subdivide: a region alone is split, without T-junctions, and all values stay linear") {
    for (const SubdivisionScheme scheme : kSchemes) {
        for (const Mesh& mesh :
             {test::decorated(make_torus({.segments = 12, .tube_segments = 8})),
              test::decorated(make_sphere({.segments = 12, .kind = SphereKind::triangles}))}) {
            const Region half = select_box(mesh, {{0.0, -9, -9}, {9, 9, 9}});
            const Mesh fine = subdivide(mesh, {2, scheme, half});
            CHECK(fine.topology().is_closed());
            CHECK(euler_characteristic(fine.topology()) == euler_characteristic(mesh.topology()));
            CHECK(test::is_decorated(fine));
            CHECK(fine.face_count() > mesh.face_count() + 11 * count_of(half.faces()));
            // What does not touch the region is as it was.
            for (Index v = 0; v < mesh.vertex_count(); ++v) {
                if (!half.contains(v)) CHECK(fine.position(v) == mesh.position(v));
            }
            if (scheme != SubdivisionScheme::midpoint) continue;
            CHECK(keeps_shape(mesh, fine));
            for (Index v = 0; v < fine.vertex_count(); ++v) {
                CHECK(fine.attributes().find("x")->values[v] == Approx(fine.position(v).x()));
            }
        }
    }
}

TEST_CASE("subdivide: all of a mesh as a region is the mesh without one") {
    for (const SubdivisionScheme scheme : kSchemes) {
        const Mesh mesh = test::decorated(make_box({.segments = {2, 1, 1}}));
        const Mesh whole = subdivide(mesh, {2, scheme});
        CHECK(hash(subdivide(mesh, {2, scheme, Region::all(mesh.shared_topology())})) ==
              hash(whole));
    }
}

TEST_CASE("subdivide: triangles beside a region are divided as many times as it takes") {
    FaceList faces;
    for (const auto& f : {std::array{0, 1, 2}, {1, 0, 3}, {2, 1, 4}, {0, 2, 5}}) {
        faces.add({f[0], f[1], f[2]});
    }
    const Mesh star({{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, -2, 0}, {3, 2, 0}, {-1, 2, 0}},
                    std::move(faces));
    const Mesh fine = subdivide(star, {.region = Region(star.shared_topology(), {0, 1, 2})});
    CHECK(fine.face_count() == 4 + 3 * 2);
    CHECK(fine.vertex_count() == 6 + 3);
    CHECK(area(fine) == Approx(area(star)));
    CHECK(fine.topology().boundary_loops().size() == 1);
    CHECK(fine.topology().boundary_loops().front().size() == 6);
}

TEST_CASE("subdivide: a region of another mesh and one without a face are refused") {
    const Mesh mesh = make_box(), other = make_box();
    const auto code_of = [&](const Region& region) {
        return test::error_of([&] { subdivide(mesh, {.region = region}); }).code();
    };
    CHECK(code_of(Region::all(other.shared_topology())) == ErrorCode::topology_mismatch);
    CHECK(code_of(Region(mesh.shared_topology(), {0, 1})) == ErrorCode::region_empty);
}
