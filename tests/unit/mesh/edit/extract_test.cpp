#include "kernel/mesh/edit/extract.h"

#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

void check_maps(const Mesh& mesh, const MeshPart& part) {
    for (Index v = 0; v < part.mesh.vertex_count(); ++v) {
        CHECK(part.mesh.position(v) == mesh.position(part.vertex_map[v]));
    }
    for (Index f = 0; f < part.mesh.face_count(); ++f) {
        const auto now = part.mesh.topology().face(f), old = mesh.topology().face(part.face_map[f]);
        REQUIRE(now.size() == old.size());
        for (std::size_t k = 0; k < now.size(); ++k) CHECK(part.vertex_map[now[k]] == old[k]);
    }
}

}  // namespace

TEST_CASE("a part and the rest make up the whole") {
    const Mesh mesh = make_sphere({.segments = 8});
    const Region cap = select_plane(mesh, Vec3(0, 0.3, 0), Vec3(0, 1, 0));
    const MeshPart part = extract(mesh, cap), rest = remove(mesh, cap);
    check_maps(mesh, part);
    check_maps(mesh, rest);
    CHECK(part.mesh.face_count() + rest.mesh.face_count() == mesh.face_count());
    CHECK(area(part.mesh) + area(rest.mesh) == Approx(area(mesh)));
    CHECK(part.mesh.vertex_count() == cap.size());
    REQUIRE(part.mesh.topology().boundary_loops().size() == 1);
    CHECK(part.mesh.topology().boundary_edge_count() == rest.mesh.topology().boundary_edge_count());
}

TEST_CASE("parts keep attributes, labels, regions and libraries") {
    const Mesh mesh = test::decorated(make_sphere({.segments = 4}));
    const Region cap = select_plane(mesh, Vec3(0, 0.1, 0), Vec3(0, 1, 0));
    for (const MeshPart& part : {extract(mesh, cap), remove(mesh, cap)}) {
        CHECK(test::is_decorated(part.mesh));
        const Attribute& x = *part.mesh.attributes().find("x");
        for (Index v = 0; v < part.mesh.vertex_count(); ++v) {
            CHECK(x.values[v] == mesh.position(part.vertex_map[v]).x());
            CHECK(part.mesh.find_region("half")->contains(v) == (part.vertex_map[v] % 2 == 0));
        }
        for (Index f = 0; f < part.mesh.face_count(); ++f) {
            CHECK(part.mesh.attributes().find("part")->values[f] == 10.0 * part.face_map[f]);
            CHECK(part.mesh.attributes().labels().at("group").of_face[f] == part.face_map[f] % 2);
        }
    }
}

TEST_CASE("where faces only touch, each fan gets its own vertex, after all others") {
    const Mesh mesh = make_grid({.size = {2, 2}, .segments = {2, 2}});
    const MeshPart part = extract(mesh, Region(mesh.shared_topology(), {0, 1, 3, 4, 5, 7, 8}));
    CHECK(part.mesh.face_count() == 2);
    CHECK(part.vertex_map == std::vector<Index>{0, 1, 3, 4, 5, 7, 8, 4});
    CHECK(part.mesh.topology().component_count() == 2);
    check_maps(mesh, part);
    // What is left are the two other quads, which meet in the same vertex.
    CHECK(remove(mesh, Region(mesh.shared_topology(), {0, 1, 3, 4, 5, 7, 8})).mesh.face_count() ==
          2);
}

TEST_CASE("random parts are always manifold") {
    const Mesh mesh = make_torus({.segments = 16, .tube_segments = 8});
    test::Random random(9);
    for (int i = 0; i < 30; ++i) {
        std::vector<Index> faces;
        for (Index f = 0; f < mesh.face_count(); ++f) {
            if (random.uniform(0, 1) < 0.5) faces.push_back(f);
        }
        const MeshPart part = extract_faces(mesh, faces);
        CHECK(part.face_map == faces);
        check_maps(mesh, part);
    }
}

TEST_CASE("vertices without faces go with their side") {
    Mesh mesh = test::tetrahedron();
    append(mesh, Mesh({{5, 5, 5}, {6, 6, 6}}, FaceList{}));
    const Region region(mesh.shared_topology(), {0, 1, 2, 4});
    CHECK(extract(mesh, region).vertex_map == std::vector<Index>{0, 1, 2, 4});
    CHECK(remove(mesh, region).vertex_map == std::vector<Index>{0, 1, 2, 3, 5});
}

TEST_CASE("taking everything copies, removing everything empties") {
    const Mesh mesh = make_box();
    const Region all = Region::all(mesh.shared_topology());
    CHECK(test::same_shape(extract(mesh, all).mesh, mesh));
    CHECK(remove(mesh, all).mesh.vertex_count() == 0);
}

TEST_CASE("regions without a face or of another mesh are refused") {
    const Mesh mesh = make_box(), other = make_box();
    const auto code = [](const auto& action) { return test::error_of(action).code(); };
    const Region edge(mesh.shared_topology(), {0, 1});
    CHECK(code([&] { (void)extract(mesh, edge); }) == ErrorCode::region_empty);
    CHECK(code([&] { (void)remove(mesh, edge); }) == ErrorCode::region_empty);
    CHECK(code([&] { (void)extract(other, *mesh.find_region("top")); }) ==
          ErrorCode::topology_mismatch);
    CHECK(code([&] {
              (void)extract_faces(mesh, std::vector<Index>{0, 6});
          }) == ErrorCode::out_of_range);
}
