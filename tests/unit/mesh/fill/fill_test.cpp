#include "kernel/mesh/fill/fill.h"

#include <algorithm>

#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// A sphere without the part above `height`.
Mesh open_sphere(Index segments, double height) {
    const Mesh sphere = make_sphere({.segments = segments});
    return remove(sphere, select_plane(sphere, Vec3(0, height, 0), Vec3(0, 1, 0))).mesh;
}

void check_closed(const Mesh& filled, const Mesh& before, const FillReport& report) {
    CHECK(filled.topology().boundary_loops().size() + 1 ==
          before.topology().boundary_loops().size());
    CHECK(euler_characteristic(filled.topology()) == euler_characteristic(before.topology()) + 1);
    CHECK(filled.vertex_count() == report.first_vertex + report.vertex_count);
    CHECK(filled.face_count() == report.first_face + report.face_count);
    CHECK(report.first_vertex == before.vertex_count());
    for (Index v = 0; v < before.vertex_count(); ++v) {
        CHECK(filled.position(v) == before.position(v));
    }
    for (Index f = 0; f < before.face_count(); ++f) {
        const auto a = filled.topology().face(f), b = before.topology().face(f);
        CHECK(std::equal(a.begin(), a.end(), b.begin(), b.end()));
    }
}

}  // namespace

TEST_CASE("a hole in a sphere is filled by a cap that continues it") {
    const Mesh open = open_sphere(16, 0.6);
    Mesh filled = open;
    const FillReport report = fill(filled, boundaries(filled)[0]);
    check_closed(filled, open, report);
    CHECK(report.folded_edges == 0);
    CHECK(report.vertex_count > 20);
    CHECK(!report.limit_reached);
    CHECK(volume(filled) == Approx(4.0 / 3.0 * kPi).epsilon(0.02));
    for (Index v = report.first_vertex; v < filled.vertex_count(); ++v) {
        CHECK(filled.position(v).norm() == Approx(1.0).epsilon(0.08));
    }
}

TEST_CASE("the patch is as dense as the mesh around it") {
    Mesh mesh = open_sphere(24, 0.5);
    const double spacing = mean_edge_length(mesh);
    const FillReport report = fill(mesh, boundaries(mesh)[0]);
    double sum = 0.0;
    Index count = 0;
    for (Index v = report.first_vertex; v < mesh.vertex_count(); ++v) {
        for (const Index n : mesh.topology().neighbors(v)) {
            sum += (mesh.position(v) - mesh.position(n)).norm();
            ++count;
        }
    }
    CHECK(sum / count == Approx(spacing).epsilon(0.35));
}

TEST_CASE("a flat hole is filled flat, whatever its outline") {
    const Mesh grid = make_grid({.size = {2, 2}, .segments = {16, 16}});
    const Region hole = select_box(grid, {Vec3(-0.8, -1, -0.3), Vec3(0.2, 1, 0.2)})
                            .united(select_box(grid, {Vec3(-0.3, -1, -0.8), Vec3(0.2, 1, 0.8)}));
    Mesh mesh = remove(grid, hole).mesh;
    for (const Path& boundary : boundaries(mesh)) {
        if (boundary.length(mesh) > 7.0) continue;
        const FillReport report = fill(mesh, boundary);
        CHECK(report.folded_edges == 0);
        break;
    }
    CHECK(area(mesh) == Approx(4.0));
    for (const Vec3& n : face_normals(mesh)) CHECK(n.y() > 0.9999);
}

TEST_CASE("without refinement the patch has no new vertices") {
    const Mesh open = open_sphere(8, 0.4);
    Mesh mesh = open;
    const FillReport report = fill(mesh, boundaries(mesh)[0], {.subdivide = false});
    check_closed(mesh, open, report);
    CHECK(report.vertex_count == 0);
    CHECK(report.face_count == report.loop_size - 2);
}

TEST_CASE("real holes are closed without folds") {
    for (const char* name : {"bar_botsch.off", "lion.off", "bimba_hole.off", "camelhead.off"}) {
        const auto open = test::load_off(name);
        if (!open) continue;
        CAPTURE(name);
        Mesh mesh = *open;
        const FillReport report = fill(mesh, boundaries(mesh)[0]);
        check_closed(mesh, *open, report);
        CHECK(mesh.topology().is_closed());
        CHECK(report.folded_edges == 0);
    }
}

TEST_CASE("long loops are divided and still closed") {
    const Mesh open =
        make_cylinder({.radius = 1.0, .height = 0.2, .segments = 1200, .rings = 4, .caps = false});
    Mesh mesh = open;
    const FillReport report = fill(mesh, boundaries(mesh)[0], {.maximum_vertices = 500});
    check_closed(mesh, open, report);
    CHECK(report.loop_size == 1200);
    CHECK(report.parts > 3);
    CHECK(report.limit_reached);
    CHECK(report.vertex_count == 500);
}

