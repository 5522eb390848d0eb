#include "kernel/mesh/edit/append.h"

#include <ctime>

#include "kernel/mesh/edit/label_adder.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;

TEST_CASE("appending adds vertices and faces and keeps the ids of the first") {
    Mesh mesh = make_box();
    const Mesh first = mesh, second = test::tetrahedron();
    append(mesh, second);
    CHECK(mesh.vertex_count() == 12);
    CHECK(mesh.face_count() == 10);
    CHECK(mesh.topology().component_count() == 2);
    CHECK(mesh.position(3) == first.position(3));
    CHECK(mesh.position(8 + 3) == second.position(3));
    CHECK(mesh.topology().face(6)[1] == second.topology().face(0)[1] + 8);
    CHECK(volume(mesh) == doctest::Approx(1.0 + 1.0 / 6.0));
}

TEST_CASE("appending nothing, or to nothing, changes nothing") {
    Mesh mesh = test::decorated(test::patch());
    const std::uint64_t before = hash(mesh);
    append(mesh, Mesh());
    CHECK(hash(mesh) == before);
    Mesh empty;
    append(empty, mesh);
    CHECK(hash(empty) == before);
}

TEST_CASE("a mesh may be appended to itself") {
    Mesh mesh = test::decorated(test::patch());
    append(mesh, mesh);
    CHECK(mesh.vertex_count() == 12);
    CHECK(test::is_decorated(mesh));
    CHECK(mesh.find_region("half")->size() == 6);
}

TEST_CASE("attributes that only one side has are absent on the other") {
    Mesh mesh = test::decorated(test::patch());
    Mesh other = test::tetrahedron();
    other.attributes().add({"heat", Domain::vertex, 1, ScalarType::float32, {1, 2, 3, 4}});
    append(mesh, other);
    require_complete_attributes(mesh);
    CHECK(mesh.attributes().find("x")->values[5] == 2.0);
    CHECK(std::isnan(mesh.attributes().find("x")->values[6]));
    CHECK(std::isnan(mesh.attributes().find("heat")->values[0]));
    CHECK(mesh.attributes().find("heat")->values[9] == 4.0);
    CHECK(mesh.attributes().labels().at("group").of_face[3] == kNoIndex);
}

TEST_CASE("a side without colors is white, without texture coordinates has 0, 0, and is named") {
    Mesh mesh = test::tetrahedron(), other = test::tetrahedron();
    mesh.attributes().add({"color", Domain::face, 4, ScalarType::uint8, std::vector(16, 0.5)});
    other.attributes().add({"uv", Domain::corner, 2, ScalarType::float32, std::vector(24, 0.5)});
    const std::vector<std::string> warnings = append(mesh, other);
    const Attribute& color = *mesh.attributes().find("color");
    const Attribute& uv = *mesh.attributes().find("uv");
    for (Index f = 0; f < 8; ++f) {
        for (const double value : color.at(f)) CHECK(value == (f < 4 ? 0.5 : 1.0));
    }
    for (Index c = 0; c < 24; ++c) {
        for (const double value : uv.at(c)) CHECK(value == (c < 12 ? 0.0 : 0.5));
    }
    REQUIRE(warnings.size() == 2);
    CHECK(warnings[0].find("the appended mesh has no colors (\"color\")") == 0);
    CHECK(warnings[1].find("the mesh has no texture coordinates (\"uv\")") == 0);
    CHECK(append(mesh, Mesh()).empty());
}

TEST_CASE("the greater width counts, and colors without alpha are opaque") {
    FaceList faces;
    faces.add({0, 1, 2});
    Mesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, faces), other = mesh;
    mesh.attributes().add({"color", Domain::face, 3, ScalarType::uint8, {0.1, 0.2, 0.3}});
    mesh.attributes().add({"data", Domain::face, 1, ScalarType::int32, {7}});
    other.attributes().add({"color", Domain::face, 4, ScalarType::uint8, {0.4, 0.5, 0.6, 0.7}});
    other.attributes().add({"data", Domain::face, 2, ScalarType::int32, {8, 9}});
    append(mesh, other);
    CHECK(mesh.attributes().find("color")->values ==
          std::vector<double>{0.1, 0.2, 0.3, 1.0, 0.4, 0.5, 0.6, 0.7});
    CHECK(mesh.attributes().find("color")->type == ScalarType::uint8);
    CHECK(mesh.attributes().find("data")->values[0] == 7.0);
    CHECK(std::isnan(mesh.attributes().find("data")->values[1]));
}

