// Sewing two meshes along the target's loop.

#include "kernel/merge/sew.h"

#include <algorithm>
#include <cstring>

#include "kernel/merge/seam_quality.h"
#include "tests/unit/merge/seam_scenes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

constexpr double kDegree = kPi / 180.0;

bool same_bits(const Vec3& a, const Vec3& b) {
    return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

// Sphere of quads, cut at a height along its edges.
SewScene cut_sphere() {
    SewScene scene =
        cut_in_two(make_sphere({.segments = 12}), [](const Vec3& p) { return p.y() < 0.3; });
    add_join(scene, 0, 0, Vec3(1.0, 0.2, 0.3));
    return scene;
}

double degrees(double radians) {
    return radians / kDegree;
}

}  // namespace

TEST_CASE("sew: parts of a sphere cut along its edges become the same sphere again") {
    const Mesh whole = make_sphere({.segments = 12});
    const SewScene scene = cut_sphere();
    const Sewn sewn = sew(scene.target, scene.source, scene.joins, {.smooth = 0, .flip = false});
    CHECK(sewn.mesh.topology().is_closed());
    CHECK(sewn.mesh.vertex_count() == whole.vertex_count());
    CHECK(sewn.mesh.face_count() == whole.face_count());
    CHECK(volume(sewn.mesh) == doctest::Approx(volume(whole)).epsilon(1e-12));
    CHECK(sewn.report.inserted_into_target == 0);
    CHECK(sewn.report.inserted_into_source == 0);
}

TEST_CASE("sew: tubes with loops of very different counts give one manifold tube") {
    for (const auto& [n, m] : {std::pair<Index, Index>{3, 200},
                               {200, 3},
                               {3, 3},
                               {17, 40},
                               {24, 24},
                               {40, 17},
                               {5, 6}}) {
        CAPTURE(n);
        CAPTURE(m);
        const SewScene scene = two_tubes(n, m);
        const Sewn sewn = sew(scene.target, scene.source, scene.joins);
        CHECK(sewn.mesh.topology().boundary_loops().size() == 2);
        CHECK(euler_characteristic(sewn.mesh.topology()) == 0);
        CHECK(sewn.mesh.topology().component_count() == 1);
        CHECK(sewn.report.after.vertices == static_cast<Index>(sewn.seams[0].size()));
        MESSAGE(n << " x " << m << ": before " << degrees(sewn.report.before.greatest_dihedral)
                  << " / " << degrees(sewn.report.before.low_angle) << ", after "
                  << degrees(sewn.report.after.greatest_dihedral) << " / "
                  << degrees(sewn.report.after.low_angle) << " flips " << sewn.report.flipped
                  << " snapped " << sewn.report.snapped);
    }
}

TEST_CASE("sew: without smoothing the target's vertices come first and keep their bits") {
    const SewScene scene = two_tubes(24, 31);
    const Sewn sewn = sew(scene.target, scene.source, scene.joins, {.smooth = 0});
    for (Index v = 0; v < scene.target.vertex_count(); ++v) {
        REQUIRE(same_bits(sewn.mesh.position(v), scene.target.position(v)));
    }
    CHECK(area(sewn.mesh) ==
          doctest::Approx(area(scene.target) + area(scene.source)).epsilon(0.01));
}
