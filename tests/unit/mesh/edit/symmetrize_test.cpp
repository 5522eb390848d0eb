#include "kernel/mesh/edit/symmetrize.h"

#include <utility>

#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

void check_mirrored(const Symmetrized& made, const SymmetrizeOptions& options) {
    const Vec3 n = options.normal.normalized();
    REQUIRE(made.mirror.size() == at(made.mesh.vertex_count()));
    for (Index v = 0; v < made.mesh.vertex_count(); ++v) {
        const Vec3& p = made.mesh.position(v);
        const Vec3 image = p - 2.0 * n.dot(p - options.point) * n;
        CHECK(made.mirror[at(made.mirror[at(v)])] == v);
        CHECK((made.mesh.position(made.mirror[at(v)]) - image).norm() < 1e-12);
    }
}

}  // namespace

TEST_CASE("half of a mesh and its image are one closed symmetric mesh") {
    test::Random random(3);
    const Mesh cactus = make_cactus({.vertices = 2000});
    for (int i = 0; i < 60; ++i) {
        const SymmetrizeOptions options{
            .point = 0.1 * random.direction(),
            .normal = Vec3(3.0, random.uniform(-0.2, 0.2), random.uniform(-0.5, 0.5))};
        const Symmetrized made = symmetrize(cactus, options);
        check_mirrored(made, options);
        CHECK(made.mesh.topology().is_closed() == cactus.topology().is_closed());
        CHECK(volume(made.mesh) > 0.0);
    }
}

TEST_CASE("a half model is welded where it reaches the plane") {
    const Mesh torus = make_torus({.segments = 24, .tube_segments = 12});
    const CutPlane plane{.point = Vec3(0, 0, 0), .normal = Vec3(1, 0, 0)};
    Mesh half = cut(torus, plane, {.loops = CutLoops::all}).kept.mesh;
    std::vector<Vec3> positions(half.positions().begin(), half.positions().end());
    for (Index v = 0; v < half.vertex_count(); v += 2) positions[at(v)].x() += 1e-7;
    half.set_positions(positions);
    const Symmetrized made = symmetrize(half, {});
    check_mirrored(made, {});
    CHECK(made.mesh.topology().is_closed());
    CHECK(euler_characteristic(made.mesh.topology()) == 0);
    CHECK(volume(made.mesh) == Approx(2.0 * volume(half)).epsilon(1e-5));
    for (Index v = 0; v < half.vertex_count(); ++v) {
        CHECK((made.mesh.position(v) - half.position(v)).norm() < 1e-6);
    }
}

TEST_CASE("an open surface with an inner edge on the plane is refused") {
    FaceList faces;
    faces.add({0, 1, 2});
    faces.add({1, 0, 3});
    const Mesh folded({{0, 0, 0}, {0, 1, 0}, {1, 0, 1}, {1, 0, -1}}, std::move(faces));
    try {
        symmetrize(folded, {});
        FAIL("it was mirrored");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::boundary_conflict);
    }
}

TEST_CASE("attributes of the half are on both sides, and directions are mirrored") {
    Mesh mesh = test::decorated(make_box({.segments = {4, 2, 2}}));
    Attribute morph{"morph.1.position", Domain::vertex, 3, ScalarType::float32, {}};
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        for (const double x : {1.0, 2.0, 3.0}) morph.values.push_back(x);
    }
    mesh.attributes().add(std::move(morph));
    const Symmetrized made = symmetrize(mesh, {});
    const Attribute& offsets = *made.mesh.attributes().find("morph.1.position");
    CHECK(made.mesh.attributes().labels().contains("group"));
    for (Index v = 0; v < made.mesh.vertex_count(); ++v) {
        const double x = made.mesh.position(v).x();
        const double expected = x > 1e-9 ? 1.0 : x < -1e-9 ? -1.0 : 0.0;
        CHECK(offsets.at(v)[0] == Approx(expected));
        CHECK(offsets.at(v)[1] == 2.0);
    }
}

TEST_CASE("symmetry refuses planes that leave nothing") {
    const Mesh box = make_box();
    CHECK_THROWS_AS(symmetrize(box, {.point = Vec3(9, 0, 0)}), Error);
    CHECK_THROWS_AS(symmetrize(box, {.point = Vec3(-9, 0, 0)}), Error);
    CHECK_THROWS_AS(symmetrize(box, {.normal = Vec3::Zero()}), Error);
    CHECK_THROWS_AS(symmetrize(box, {.point = Vec3(test::kNaN, 0, 0)}), Error);
    CHECK_THROWS_AS(symmetrize(box, {.weld = -1.0}), Error);
    CHECK_THROWS_AS(symmetrize(Mesh(), {}), Error);
}

TEST_CASE("a half model beside the plane is refused, and welded if the tolerance reaches it") {
    const Mesh torus = make_torus({.segments = 24, .tube_segments = 12});
    const CutPlane plane{.point = Vec3(0.1, 0, 0), .normal = Vec3(1, 0, 0)};
    const Mesh half = cut(torus, plane, {.loops = CutLoops::all}).kept.mesh;
    CHECK_THROWS_AS(symmetrize(half, {}), Error);
    CHECK(symmetrize(half, {.weld = 0.11}).mesh.topology().is_closed());
}
