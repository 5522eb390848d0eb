#include "kernel/mesh/resample/decimate.h"

#include <algorithm>

#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

Mesh fine_sphere() {
    return make_sphere({.segments = 24});
}

double greatest_distance(const Mesh& from, const Mesh& to) {
    const SpatialTree tree(to);
    double greatest = 0.0;
    for (const Vec3& p : from.positions()) greatest = std::max(greatest, tree.nearest(p).distance);
    return greatest;
}

// A tube with texture coordinates that jump from 1 to 0 along one line.
Mesh tube_with_seam(Index around, Index along) {
    std::vector<Vec3> positions;
    FaceList faces;
    Attribute uv{"uv", Domain::corner, 2, ScalarType::float32, {}};
    for (Index j = 0; j <= along; ++j) {
        for (Index i = 0; i < around; ++i) {
            const double angle = 2.0 * kPi * i / around;
            positions.emplace_back(std::cos(angle), 4.0 * j / along, std::sin(angle));
        }
    }
    const auto corner = [&](Index i, Index j, double u) {
        faces.vertices.push_back(j * around + i % around);
        uv.values.push_back(u / around);
        uv.values.push_back(1.0 * j / along);
    };
    for (Index j = 0; j < along; ++j) {
        for (Index i = 0; i < around; ++i) {
            corner(i, j, i);
            corner(i, j + 1, i);
            corner(i + 1, j + 1, i + 1);
            corner(i + 1, j, i + 1);
            faces.offsets.push_back(count_of(faces.vertices));
        }
    }
    Mesh mesh(std::move(positions), std::move(faces));
    mesh.attributes().add(std::move(uv));
    return mesh;
}

}  // namespace

TEST_CASE("decimation reaches the number of faces and keeps a closed shape near") {
    const Mesh sphere = fine_sphere();
    for (const Index faces : {2000, 500, 100}) {
        const DecimateResult coarse = decimate(sphere, {.faces = faces});
        CHECK(coarse.mesh.face_count() <= faces);
        CHECK(coarse.mesh.face_count() > faces - 3);
        CHECK(coarse.mesh.topology().is_closed());
        CHECK(euler_characteristic(coarse.mesh.topology()) == 2);
        CHECK(volume(coarse.mesh) == Approx(volume(sphere)).epsilon(8.0 / faces));
        CHECK(self_intersections(coarse.mesh).empty());
    }
}

TEST_CASE("an error bounds how far decimation goes") {
    const Mesh sphere = fine_sphere();
    const double size = surface_radius(sphere);
    Index before = 2 * sphere.face_count();
    for (const double error : {1e-3 * size, 3e-3 * size, 1e-2 * size}) {
        const DecimateResult coarse = decimate(sphere, {.error = error});
        CHECK(coarse.error <= error);
        CHECK(greatest_distance(sphere, coarse.mesh) < 6.0 * error + 1e-2 * size);
        CHECK(coarse.mesh.face_count() < before);
        before = coarse.mesh.face_count();
    }
}

TEST_CASE("a flat sheet and a box lose everything that says nothing") {
    const Mesh grid = make_grid({.segments = {20, 20}});
    const DecimateResult flat = decimate(grid, {.error = 1e-9});
    CHECK(area(flat.mesh) == Approx(area(grid)).epsilon(1e-9));
    CHECK(flat.mesh.face_count() < 40);
    const Mesh box = subdivide(make_box(), {.levels = 3});
    const DecimateResult corners = decimate(box, {.error = 1e-9});
    CHECK(volume(corners.mesh) == Approx(volume(box)).epsilon(1e-9));
    CHECK(corners.mesh.face_count() < 40);
}

TEST_CASE("decimation commutes with similarities") {
    test::Random random(5);
    const Mesh bar = make_torus({.segments = 24, .tube_segments = 12});
    const DecimateResult plain = decimate(bar, {.faces = 150, .attributes = 0.0});
    Mesh moved = bar;
    const Affine map = test::similarity(random, 3.0);
    transform(moved, map);
    const DecimateResult other = decimate(moved, {.faces = 150, .attributes = 0.0});
    CHECK(other.mesh.face_count() == plain.mesh.face_count());
    CHECK(area(other.mesh) == Approx(9.0 * area(plain.mesh)).epsilon(3e-2));
    CHECK(volume(other.mesh) == Approx(27.0 * volume(plain.mesh)).epsilon(3e-2));
}

