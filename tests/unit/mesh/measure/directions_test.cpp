#include "kernel/mesh/measure/directions.h"

#include "kernel/mesh/derive.h"
#include "kernel/mesh/edit/smooth.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/edit/transform.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// A patch whose vertices have a normal, a tangent and a morph target.
Mesh directed() {
    Mesh mesh = test::patch();
    Attribute normal{"normal", Domain::vertex, 3, ScalarType::float32, {}};
    Attribute tangent{"tangent", Domain::vertex, 4, ScalarType::float32, {}};
    Attribute morph{"morph.1.position", Domain::vertex, 3, ScalarType::float32, {}};
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        normal.values.insert(normal.values.end(), {0, 0, 1});
        tangent.values.insert(tangent.values.end(), {1, 0, 0, 1});
        morph.values.insert(morph.values.end(), {0, 2, 0});
    }
    mesh.attributes().add(normal);
    mesh.attributes().add(tangent);
    mesh.attributes().add(morph);
    return mesh;
}

Vec3 value(const Mesh& mesh, const char* name, Index v = 0) {
    const auto values = mesh.attributes().find(name)->at(v);
    return {values[0], values[1], values[2]};
}

}  // namespace

TEST_CASE("names and widths tell what an attribute means") {
    const auto role = [](const char* name, Index width) {
        return role_of({name, Domain::vertex, width, ScalarType::float32, {}});
    };
    CHECK(role("uv", 2) == AttributeRole::texture_coordinates);
    CHECK(role("uv12", 2) == AttributeRole::texture_coordinates);
    CHECK(role("uv", 3) == AttributeRole::value);
    CHECK(role("uvula", 2) == AttributeRole::value);
    CHECK(role("color2", 4) == AttributeRole::color);
    CHECK(role("joints", 8) == AttributeRole::joints);
    CHECK(role("joints", 3) == AttributeRole::value);
    CHECK(role("morph.2.tangent", 3) == AttributeRole::morph_tangent);
    CHECK(role("morph.2.size", 3) == AttributeRole::value);
}

TEST_CASE("directions turn and scale with a transform, each in its way") {
    Mesh mesh = directed();
    const Mat3 turn = Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()).toRotationMatrix();
    transform(mesh, {3.0 * turn, Vec3(5, 5, 5)});
    CHECK((value(mesh, "normal") - Vec3(0, -1, 0)).norm() < 1e-12);
    CHECK((value(mesh, "tangent") - Vec3(1, 0, 0)).norm() < 1e-12);
    CHECK((value(mesh, "morph.1.position") - Vec3(0, 0, 6)).norm() < 1e-12);
    CHECK(mesh.attributes().find("tangent")->at(0)[3] == 1.0);
}

TEST_CASE("a mirror turns the handedness of tangents") {
    Mesh mesh = directed();
    transform(mesh, {Vec3(-1, 1, 1).asDiagonal().toDenseMatrix(), Vec3::Zero()});
    CHECK(mesh.attributes().find("tangent")->at(0)[3] == -1.0);
    CHECK((value(mesh, "tangent") - Vec3(-1, 0, 0)).norm() < 1e-12);
}

TEST_CASE("tangents between others are unit, with the handedness of one of them") {
    const Mesh fine = subdivide(directed(), {});
    for (Index v = 0; v < fine.vertex_count(); ++v) {
        CHECK(value(fine, "tangent", v).norm() == Approx(1.0));
        CHECK(fine.attributes().find("tangent")->at(v)[3] == 1.0);
        CHECK((value(fine, "morph.1.position", v) - Vec3(0, 2, 0)).norm() < 1e-12);
    }
}

TEST_CASE("a vertex between two others is moved by the joints of both") {
    Mesh mesh = test::patch();
    Attribute joints{"joints", Domain::vertex, 4, ScalarType::uint8, {}};
    Attribute weights{"weights", Domain::vertex, 4, ScalarType::float32, {}};
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        joints.values.insert(joints.values.end(), {double(v), 10, 0, 0});
        weights.values.insert(weights.values.end(), {0.75, 0.25, 0, 0});
    }
    mesh.attributes().add(joints);
    mesh.attributes().add(weights);
    ElementMap vertices;
    vertices.add_mean(std::array{1, 4});
    vertices.add_copy(2);
    vertices.add_mean(std::array{3, 3});
    FaceList face;
    face.add({0, 1, 2});
    const Mesh part = derive(
        mesh, blend_positions(mesh, vertices), std::move(face),
        {vertices, ElementMap::copies(std::array{0, 1, 2}), ElementMap::copies(std::array{0})});
    const auto moved_by = part.attributes().find("joints")->at(0);
    const auto how_much = part.attributes().find("weights")->at(0);
    CHECK(std::vector<double>(moved_by.begin(), moved_by.end()) ==
          std::vector<double>{1, 4, 10, 0});
    CHECK(how_much[0] == Approx(0.375));
    CHECK(how_much[2] == Approx(0.25));
    CHECK(part.attributes().find("weights")->at(2)[0] == Approx(0.75));
}
