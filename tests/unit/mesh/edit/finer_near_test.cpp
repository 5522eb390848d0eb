#include "kernel/mesh/edit/finer_near.h"

#include <algorithm>
#include <cmath>

#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

FinePlace place_at(const Mesh& mesh, const Vec3& point, double radius, double length) {
    const SurfacePoint on = SpatialTree(mesh).nearest(point);
    return {on.face, on.position, radius, length, length};
}

// The longest edge among the faces that touch the ball of a place.
double longest_near(const Mesh& mesh, FinePlace place) {
    place.face = SpatialTree(mesh).nearest(place.point).face;
    double longest = 0.0;
    for (const Index f : faces_touching(mesh, place)) {
        const auto face = mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            longest = std::max(
                longest,
                (mesh.position(face[(k + 1) % face.size()]) - mesh.position(face[k])).norm());
        }
    }
    return longest;
}

double smallest_angle_of(const Mesh& mesh) {
    double least = 9.0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Vec3 a = mesh.position(face[(k + 1) % face.size()]) - mesh.position(face[k]);
            const Vec3 b = mesh.position(face[(k + 2) % face.size()]) - mesh.position(face[k]);
            least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)));
        }
    }
    return least;
}

}  // namespace

TEST_CASE("finer near: edges in a ball become short, and the shape and all it holds stay") {
    for (const Mesh& mesh :
         {test::decorated(make_box({.size = {2, 2, 2}})),
          test::decorated(make_sphere({.segments = 6, .kind = SphereKind::triangles}))}) {
        for (const Vec3& point : {Vec3(1, 0.3, 0.2), Vec3(1, 1, 0.1), Vec3(1, 1, 1)}) {
            const FinePlace place = place_at(mesh, point, 0.2, 0.1);
            const std::optional<FinerMesh> finer = finer_near(mesh, {&place, 1}, {});
            REQUIRE(finer);
            CHECK(longest_near(finer->mesh, place) <= 0.1);
            CHECK(finer->mesh.topology().is_closed());
            CHECK(euler_characteristic(finer->mesh.topology()) == 2);
            CHECK(area(finer->mesh) == Approx(area(mesh)).epsilon(1e-12));
            CHECK(test::is_decorated(finer->mesh));
            for (Index v = 0; v < mesh.vertex_count(); ++v) {
                CHECK(finer->mesh.position(v) == mesh.position(v));
            }
            for (Index v = 0; v < finer->mesh.vertex_count(); ++v) {
                CHECK(finer->mesh.attributes().find("x")->values[v] ==
                      Approx(finer->mesh.position(v).x()));
            }
            CHECK(finer->mesh.face_count() < 1500);
        }
    }
}

TEST_CASE("finer near: no angle falls below half of the smallest, on needles neither") {
    FaceList faces;
    faces.add({0, 1, 2});
    faces.add({2, 1, 3});
    const Mesh needles({{0, 0, 0}, {10, 0, 0}, {0, 0.5, 0}, {10, 0.5, 0}}, std::move(faces));
    const FinePlace place = place_at(needles, {4, 0.2, 0}, 0.3, 0.15);
    const std::optional<FinerMesh> finer = finer_near(needles, {&place, 1}, {});
    REQUIRE(finer);
    CHECK(longest_near(finer->mesh, place) <= 0.15);
    CHECK(smallest_angle_of(finer->mesh) >= 0.5 * smallest_angle_of(needles) - 1e-12);
}

TEST_CASE("finer near: what is fine enough, and what lies on another sheet, stays") {
    const Mesh fine = make_sphere({.segments = 40, .kind = SphereKind::triangles});
    FinePlace enough = place_at(fine, {0, 1, 0}, 0.4, 0.4);
    CHECK(!finer_near(fine, {&enough, 1}, {}));
    enough.length = 0.01;
    CHECK(!finer_near(fine, {&enough, 1}, {}));
    const Mesh plate = make_box({.size = {4, 0.01, 4}});
    const FinePlace top = place_at(plate, {0.3, 0.005, 0.2}, 0.3, 0.1);
    const std::optional<FinerMesh> finer = finer_near(plate, {&top, 1}, {});
    REQUIRE(finer);
    for (Index v = plate.vertex_count(); v < finer->mesh.vertex_count(); ++v) {
        const Vec3& p = finer->mesh.position(v);
        const bool inner = std::max(std::abs(p.x()), std::abs(p.z())) < 1.9;
        if (inner) CHECK(p.y() > 0.0);
    }
}

TEST_CASE("finer near: a cancel ends it") {
    const Mesh box = make_box();
    const FinePlace place = place_at(box, {0.5, 0, 0}, 0.2, 0.02);
    Context context;
    context.cancel();
    CHECK(test::error_of([&] {
              finer_near(box, {&place, 1}, context);
          }).code() == ErrorCode::cancelled);
}
