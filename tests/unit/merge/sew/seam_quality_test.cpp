// What is measured at a seam, on a house whose angles are known.
#include "kernel/merge/sew/seam_quality.h"

#include <doctest/doctest.h>

#include <cmath>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;
using doctest::Approx;

namespace {

constexpr double kLong = 3.0, kShort = 1.0, kHeight = 0.7;

// Four walls below a roof of four triangles; the eaves are vertices 0 to 3, the first edge long.
Mesh house(double scale = 1.0) {
    std::vector<Vec3> positions;
    for (const double z : {0.0, -1.0}) {
        positions.insert(positions.end(),
                         {{0, 0, z}, {kLong, 0, z}, {kLong, kShort, z}, {0, kShort, z}});
    }
    positions.emplace_back(0.5 * kLong, 0.5 * kShort, kHeight);
    for (Vec3& p : positions) p *= scale;
    FaceList faces;
    for (Index k = 0; k < 4; ++k) {
        const Index next = (k + 1) % 4;
        faces.add({k, next, 8});
        faces.add({4 + k, 4 + next, next, k});
    }
    return {std::move(positions), std::move(faces)};
}

// Between the wall and the roof at an edge that lies `away` from the top.
double eaves_angle(double away) {
    return 0.5 * kPi - std::atan(kHeight / away);
}

}  // namespace

TEST_CASE("seam quality: angles and lengths of a roof's eaves") {
    const double at_long = eaves_angle(0.5 * kShort), at_short = eaves_angle(0.5 * kLong);
    const double squares = kLong * at_long * at_long + kShort * at_short * at_short;
    for (const double scale : {0.1, 1.0, 20.0}) {
        CAPTURE(scale);
        const Mesh mesh = house(scale);
        const SeamQuality quality =
            seam_quality(mesh, std::vector<std::vector<Index>>{{0, 1, 2, 3}});
        CHECK(quality.vertices == 4);
        CHECK(quality.mean_edge == Approx(0.5 * (kLong + kShort) * scale));
        CHECK(quality.max_dihedral == Approx(at_short));
        CHECK(quality.rms_dihedral == Approx(std::sqrt(squares / (kLong + kShort))));
        // The corners of the walls are next to it.
        CHECK(quality.max_near == Approx(0.5 * kPi));
        const double rafter = Vec3(0.5 * kLong, 0.5 * kShort, kHeight).norm();
        CHECK(quality.smallest_angle == Approx(std::acos(0.5 * kLong / rafter)));
        CHECK(quality.low_angle == quality.smallest_angle);
    }
}

TEST_CASE(
    "seam quality: neither where a seam begins nor its direction matters; two count together") {
    const Mesh mesh = house();
    const SeamQuality one = seam_quality(mesh, std::vector<std::vector<Index>>{{0, 1, 2, 3}});
    const SeamQuality other = seam_quality(mesh, std::vector<std::vector<Index>>{{2, 1, 0, 3}});
    CHECK(other.rms_dihedral == Approx(one.rms_dihedral));
    CHECK(other.max_near == one.max_near);
    const SeamQuality twice =
        seam_quality(mesh, std::vector<std::vector<Index>>{{0, 1, 2, 3}, {3, 0, 1, 2}});
    CHECK(twice.vertices == 8);
    CHECK(twice.mean_edge == Approx(one.mean_edge));
    CHECK(twice.rms_dihedral == Approx(one.rms_dihedral));
}

TEST_CASE("the angle of polygons at a seam is that of the triangles which they are divided into") {
    // The walls are rectangles of 3 by 1 and squares: their diagonals leave atan(1 / 3).
    const Mesh mesh = house();
    const std::vector<std::vector<Index>> eaves{{0, 1, 2, 3}};
    CHECK(seam_quality(mesh, eaves).polygon_angle == Approx(std::atan(1.0 / 3.0)));
    // Without polygons there is none.
    CHECK(seam_quality(make_sphere({.segments = 8, .kind = SphereKind::triangles}), {})
              .polygon_angle == 0.0);
}
