#include "kernel/mesh/fill/bridge.h"

#include <algorithm>
#include <cmath>

#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/fill/fill.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"
#include "tests/unit/shapes.h"

using namespace lissom;
using namespace lissom::test;
using doctest::Approx;

namespace {

double height_of(const Mesh& mesh, const Path& path) {
    double sum = 0.0;
    for (const Vec3& p : path.points(mesh)) sum += p.y() / path.size();
    return sum;
}

// The boundary around y = `height`.
Path rim_at(const Mesh& mesh, double height) {
    std::vector<Path> all = boundaries(mesh);
    std::sort(all.begin(), all.end(), [&](const Path& a, const Path& b) {
        return std::abs(height_of(mesh, a) - height) < std::abs(height_of(mesh, b) - height);
    });
    return all.front();
}

void cap(Mesh& mesh, double height) {
    fill(mesh, rim_at(mesh, height),
         {.method = FillMethod::area, .subdivide = false, .fair = false});
}

}  // namespace

TEST_CASE("bridge: two tubes become one, with one triangle for each edge of either rim") {
    for (const Index other : {8, 12, 31}) {
        CAPTURE(other);
        Mesh mesh = open_tube(12, 2);
        append(mesh, moved(open_tube(other, 2), translation({0, 4, 0})));
        const Mesh before = mesh;
        const BridgeReport report = bridge(mesh, rim_at(mesh, 1), rim_at(mesh, 3));
        CHECK(report.first_face == before.face_count());
        CHECK(report.face_count == 12 + other);
        CHECK(mesh.face_count() == before.face_count() + report.face_count);
        CHECK(mesh.vertex_count() == before.vertex_count());
        CHECK(mesh.topology().component_count() == 1);
        CHECK(mesh.topology().boundary_loops().size() == 2);
        CHECK(self_intersections(mesh).empty());
        const std::vector<Vec3> normals = face_normals(mesh);
        for (Index f = report.first_face; f < mesh.face_count(); ++f) {
            Vec3 middle = Vec3::Zero();
            for (const Index v : mesh.topology().face(f)) middle += mesh.position(v) / 3.0;
            middle.y() = 0.0;
            CHECK(normals[f].dot(middle.normalized()) > 0.9);
        }
        cap(mesh, -1);
        cap(mesh, 5);
        CHECK(volume(mesh) == Approx(6.0 * kPi).epsilon(0.12));
    }
}

TEST_CASE("bridge: both ends of a tunnel through a box make it a ring") {
    Mesh mesh = make_box({.segments = {4, 4, 4}});
    mesh = remove(mesh, select_box(mesh, {{-0.3, 0.45, -0.3}, {0.3, 0.55, 0.3}})).mesh;
    mesh = remove(mesh, select_box(mesh, {{-0.3, -0.55, -0.3}, {0.3, -0.45, 0.3}})).mesh;
    REQUIRE(boundaries(mesh).size() == 2);
    bridge(mesh, rim_at(mesh, 0.5), rim_at(mesh, -0.5));
    CHECK(boundaries(mesh).empty());
    CHECK(euler_characteristic(mesh.topology()) == 0);
    CHECK(volume(mesh) == Approx(0.75));
    CHECK(self_intersections(mesh).empty());
}

TEST_CASE("bridge: triangles have what the rims have, and nothing is absent") {
    Mesh mesh = open_tube(8, 2);
    append(mesh, moved(open_tube(8, 2), translation({0, 4, 0})));
    const Topology& old = mesh.topology();
    Attribute uv{"uv", Domain::corner, 2, ScalarType::float32, {}};
    for (const Index v : old.faces().vertices) {
        uv.values.push_back(mesh.position(v).x());
        uv.values.push_back(mesh.position(v).y());
    }
    mesh.attributes().add(uv);
    Attribute heat{"heat", Domain::face, 1, ScalarType::float32, {}};
    FaceLabels labels{{"low", "high"}, {}};
    for (Index f = 0; f < old.face_count(); ++f) {
        const bool high = mesh.position(old.face(f)[0]).y() > 2.0;
        heat.values.push_back(high ? 7.0 : 5.0);
        labels.of_face.push_back(high ? 1 : 0);
    }
    mesh.attributes().add(heat);
    mesh.attributes().labels()["group"] = labels;
    const BridgeReport report = bridge(mesh, rim_at(mesh, 3), rim_at(mesh, 1));
    const Attribute& carried = *mesh.attributes().find("uv");
    Index high = 0;
    for (Index f = report.first_face; f < mesh.face_count(); ++f) {
        const Index label = mesh.attributes().labels().at("group").of_face[f];
        CHECK(mesh.attributes().find("heat")->values[f] == (label == 1 ? 7.0 : 5.0));
        high += label == 1;
        for (int k = 0; k < 3; ++k) {
            const Vec3& p = mesh.position(mesh.topology().face(f)[k]);
            const auto value = carried.at(mesh.topology().first_corner(f) + k);
            CHECK(value[0] == p.x());
            CHECK(value[1] == p.y());
        }
    }
    CHECK(high == 8);
}

TEST_CASE("bridge: edges that exist between two rims are not used again") {
    // Two holes in a grid with one row of faces between them.
    Mesh mesh = make_grid({.size = {5, 3}, .segments = {5, 3}});
    mesh = remove(mesh, select_box(mesh, {{-1.6, -1, -0.6}, {-0.4, 1, 0.6}})).mesh;
    mesh = remove(mesh, select_box(mesh, {{0.4, -1, -0.6}, {1.6, 1, 0.6}})).mesh;
    std::vector<Path> holes = boundaries(mesh);
    std::erase_if(holes, [](const Path& path) { return path.size() != 4; });
    REQUIRE(holes.size() == 2);
    const Index before = euler_characteristic(mesh.topology());
    const BridgeReport report = bridge(mesh, holes[0], holes[1]);
    CHECK(report.face_count == 8);
    CHECK(euler_characteristic(mesh.topology()) == before);
    CHECK(boundaries(mesh).size() == 1);
}

TEST_CASE("bridge: what cannot be joined is refused, and the mesh stays") {
    Mesh mesh = open_tube(12, 2);
    Mesh over = moved(open_tube(12, 2), translation({0, 4, 0}));
    flip(over);
    append(mesh, over);
    const std::uint64_t before = hash(mesh);
    const auto code = [&](const Path& a, const Path& b) {
        return test::error_of([&] { bridge(mesh, a, b); }).code();
    };
    const Path low = rim_at(mesh, 1), high = rim_at(mesh, 3);
    CHECK(code(low, low.reversed()) == ErrorCode::boundary_conflict);
    CHECK(code(low, boundaries(open_tube(12, 2))[0]) == ErrorCode::topology_mismatch);
    CHECK(code(low, Path({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, true)) == ErrorCode::not_a_boundary);
    CHECK(code(low, Path(mesh.shared_topology(), {0, 1, 2}, false)) == ErrorCode::not_a_boundary);
    CHECK(code(low, high) == ErrorCode::inconsistent_orientation);
    CHECK(hash(mesh) == before);
}
