#include "kernel/mesh/mesh.h"

#include <utility>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;

TEST_CASE("a new mesh is empty") {
    const Mesh mesh;
    CHECK(mesh.vertex_count() == 0);
    CHECK(mesh.face_count() == 0);
    CHECK(area(mesh) == 0.0);
}

TEST_CASE("positions that are not finite are refused with their vertices") {
    FaceList faces;
    faces.add({0, 1, 2});
    const Error error = test::error_of([&] {
        (void)Mesh({{0, 0, 0}, {1, test::kNaN, 0}, {0, 0, test::kInfinity}}, faces);
    });
    CHECK(error.code() == ErrorCode::not_finite);
    CHECK(error.elements().ids == std::vector<Index>{1, 2});
}

TEST_CASE("a change that is refused changes nothing") {
    Mesh mesh = test::tetrahedron();
    const std::uint64_t before = hash(mesh);
    CHECK(test::error_of([&] { mesh.set_position(4, Vec3::Zero()); }).code() ==
          ErrorCode::out_of_range);
    CHECK(test::error_of([&] { mesh.set_position(0, Vec3(0, test::kNaN, 0)); }).code() ==
          ErrorCode::not_finite);
    CHECK(test::error_of([&] { mesh.set_positions({}); }).code() == ErrorCode::invalid_argument);
    CHECK(hash(mesh) == before);
}

TEST_CASE("copies share the topology and own their positions") {
    const Mesh mesh = test::tetrahedron();
    Mesh copy = mesh;
    copy.set_position(0, Vec3(9, 9, 9));
    CHECK(mesh.position(0) == Vec3(0, 0, 0));
    CHECK(copy.shared_topology() == mesh.shared_topology());
}

TEST_CASE("every change of positions makes the revision grow") {
    Mesh mesh = test::tetrahedron();
    std::uint64_t last = mesh.revision();
    const auto grown = [&] { return mesh.revision() > std::exchange(last, mesh.revision()); };
    mesh.set_position(0, Vec3(1, 1, 1));
    CHECK(grown());
    mesh.edit_positions()[1] = Vec3(2, 2, 2);
    CHECK(grown());
    mesh.replace_by(make_box());
    CHECK(grown());
    CHECK(mesh.vertex_count() == 8);
    mesh = make_box();
    CHECK(grown());
    const Mesh other = test::tetrahedron();
    mesh = other;
    CHECK(grown());
}

TEST_CASE("named regions belong to the mesh's topology") {
    Mesh mesh = test::tetrahedron();
    mesh.set_region("top", Region(mesh.shared_topology(), {3}));
    REQUIRE(mesh.find_region("top"));
    CHECK(mesh.find_region("top")->contains(3));
    CHECK(!mesh.find_region("bottom"));
    CHECK(&mesh.region("top") == mesh.find_region("top"));
    const Mesh other = test::tetrahedron();
    CHECK(test::error_of([&] {
              mesh.set_region("x", Region::all(other.shared_topology()));
          }).code() == ErrorCode::topology_mismatch);
    CHECK(test::error_of([&] {
              mesh.set_region("", Region::all(mesh.shared_topology()));
          }).code() == ErrorCode::invalid_argument);
    CHECK(mesh.remove_region("top"));
    CHECK(!mesh.remove_region("top"));
}

TEST_CASE("a region that a mesh does not have is out of range, and near names are told") {
    Mesh mesh = test::tetrahedron();
    const Error none = test::error_of([&] { (void)mesh.region("tip"); });
    CHECK(none.code() == ErrorCode::out_of_range);
    CHECK(std::string(none.message()) == "the mesh has no region 'tip', nor any other");
    mesh.set_region("top", Region(mesh.shared_topology(), {3}));
    mesh.set_region("base", Region(mesh.shared_topology(), {0, 1, 2}));
    CHECK(std::string(test::error_of([&] { (void)mesh.region("bsae"); }).message()) ==
          "the mesh has no region 'bsae', did you mean 'base'?");
}

TEST_CASE("attributes are found by name and replaced by name") {
    Mesh mesh = test::tetrahedron();
    mesh.attributes().add({"heat", Domain::vertex, 1, ScalarType::float32, {1, 2, 3, 4}});
    mesh.attributes().add({"heat", Domain::vertex, 1, ScalarType::float32, {5, 6, 7, 8}});
    CHECK(mesh.attributes().all().size() == 1);
    CHECK(mesh.attributes().find("heat")->at(2)[0] == 7);
    CHECK(mesh.attributes().remove("heat"));
    CHECK(!mesh.attributes().find("heat"));
    const auto nameless = [&] {
        mesh.attributes().add({"", Domain::vertex, 1, ScalarType::float32, {}});
    };
    CHECK(test::error_of(nameless).code() == ErrorCode::invalid_argument);
}

TEST_CASE("an attribute without a value for each element is found out") {
    Mesh mesh = test::tetrahedron();
    mesh.attributes().add({"heat", Domain::vertex, 2, ScalarType::float32, {1, 2, 3}});
    const Error error = test::error_of([&] { require_complete_attributes(mesh); });
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(error.message().find("heat") != std::string::npos);
}