TEST_CASE("a single triangle and a pair of them are closed by their other sides") {
    FaceList faces;
    faces.add({0, 1, 2});
    Mesh triangle({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, faces);
    fill(triangle, boundaries(triangle)[0], {.subdivide = false});
    CHECK(triangle.topology().is_closed());
    CHECK(triangle.face_count() == 2);
    // Of the square's two diagonals one is an edge already.
    faces.add({0, 2, 3});
    Mesh square({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, faces);
    fill(square, boundaries(square)[0], {.subdivide = false});
    CHECK(square.topology().is_closed());
    CHECK(square.face_count() == 4);
}

TEST_CASE("a hole whose diagonals are all edges already gets a vertex in its middle") {
    // The torus of seven vertices joins each to each; without one of them a hexagon is open.
    FaceList faces;
    for (Index i = 0; i < 7; ++i) {
        faces.add({i, (i + 1) % 7, (i + 3) % 7});
        faces.add({i, (i + 3) % 7, (i + 2) % 7});
    }
    std::vector<Vec3> positions;
    test::Random random(14);
    for (int i = 0; i < 7; ++i) positions.push_back(random.direction());
    const Mesh torus(std::move(positions), std::move(faces));
    REQUIRE(genus(torus.topology()) == 1);
    std::vector<Index> kept;
    for (Index f = 0; f < 14; ++f) {
        const auto face = torus.topology().face(f);
        if (std::find(face.begin(), face.end(), 0) == face.end()) kept.push_back(f);
    }
    const Mesh open = extract_faces(torus, kept).mesh;
    Mesh mesh = open;
    const FillReport report = fill(mesh, boundaries(mesh)[0], {.subdivide = false});
    check_closed(mesh, open, report);
    CHECK(report.loop_size == 6);
    CHECK(report.vertex_count == 1);
    CHECK(genus(mesh.topology()) == 1);
}

TEST_CASE("filling carries what the mesh holds; the patch has none but blended vertex values") {
    Mesh mesh = test::decorated(open_sphere(8, 0.4));
    mesh.set_region("half", Region::all(mesh.shared_topology()));
    const FillReport report = fill(mesh, boundaries(mesh)[0]);
    CHECK(test::is_decorated(mesh));
    REQUIRE(report.vertex_count > 0);
    const double x = mesh.attributes().find("x")->values[report.first_vertex];
    CHECK(std::abs(x) < 1.0);
    CHECK(mesh.find_region("half")->contains(report.first_vertex));
    CHECK(std::isnan(mesh.attributes().find("part")->values[report.first_face]));
    CHECK(mesh.attributes().labels().at("group").of_face[report.first_face] == kNoIndex);
    CHECK(std::isnan(mesh.attributes().find("uv")->values.back()));
}

TEST_CASE("filling does not depend on frame and scale") {
    const Mesh open = open_sphere(10, 0.5);
    test::Random random(13);
    for (const double scale : {1e-5, 1e5}) {
        const Affine map = test::similarity(random, scale);
        Mesh here = open, there = test::moved(open, map);
        fill(here, boundaries(here)[0]);
        fill(there, boundaries(there)[0]);
        REQUIRE(here.vertex_count() == there.vertex_count());
        for (Index v = 0; v < here.vertex_count(); ++v) {
            CHECK((map(here.position(v)) - there.position(v)).norm() < 1e-8 * scale);
        }
    }
}

TEST_CASE("the direction of the path does not matter") {
    Mesh a = open_sphere(8, 0.4), b = open_sphere(8, 0.4);
    fill(a, boundaries(a)[0]);
    fill(b, boundaries(b)[0].reversed());
    CHECK(hash(a) == hash(b));
}

TEST_CASE("only an open boundary of the mesh can be filled") {
    Mesh mesh = open_sphere(8, 0.4);
    const std::uint64_t before = hash(mesh);
    const Mesh other = open_sphere(8, 0.4);
    const auto code = [&](const Path& path, const Context& context = {}) {
        return test::error_of([&] { fill(mesh, path, {}, context); }).code();
    };
    CHECK(code(Path({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, true)) ==
          ErrorCode::invalid_argument);
    CHECK(code(boundaries(other)[0]) == ErrorCode::topology_mismatch);
    CHECK(code(Path(mesh.shared_topology(), {0, 1, 2}, true)) == ErrorCode::invalid_argument);
    const Context context;
    context.cancel();
    CHECK(code(boundaries(mesh)[0], context) == ErrorCode::cancelled);
    CHECK(hash(mesh) == before);
}
