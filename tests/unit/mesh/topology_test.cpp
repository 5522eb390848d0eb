#include "kernel/mesh/topology.h"

#include <algorithm>

#include "kernel/mesh/edges.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;

namespace {

FaceList faces_of(std::initializer_list<std::vector<Index>> list) {
    FaceList faces;
    for (const auto& face : list) faces.add(face);
    return faces;
}

Error refusal(Index vertices, FaceList faces) {
    return test::error_of([&] { (void)Topology::create(vertices, std::move(faces)); });
}

std::vector<Index> ring(const Topology& t, Index v) {
    return {t.neighbors(v).begin(), t.neighbors(v).end()};
}

std::vector<Index> fan(const Topology& t, Index v) {
    return {t.faces_around(v).begin(), t.faces_around(v).end()};
}

}  // namespace

TEST_CASE("an index out of range is refused with its face") {
    const Error error = refusal(3, faces_of({{0, 1, 2}, {0, 2, 3}, {2, 1, -1}}));
    CHECK(error.code() == ErrorCode::face_index);
    CHECK(error.elements().kind == ElementKind::face);
    CHECK(error.elements().ids == std::vector<Index>{1, 2});
}

TEST_CASE("a face of two vertices is refused with its id") {
    const Error error = refusal(4, faces_of({{0, 1, 2}, {2, 1}, {3}}));
    CHECK(error.code() == ErrorCode::face_too_small);
    CHECK(error.elements().ids == std::vector<Index>{1, 2});
}

TEST_CASE("a repeated vertex is refused with its face") {
    const Error error = refusal(5, faces_of({{0, 1, 2}, {0, 2, 3, 2}, {0, 3, 4}}));
    CHECK(error.code() == ErrorCode::repeated_vertex);
    CHECK(error.elements().ids == std::vector<Index>{1});
}

TEST_CASE("duplicate faces are refused, whichever vertex they start from") {
    const Error error = refusal(4, faces_of({{0, 1, 2}, {1, 2, 0}, {0, 2, 3}, {2, 0, 1}}));
    CHECK(error.code() == ErrorCode::duplicate_face);
    CHECK(error.elements().count == 2);
    CHECK(error.elements().ids == std::vector<Index>{1, 3});
}