TEST_CASE("seams of texture coordinates stay, and coordinates with them") {
    const Mesh tube = tube_with_seam(48, 40);
    const Mesh coarse = decimate(tube, {.faces = 600}).mesh;
    CHECK(coarse.face_count() <= 600);
    const Attribute& uv = *coarse.attributes().find("uv");
    for (Index f = 0; f < coarse.face_count(); ++f) {
        const Index c = coarse.topology().first_corner(f);
        double low = 1.0, high = 0.0;
        for (Index k = 0; k < 3; ++k) {
            const Vec3& p = coarse.position(coarse.topology().face(f)[at(k)]);
            const double u = uv.at(c + k)[0], v = uv.at(c + k)[1];
            low = std::min(low, u);
            high = std::max(high, u);
            CHECK(std::abs(v - p.y() / 4.0) < 2e-2);
            const double turn = std::remainder(std::atan2(p.z(), p.x()) / (2.0 * kPi) - u, 1.0);
            CHECK(std::abs(turn) < 1e-2);
        }
        // No face spans the seam.
        CHECK(high - low < 0.5);
    }
}

TEST_CASE("outlines of regions and labels stay where they are") {
    Mesh mesh = make_cylinder();
    triangulate(mesh);
    std::vector<Index> upper;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.position(v).y() > 0.2) upper.push_back(v);
    }
    mesh.set_region("upper", Region(mesh.shared_topology(), upper));
    const auto loops = mesh.region("upper").boundaries();
    double height = 0.0;
    for (const Index v : loops[0]) height = std::max(height, mesh.position(v).y());
    const Mesh coarse = decimate(mesh, {.faces = 300}).mesh;
    const Region& kept = coarse.region("upper");
    const auto outlines = kept.boundaries();
    REQUIRE(outlines.size() == 1);
    for (const Index v : outlines[0]) {
        CHECK(coarse.position(v).y() == Approx(height).epsilon(1e-9));
    }
    for (Index v = 0; v < coarse.vertex_count(); ++v) {
        CHECK(kept.contains(v) == (coarse.position(v).y() > height - 1e-9));
    }
}

TEST_CASE("nothing outside a region changes") {
    Mesh mesh = fine_sphere();
    triangulate(mesh);
    std::vector<Index> half;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.position(v).x() > 0.0) half.push_back(v);
    }
    const Region region(mesh.shared_topology(), half);
    const DecimateResult coarse = decimate(mesh, {.faces = 1, .region = region});
    CHECK(coarse.mesh.face_count() < mesh.face_count());
    const SpatialTree tree(coarse.mesh);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (!region.contains(v)) CHECK(tree.nearest(mesh.position(v)).distance == 0.0);
    }
}

TEST_CASE("decimation keeps borders if asked, and carries everything") {
    const Mesh grid = test::decorated(make_grid({.segments = {12, 12}}));
    const DecimateResult coarse = decimate(grid, {.faces = 1, .keep_borders = true});
    CHECK(test::is_decorated(coarse.mesh));
    Index border = 0, kept = 0;
    for (Index v = 0; v < grid.vertex_count(); ++v) border += grid.topology().is_boundary(v);
    for (Index v = 0; v < coarse.mesh.vertex_count(); ++v) {
        kept += coarse.mesh.topology().is_boundary(v);
    }
    CHECK(kept == border);
    const Attribute& x = *coarse.mesh.attributes().find("x");
    for (Index v = 0; v < coarse.mesh.vertex_count(); ++v) {
        CHECK(x.at(v)[0] == Approx(coarse.mesh.position(v).x()).epsilon(1e-9));
    }
}

TEST_CASE("decimation refuses what has no limit, and takes meshes without faces") {
    const Mesh sphere = make_sphere();
    CHECK_THROWS_AS(decimate(sphere, {}), Error);
    CHECK_THROWS_AS(decimate(sphere, {.faces = -1}), Error);
    CHECK_THROWS_AS(decimate(sphere, {.error = -1.0}), Error);
    CHECK_THROWS_AS(decimate(sphere, {.faces = 0}), Error);
    CHECK_THROWS_AS(decimate(sphere, {.error = test::kNaN}), Error);
    const Region foreign = Region::all(make_box().shared_topology());
    CHECK_THROWS_AS(decimate(sphere, {.faces = 10, .region = foreign}), Error);
    CHECK(decimate(Mesh(), {.faces = 10}).mesh.vertex_count() == 0);
    const Mesh all = decimate(sphere, {.faces = 1000000}).mesh;
    CHECK(all.vertex_count() == sphere.vertex_count());
    CHECK(decimate(test::tetrahedron(), {.faces = 1}).mesh.face_count() == 4);
}
