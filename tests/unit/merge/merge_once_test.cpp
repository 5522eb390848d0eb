#include "kernel/merge/merge_once.h"

#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

namespace lissom::test {
namespace {

Mesh cap(double height, const Vec3& normal) {
    const Mesh ball = make_sphere({.segments = 12});
    return cut(ball, CutPlane{Vec3(0.0, height, 0.0), normal}).kept.mesh;
}

Mesh open_tube() {
    return make_cylinder({.radius = 1.0, .height = 4.0, .segments = 24, .rings = 8, .caps = false});
}

}  // namespace

TEST_CASE("two meshes are merged in one line, with joins or at their nearest boundaries") {
    const Mesh head = cap(0.0, Vec3::UnitY()), body = cap(0.1, -Vec3::UnitY());
    const MergeResult out = merge(head, body, {{boundary(head), boundary(body)}});
    CHECK(out.mesh.topology().is_closed());
    CHECK(hash(merge(head, body).mesh) == hash(out.mesh));
    Merger merger(head, body, {{boundary(head), boundary(body)}});
    CHECK(hash(merger.solve().mesh) == hash(out.mesh));
}

TEST_CASE("the nearest boundaries are found on parts with several") {
    const Mesh tube = open_tube();
    for (const double side : {-1.0, 1.0}) {
        Mesh half = cap(0.0, side * Vec3::UnitY());
        transform(half, translation(Vec3(0.0, side * 2.2, 0.0)));
        const Join join = nearest_join(half, tube);
        CHECK(side * join.target.points(tube)[0].y() > 0.0);
        CHECK(hash(merge(half, tube).mesh) ==
              hash(merge(half, tube, {{boundary(half), join.target}}).mesh));
    }
    const Join within = nearest_join(tube, tube);
    CHECK(within.source.points(tube)[0].y() * within.target.points(tube)[0].y() < 0.0);
}

TEST_CASE("a mesh without a boundary, or with several, has no one boundary") {
    const Mesh ball = make_sphere({}), half = cap(0.0, Vec3::UnitY());
    CHECK(boundary(half).vertices().size() == boundaries(half)[0].vertices().size());
    CHECK(error_of([&] { (void)boundary(ball); }).code() == ErrorCode::not_a_boundary);
    CHECK(error_of([&] { (void)boundary(open_tube()); }).code() == ErrorCode::boundary_conflict);
    CHECK(error_of([&] { (void)merge(ball, half); }).code() == ErrorCode::not_a_boundary);
    CHECK(error_of([&] { (void)nearest_join(half, half); }).code() == ErrorCode::not_a_boundary);
}

}  // namespace lissom::test