TEST_CASE("attributes of different domains meet on corners") {
    FaceList faces;
    faces.add({0, 1, 2});
    Mesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, faces), other = mesh;
    mesh.attributes().add({"t", Domain::vertex, 1, ScalarType::float32, {1, 2, 3}});
    other.attributes().add({"t", Domain::face, 1, ScalarType::float32, {9}});
    append(mesh, other);
    const Attribute& t = *mesh.attributes().find("t");
    CHECK(t.domain == Domain::corner);
    CHECK(t.values == std::vector<double>{1, 2, 3, 9, 9, 9});
}

TEST_CASE("labels and regions of one name are united") {
    Mesh mesh = test::decorated(test::patch());
    Mesh other = test::decorated(test::tetrahedron());
    other.attributes().labels()["group"].names = {"odd", "new"};
    other.material_libraries() = {"stone.mtl", "wood.mtl"};
    append(mesh, other);
    const FaceLabels& groups = mesh.attributes().labels().at("group");
    CHECK(groups.names == std::vector<std::string>{"even", "odd", "new"});
    CHECK(groups.of_face == std::vector<Index>{0, 1, 0, 1, 2, 1, 2});
    CHECK(mesh.find_region("half")->vertices() == std::vector<Index>{0, 2, 4, 6, 8});
    CHECK(mesh.material_libraries() == std::vector<std::string>{"stone.mtl", "wood.mtl"});
}

TEST_CASE("appending makes a new topology and an older region is recognised") {
    Mesh mesh = make_box();
    const Region before = *mesh.find_region("top");
    append(mesh, make_box());
    CHECK(test::error_of([&] { mesh.set_region("x", before); }).code() ==
          ErrorCode::topology_mismatch);
}

TEST_CASE("appending many labels takes a time that grows with their number") {
    constexpr Index kCount = 100000;
    std::vector<Vec3> positions;
    FaceList faces;
    FaceLabels labels;
    for (Index f = 0; f < kCount; ++f) {
        for (const double y : {0.0, 1.0, 2.0}) positions.emplace_back(f, y, y * y);
        faces.add({3 * f, 3 * f + 1, 3 * f + 2});
        labels.names.push_back("a group of one face " + std::to_string(f));
        labels.of_face.push_back(f);
    }
    Mesh mesh(positions, faces), other = mesh;
    mesh.attributes().labels()["group"] = labels;
    for (Index f = 0; f < kCount; f += 2) labels.names[f] += " of the other";
    other.attributes().labels()["group"] = labels;
    const std::clock_t start = std::clock();
    append(mesh, other);
    // Looking for each name among those before took 20 times as long.
    CHECK(double(std::clock() - start) / CLOCKS_PER_SEC < 3.0);
    const FaceLabels& joined = mesh.attributes().labels().at("group");
    CHECK(joined.names.size() == kCount + kCount / 2);
    CHECK(joined.of_face[kCount] == kCount);
    CHECK(joined.of_face[kCount + 1] == 1);
    CHECK(joined.of_face[kCount + 2] == kCount + 1);
}

TEST_CASE("labels are added once, whoever adds them") {
    FaceLabels labels;
    LabelAdder adder(labels);
    CHECK(adder.add("a") == 0);
    CHECK(labels.add("b") == 1);
    labels.names.push_back("a");
    CHECK(adder.add("b") == 1);
    CHECK(adder.add("c") == 3);
    CHECK(adder.add("a") == 0);
    CHECK(labels.names == std::vector<std::string>{"a", "b", "a", "c"});
}
