#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/core/geometry.h"
#include "kernel/merge/merge_once.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A cylinder and a waisted jug whose mouth opens wide: the rim of the cylinder stands out.
MergeResult cylinder_on_jug(MergeOptions options) {
    const Mesh source = tube(40, 25, [](double angle, double height) {
        return Vec3(std::sin(angle), 2.2 + 3.0 * height, std::cos(angle));
    });
    const Mesh target = tube(32, 21, [](double angle, double height) {
        const double radius = 1.0 + 0.8 * std::sin(6.0 * height);
        return Vec3(radius * std::sin(angle), 2.0 * height, radius * std::cos(angle));
    });
    return merge(source, target, {}, options);
}

bool is_told(const MergeReport& report) {
    return std::any_of(report.warnings.begin(), report.warnings.end(), [](const std::string& w) {
        return w.find("the plain seam had faults") != std::string::npos;
    });
}

}  // namespace

TEST_CASE("a seam that the verdict finds fault with is sewn another way, which is told") {
    const MergeResult plain = cylinder_on_jug({});
    REQUIRE(!plain.report.ok);
    CHECK(!is_told(plain.report));
    const MergeResult mended = cylinder_on_jug({.mend = true});
    CHECK(mended.report.ok);
    CHECK(is_told(mended.report));
    CHECK(mended.report.joins[0].band.roughness < plain.report.joins[0].band.roughness);
    CHECK(mended.report.joins[0].band.flare < plain.report.joins[0].band.flare);
}

TEST_CASE("pits of a fluted rim do not go on into a smooth part, and the far side stays") {
    const Mesh source = tube(20, 6, [](double angle, double height) {
        return Vec3(std::sin(angle), 1.4 + 2.0 * height, std::cos(angle));
    });
    const Mesh target = tube(96, 31, [](double angle, double height) {
        const double flute = std::pow(std::max(0.0, std::cos(4.0 * angle)), 8.0);
        const double radius = 1.0 - 0.15 * flute * height;
        return Vec3(radius * std::sin(angle), height, radius * std::cos(angle));
    });
    const auto crumpled = [](const MergeResult& r) { return r.report.joins[0].band.crumpled; };
    const MergeResult plain = merge(source, target),
                      faired = merge(source, target, {}, {.mend = true});
    REQUIRE(crumpled(plain) > 1.0);
    CHECK(crumpled(faired) < 0.5 * crumpled(plain));
    CHECK(faired.report.ok);
    for (Index v = 0; v < target.vertex_count(); ++v) {
        const Vec3& p = target.position(v);
        if (p.y() < 0.3) CHECK(faired.mesh.position(v) == p);
    }
}

TEST_CASE("a seam is not mended that is good, was asked for, or must keep the target") {
    CHECK(!is_told(cylinder_on_jug({.seam = SeamKind::fair, .mend = true}).report));
    const MergeOptions firm{.smooth = 0, .collar = false};
    MergeOptions firm_mend = firm;
    firm_mend.mend = true;
    CHECK(hash(cylinder_on_jug(firm).mesh) == hash(cylinder_on_jug(firm_mend).mesh));
    const Mesh lower = open_tube(24, 8);
    Mesh upper = open_tube(30, 8);
    for (Vec3& p : upper.edit_positions()) p.y() += 2.2;
    const MergeResult good = merge(upper, lower, {}, {.mend = true});
    CHECK(good.report.ok);
    CHECK(!is_told(good.report));
}

namespace {

// An upper tube with a ball in its wall or below that, on a lower tube.
MergeResult with_ball(double height) {
    const Mesh lower = open_tube(32, 12);
    Mesh upper = open_tube(32, 12);
    for (Vec3& p : upper.edit_positions()) p.y() += 2.2;
    Mesh ball = make_sphere({.radius = 0.3, .segments = 12});
    for (Vec3& p : ball.edit_positions()) p += Vec3(0.0, height, 1.0);
    append(upper, ball);
    return merge(upper, lower);
}

bool has_crossing_fault(const MergeReport& report) {
    return std::any_of(report.reasons.begin(), report.reasons.end(),
                       [](const MergeReason& r) { return r.fault == MergeFault::crossings; });
}

}  // namespace

TEST_CASE("a separate part that was stuck into the source may be stuck into the target") {
    CHECK(!has_crossing_fault(with_ball(1.35).report));
    // A ball that touched nothing before is told.
    CHECK(has_crossing_fault(with_ball(0.85).report));
}
