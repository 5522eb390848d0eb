#include "kernel/mesh/derive.h"

#include <array>

#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// A triangle whose vertices, corners and face all come from the patch in the way a test says.
Mesh triangle_from(const Mesh& source, const ElementMap& vertices, const ElementMap& corners,
                   const ElementMap& faces) {
    FaceList list;
    list.add({0, 1, 2});
    return derive(source, blend_positions(source, vertices), std::move(list),
                  {vertices, corners, faces});
}

Mesh mixed(const Mesh& source) {
    ElementMap vertices;
    vertices.add_copy(1);
    vertices.add_mean(std::array{0, 4});
    vertices.add_new();
    ElementMap corners;
    corners.add_copy(2);
    corners.add_mean(std::array{3, 4});
    corners.add_new();
    ElementMap faces;
    faces.add_blend(std::array{ElementMap::Source{0, 1.0}, ElementMap::Source{1, 3.0}});
    return triangle_from(source, vertices, corners, faces);
}

}  // namespace

TEST_CASE("weights sum to 1 and the heaviest source leads, the first of equals") {
    ElementMap map;
    map.add_blend(std::array{ElementMap::Source{4, 1.0}, ElementMap::Source{2, 3.0}});
    map.add_mean(std::array{7, 5});
    map.add_new();
    CHECK(map.size() == 3);
    CHECK(map[0][1].weight == Approx(0.75));
    CHECK(map.main_source(0) == 2);
    CHECK(map.main_source(1) == 7);
    CHECK(map.main_source(2) == kNoIndex);
    CHECK(map[2].empty());
}

TEST_CASE("the identity copies a mesh with all it holds") {
    const Mesh mesh = test::decorated(test::patch());
    const MeshMap map{ElementMap::identity(6), ElementMap::identity(10), ElementMap::identity(3)};
    const Mesh copy = derive(mesh, {mesh.positions().begin(), mesh.positions().end()},
                             mesh.topology().faces(), map);
    CHECK(hash(copy) == hash(mesh));
}

TEST_CASE("attributes are blended, and elements from nowhere have none") {
    const Mesh mesh = mixed(test::decorated(test::patch()));
    CHECK(test::is_decorated(mesh));
    const Attribute& x = *mesh.attributes().find("x");
    CHECK(x.values[0] == 1.0);
    CHECK(x.values[1] == 1.0);
    CHECK(std::isnan(x.values[2]));
    const Attribute& uv = *mesh.attributes().find("uv");
    CHECK(uv.at(0)[0] == 2.0);
    CHECK(uv.at(1)[0] == Approx(100.5));
    CHECK(std::isnan(uv.at(2)[1]));
    CHECK(mesh.position(1) == Vec3(1, 0, 0));
}

TEST_CASE("labels and whole numbers come from the heaviest source") {
    const Mesh mesh = mixed(test::decorated(test::patch()));
    CHECK(mesh.attributes().find("part")->values[0] == 10.0);
    CHECK(mesh.attributes().labels().at("group").of_face[0] == 1);
}

TEST_CASE("a vertex is in a region when all of its sources are") {
    Mesh patch = test::decorated(test::patch());
    patch.set_region("half", Region(patch.shared_topology(), {0, 4}));
    CHECK(mixed(patch).find_region("half")->vertices() == std::vector<Index>{1});
    patch.set_region("half", Region(patch.shared_topology(), {0, 1}));
    CHECK(mixed(patch).find_region("half")->vertices() == std::vector<Index>{0});
}

TEST_CASE("a source without a value does not count") {
    Mesh patch = test::decorated(test::patch());
    patch.attributes().find("x")->values[0] = test::kNaN;
    CHECK(mixed(patch).attributes().find("x")->values[1] == 2.0);
    patch.attributes().find("x")->values[4] = test::kNaN;
    CHECK(std::isnan(mixed(patch).attributes().find("x")->values[1]));
}

TEST_CASE("blended normals are unit and blended byte colors are means") {
    Mesh patch = test::patch();
    patch.attributes().add({"normal",
                            Domain::vertex,
                            3,
                            ScalarType::float32,
                            {1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 0, 1}});
    patch.attributes().add({"color",
                            Domain::vertex,
                            3,
                            ScalarType::uint8,
                            {0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0.5, 0, 0, 0}});
    const Mesh mesh = mixed(patch);
    const auto n = mesh.attributes().find("normal")->at(1);
    CHECK(n[0] == Approx(std::sqrt(0.5)));
    CHECK(n[1] == Approx(std::sqrt(0.5)));
    CHECK(mesh.attributes().find("color")->at(1)[2] == Approx(0.25));
}

TEST_CASE("maps of the wrong size are refused") {
    const Mesh mesh = test::patch();
    const auto run = [&](Index vertices, Index corners, Index faces) {
        (void)derive(mesh, {mesh.positions().begin(), mesh.positions().end()},
                     mesh.topology().faces(),
                     {ElementMap::identity(vertices), ElementMap::identity(corners),
                      ElementMap::identity(faces)});
    };
    CHECK_NOTHROW(run(6, 10, 3));
    CHECK(test::error_of([&] { run(5, 10, 3); }).code() == ErrorCode::invalid_argument);
    CHECK(test::error_of([&] { run(6, 9, 3); }).code() == ErrorCode::invalid_argument);
    CHECK(test::error_of([&] { run(6, 10, 2); }).code() == ErrorCode::invalid_argument);
}