TEST_CASE("an edge of three faces is refused with its vertices") {
    const Error error = refusal(5, faces_of({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
    CHECK(error.code() == ErrorCode::nonmanifold_edge);
    CHECK(error.elements().kind == ElementKind::edge);
    CHECK(error.elements().count == 1);
    CHECK(error.elements().ids == std::vector<Index>{0, 1});
}

TEST_CASE("a neighbour that is inside out is refused with the edge") {
    const Error error = refusal(4, faces_of({{0, 1, 2}, {0, 1, 3}}));
    CHECK(error.code() == ErrorCode::inconsistent_orientation);
    CHECK(error.elements().ids == std::vector<Index>{0, 1});
}

TEST_CASE("a bow-tie is refused with its middle") {
    const Error error = refusal(5, faces_of({{0, 1, 2}, {2, 3, 4}}));
    CHECK(error.code() == ErrorCode::nonmanifold_vertex);
    CHECK(error.elements().kind == ElementKind::vertex);
    CHECK(error.elements().ids == std::vector<Index>{2});
}

TEST_CASE("two closed surfaces that touch at a vertex are a bow-tie") {
    FaceList faces = faces_of({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    const FaceList first = faces;
    for (Index f = 0; f < 4; ++f) {
        std::vector<Index> face(first[f].begin(), first[f].end());
        for (Index& v : face) v = v == 0 ? 0 : v + 3;
        faces.add(face);
    }
    const Error error = refusal(7, std::move(faces));
    CHECK(error.code() == ErrorCode::nonmanifold_vertex);
    CHECK(error.elements().ids == std::vector<Index>{0});
}

TEST_CASE("messages say what to do and count from the elements") {
    const Error error = refusal(5, faces_of({{0, 1, 2}, {2, 3, 4}}));
    CHECK(error.message().find("vertex 2") != std::string::npos);
    CHECK(error.message().find(';') != std::string::npos);
}

TEST_CASE("a cancelled context creates nothing") {
    const Context context;
    context.cancel();
    const auto create = [&] { (void)Topology::create(3, faces_of({{0, 1, 2}}), context); };
    CHECK(test::error_of(create).code() == ErrorCode::cancelled);
}

TEST_CASE("a topology without faces has isolated vertices only") {
    const auto topology = Topology::create(3, {});
    CHECK(topology->is_closed());
    CHECK(topology->component_count() == 3);
    CHECK(topology->is_isolated(1));
    CHECK(!topology->is_boundary(1));
}

TEST_CASE("rings run counter-clockwise and start at the boundary") {
    const auto topology =
        Topology::create(6, faces_of({{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {4, 5, 1}}));
    // Around vertex 0 the faces are closed; around vertex 1 the ring is cut at the boundary.
    CHECK(topology->valence(0) == 4);
    CHECK(!topology->is_boundary(0));
    CHECK(ring(*topology, 1) == std::vector<Index>{2, 0, 4, 5});
    CHECK(fan(*topology, 1) == std::vector<Index>{0, 3, 4});
    CHECK(topology->is_boundary(1));
}

TEST_CASE("the i-th face around a vertex lies between its neighbours i and i + 1") {
    const Mesh mesh = make_cylinder({.caps = false});
    const Topology& t = mesh.topology();
    for (Index v = 0; v < t.vertex_count(); ++v) {
        const auto neighbors = t.neighbors(v);
        for (std::size_t i = 0; i < t.faces_around(v).size(); ++i) {
            const auto face = t.face(t.faces_around(v)[i]);
            const auto has = [&](Index u) {
                return std::find(face.begin(), face.end(), u) != face.end();
            };
            CHECK(has(v));
            CHECK(has(neighbors[i]));
            CHECK(has(neighbors[(i + 1) % neighbors.size()]));
        }
    }
}

TEST_CASE("boundary loops run along their faces and start at the smallest vertex") {
    const Mesh mesh = test::patch();
    const auto& loops = mesh.topology().boundary_loops();
    REQUIRE(loops.size() == 1);
    CHECK(loops[0] == std::vector<Index>{0, 1, 4, 5, 2, 3});
    CHECK(mesh.topology().boundary_edge_count() == 6);
    CHECK(!mesh.topology().is_closed());
}

TEST_CASE("edges run in the direction of their first face") {
    const Mesh mesh = test::patch();
    const Topology& t = mesh.topology();
    CHECK(t.edge_count() == 8);
    CHECK(t.edge(0) == std::pair<Index, Index>{0, 1});
    CHECK(t.edge(2) == std::pair<Index, Index>{2, 0});
    CHECK(t.corner_count() == 10);
    CHECK(t.first_corner(2) == 6);
    CHECK(!t.is_triangle_mesh());
}

TEST_CASE("components are numbered by their smallest vertex") {
    const auto topology = Topology::create(8, faces_of({{5, 6, 7}, {0, 2, 3}}));
    CHECK(topology->components() == std::vector<Index>{0, 1, 0, 0, 2, 3, 3, 3});
    CHECK(topology->component_count() == 4);
}

TEST_CASE("every generated and real mesh has one boundary edge out of and into a boundary vertex") {
    std::vector<Mesh> meshes{make_grid(), make_cylinder({.caps = false}), test::patch()};
    if (auto lion = test::load_off("lion.off")) meshes.push_back(std::move(*lion));
    for (const Mesh& mesh : meshes) {
        Index count = 0;
        for (const auto& loop : mesh.topology().boundary_loops()) {
            count += static_cast<Index>(loop.size());
            for (const Index v : loop) CHECK(mesh.topology().is_boundary(v));
        }
        CHECK(count == mesh.topology().boundary_edge_count());
    }
}

TEST_CASE("edges are found by their vertices, and know their faces") {
    const Mesh mesh = test::patch();
    const Topology& topology = mesh.topology();
    for (Index e = 0; e < topology.edge_count(); ++e) {
        const auto [a, b] = topology.edge(e);
        CHECK(find_edge(topology, a, b) == e);
        CHECK(find_edge(topology, b, a) == e);
        const auto [left, right] = faces_at_edge(topology, e);
        for (const Index f : {left, right}) {
            if (f == kNoIndex) continue;
            const auto face = topology.face(f);
            CHECK(std::find(face.begin(), face.end(), a) != face.end());
            CHECK(std::find(face.begin(), face.end(), b) != face.end());
        }
        CHECK(left != kNoIndex);
    }
    CHECK(find_edge(topology, 1, 3) == kNoIndex);
    CHECK(find_edge(topology, 0, 5) == kNoIndex);
    CHECK(faces_at_edge(topology, find_edge(topology, 0, 2)) == std::pair<Index, Index>(0, 1));
    CHECK(faces_at_edge(topology, find_edge(topology, 0, 1)).second == kNoIndex);
}
