#include "kernel/mesh/edit/transform.h"

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

Mesh with_normals(Mesh mesh) {
    Attribute normals{"normal", Domain::vertex, 3, ScalarType::float32, {}};
    for (const Vec3& n : vertex_normals(mesh)) {
        normals.values.insert(normals.values.end(), {n.x(), n.y(), n.z()});
    }
    mesh.attributes().add(std::move(normals));
    return mesh;
}

double worst_normal(const Mesh& mesh) {
    double worst = 1.0;
    const std::vector<Vec3> expected = vertex_normals(mesh);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const auto n = mesh.attributes().find("normal")->at(v);
        worst = std::min(worst, Vec3(n[0], n[1], n[2]).dot(expected[v]));
    }
    return worst;
}

}  // namespace

TEST_CASE("a transform moves vertices in place and keeps the topology") {
    const Mesh sphere = make_sphere({.segments = 6, .kind = SphereKind::triangles});
    Mesh mesh = sphere;
    const auto topology = mesh.shared_topology();
    transform(mesh, scaling(Vec3(2, 3, 4), Vec3::Zero()));
    CHECK(mesh.shared_topology() == topology);
    CHECK(volume(mesh) == Approx(24.0 * volume(sphere)));
}

TEST_CASE("normals stay those of the surface under any affine map") {
    const Mesh fine = with_normals(make_sphere({.segments = 24}));
    Affine shear;
    shear.linear << 1, 0.7, 0, 0, 1, -0.3, 0.2, 0, 2;
    for (const Affine& map :
         {shear, scaling(Vec3(1, 5, 1), Vec3(1, 1, 1)), scaling(Vec3(-1, 1, 2), Vec3::Zero()),
          scaling(Vec3::Constant(1e-60), Vec3::Zero())}) {
        Mesh mesh = fine;
        transform(mesh, map);
        CHECK(worst_normal(mesh) > 0.999);
    }
}

TEST_CASE("a mirror image still faces outward and keeps what the mesh holds") {
    Mesh mesh = test::decorated(make_box({.size = {1, 2, 3}}));
    const auto before = mesh.shared_topology();
    transform(mesh, scaling(Vec3(-1, 1, 1), Vec3::Zero()));
    CHECK(volume(mesh) == Approx(6.0));
    CHECK(mesh.shared_topology() != before);
    CHECK(test::is_decorated(mesh));
    CHECK(mesh.find_region("left")->vertices().size() == 4);
    CHECK(center(mesh, *mesh.find_region("left")).x() == Approx(0.5));
}

TEST_CASE("maps that flatten or are not finite are refused and change nothing") {
    Mesh mesh = make_box();
    const std::uint64_t before = hash(mesh);
    const auto code = [&](const Affine& map) {
        return test::error_of([&] { transform(mesh, map); }).code();
    };
    Affine nan;
    nan.linear(1, 2) = test::kNaN;
    CHECK(code(nan) == ErrorCode::singular_transform);
    CHECK(code(scaling(Vec3(1, 0, 1), Vec3::Zero())) == ErrorCode::singular_transform);
    CHECK(code(scaling(Vec3::Zero(), Vec3::Zero())) == ErrorCode::singular_transform);
    CHECK(code(translation(Vec3(test::kInfinity, 0, 0))) == ErrorCode::singular_transform);
    Mesh large = make_box({.size = Vec3::Constant(1e200)});
    const auto overflow = [&] { transform(large, scaling(Vec3::Constant(1e200), Vec3::Zero())); };
    CHECK(test::error_of(overflow).code() == ErrorCode::not_finite);
    CHECK(hash(mesh) == before);
}

TEST_CASE("flipping twice gives the mesh back to the bit") {
    Mesh mesh = with_normals(test::decorated(make_torus()));
    const std::uint64_t before = hash(mesh);
    flip(mesh);
    CHECK(volume(mesh) < 0.0);
    CHECK(worst_normal(mesh) > 0.99);
    CHECK(hash(mesh) != before);
    flip(mesh);
    CHECK(hash(mesh) == before);
}

TEST_CASE("a flipped face starts at its first vertex and its corners go with it") {
    Mesh mesh = test::decorated(test::patch());
    flip(mesh);
    const auto face = mesh.topology().face(2);
    CHECK(std::vector<Index>(face.begin(), face.end()) == std::vector<Index>{2, 5, 4, 1});
    const Attribute& uv = *mesh.attributes().find("uv");
    CHECK(uv.at(6)[0] == 200.0);
    CHECK(uv.at(7)[0] == 203.0);
}
