// What the surface around a seam is measured by, and the guard that it gives every step.
#include "kernel/merge/loop/band_quality.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "kernel/core/geometry.h"
#include "kernel/merge/merge_once.h"
#include "kernel/merge/sew/seam_guard.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/merge/seam_column.h"
#include "tests/unit/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

constexpr Index kAround = 48, kRows = 48;

struct Barrel : SeamColumn {
    Barrel() : SeamColumn(kAround, kRows) {}

    BandQuality measured(const Mesh& made, double scale = 1.0, bool stays = false) const {
        return band_quality({&made, below, seam}, {&made, above, seam}, {&mesh, below, seam},
                            {&mesh, above, seam}, scale, stays);
    }
};

double row_of(const Vec3& p) {
    return p.y() * kRows / 4.0;
}

}  // namespace

TEST_CASE("a band that is as it was is no rougher, folds nowhere and keeps both volumes") {
    const Barrel barrel;
    REQUIRE(count_of(barrel.seam) == kAround);
    const BandQuality same = barrel.measured(barrel.mesh);
    CHECK(same.radius == doctest::Approx(1.0).epsilon(0.01));
    CHECK(same.rest_roughness > 0.0);
    CHECK(same.roughness == doctest::Approx(same.rest_roughness));
    CHECK(same.bend < 1e-6);
    CHECK(same.max_bend < 1e-6);
    CHECK(same.folded == 0.0);
    CHECK(same.source_volume == doctest::Approx(1.0));
    CHECK(same.target_volume == doctest::Approx(1.0));
}

TEST_CASE("crumples, ledges, folds and lost volume of a band are each seen by their own measure") {
    const Barrel barrel;
    const BandQuality crumpled = barrel.measured(barrel.moved([](Vec3& p) {
        if (std::abs(p.y()) > 0.45 || std::abs(p.y()) < 1e-9) return;
        const double angle = std::atan2(p.x(), p.z()) * kAround / (2.0 * kPi);
        const auto number = std::lround(angle) + std::lround(row_of(p));
        const double out = number % 2 == 0 ? 1.02 : 0.98;
        p.x() *= out;
        p.z() *= out;
    }));
    CHECK(crumpled.roughness > 1.5 * crumpled.rest_roughness);
    CHECK(crumpled.bend < 10.0 * kDegree);

    const BandQuality ledge = barrel.measured(barrel.moved([](Vec3& p) {
        const double out = 1.0 + 0.4 * std::exp(-30.0 * p.y() * p.y());
        p.x() *= out;
        p.z() *= out;
    }));
    CHECK(ledge.bend > 30.0 * kDegree);
    CHECK(ledge.rest_bend < 1e-6);

    const BandQuality folded = barrel.measured(barrel.moved([](Vec3& p) {
        if (p.y() > 0.2 && p.y() < 0.6) p.y() = 0.4 - 0.5 * (p.y() - 0.2);
    }));
    CHECK(folded.folded > 1.0);
    CHECK(folded.rest_folded == 0.0);

    const BandQuality caved = barrel.measured(barrel.moved([](Vec3& p) {
        if (p.y() > 0.0) p.y() *= 0.5;
    }));
    CHECK(caved.source_volume == doctest::Approx(0.5));
    CHECK(caved.target_volume == doctest::Approx(1.0));
    const BandQuality inside_out = barrel.measured(barrel.moved([](Vec3& p) {
        if (p.y() > 0.0) p.y() *= -0.5;
    }));
    CHECK(inside_out.source_volume < 0.0);
}

TEST_CASE("volume is compared at the source's scale, or in its place where it stays") {
    const Barrel barrel;
    const Mesh grown = barrel.moved([](Vec3& p) { p *= 1.5; });
    const auto measure = [&](double scale, bool stays) {
        return band_quality({&grown, barrel.below, barrel.seam},
                            {&grown, barrel.above, barrel.seam},
                            {&grown, barrel.below, barrel.seam},
                            {&barrel.mesh, barrel.above, barrel.seam}, scale, stays);
    };
    CHECK(measure(1.5, false).source_volume == doctest::Approx(1.0));
    CHECK(measure(1.0, false).source_volume == doctest::Approx(3.375));
    // In its place it is measured from the middle of the seam.
    CHECK(measure(1.5, true).source_volume == doctest::Approx(3.375));
}

TEST_CASE("a step that crumples the band is refused, though one edge there is steeper before it") {
    Barrel barrel;
    // One steep tooth beside the seam: every limit of a greatest angle is set by it.
    Index tooth = kNoIndex;
    for (Index v = 0; v < barrel.mesh.vertex_count(); ++v) {
        const Vec3& p = barrel.mesh.position(v);
        if (std::lround(row_of(p)) == 1 && p.z() > 0.999) tooth = v;
    }
    REQUIRE(tooth != kNoIndex);
    Mesh mesh = barrel.mesh;
    Vec3 out = mesh.position(tooth);
    out.x() *= 1.12;
    out.z() *= 1.12;
    mesh.set_position(tooth, out);
    std::vector<Index> moving;
    std::vector<Vec3> to;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 p = mesh.position(v);
        if (std::abs(p.y()) > 0.45 || std::abs(p.y()) < 1e-9 || v == tooth) continue;
        const double angle = std::atan2(p.x(), p.z()) * kAround / (2.0 * kPi);
        const auto number = std::lround(angle) + std::lround(row_of(p));
        const double by = number % 2 == 0 ? 1.02 : 0.98;
        moving.push_back(v);
        to.push_back({by * p.x(), p.y(), by * p.z()});
    }
    const std::vector<std::vector<Index>> seams{barrel.seam};
    const auto roughness = [&](std::span<const Vec3> positions) {
        const Mesh shape({positions.begin(), positions.end()}, mesh.shared_topology());
        return barrel.measured(shape).roughness;
    };
    const double before = roughness(mesh.positions());
    SeamGuard guard(mesh, seams, moving, {});
    guard.move(to);
    CHECK(roughness(guard.positions()) < 1.15 * before);
}

TEST_CASE(
    "a rim that was bent outward is seen by the flare, a fillet and a shape at rest are not") {
    const Barrel barrel;
    const auto flare = [&](const Mesh& made, const Mesh& rest) {
        return band_quality({&made, barrel.below, barrel.seam},
                            {&made, barrel.above, barrel.seam, false, rest.positions()},
                            {&rest, barrel.below, barrel.seam}, {&rest, barrel.above, barrel.seam},
                            1.0, false)
            .flare;
    };
    const auto widened = [](double y) { return 1.0 + 0.5 * std::sin(6.0 * y) * (y < 0.52); };
    const Mesh rim = barrel.moved([&](Vec3& p) {
        if (p.y() <= 0.0) return;
        const double out = widened(p.y());
        p.x() *= out;
        p.z() *= out;
    });
    const Mesh waist = barrel.moved([](Vec3& p) {
        if (p.y() <= 0.0 || p.y() >= 1.0) return;
        const double in = 1.0 - 0.5 * p.y();
        p.x() *= in;
        p.z() *= in;
    });
    CHECK(flare(barrel.mesh, barrel.mesh) < 1e-9);
    CHECK(flare(rim, barrel.mesh) > 40.0 * kDegree);
    CHECK(flare(rim, rim) < 1e-9);
    CHECK(flare(waist, barrel.mesh) < 10.0 * kDegree);
    // Whether the faces look outward or inward: the same surface turned over is as good or bad.
    Mesh rest_over = barrel.mesh, rim_over = rim;
    flip(rest_over);
    flip(rim_over);
    CHECK(flare(rim_over, rest_over) == doctest::Approx(flare(rim, barrel.mesh)));
}

TEST_CASE("a thorn or pit that the source did not have is seen, one at rest and bends are not") {
    const Barrel barrel;
    const auto pinched = [&](const Mesh& made, const Mesh& rest) {
        return band_quality({&made, barrel.below, barrel.seam},
                            {&made, barrel.above, barrel.seam, false, rest.positions()},
                            {&rest, barrel.below, barrel.seam}, {&rest, barrel.above, barrel.seam},
                            1.0, false)
            .pinched;
    };
    // One vertex of the third row above the seam, opposite vertices for two.
    const auto thorny = [&](double out, bool two) {
        return barrel.moved([out, two](Vec3& p) {
            const bool here = p.z() > 0.999 || (two && p.z() < -0.999);
            if (!here || std::lround(row_of(p)) != 3) return;
            p.z() *= 1.0 + out;
        });
    };
    const Mesh thorn = thorny(0.15, false), pit = thorny(-0.15, false),
               flatter = thorny(0.1, false);
    const double one = pinched(thorn, barrel.mesh);
    CHECK(pinched(barrel.mesh, barrel.mesh) == 0.0);
    CHECK(one > 0.05);
    CHECK(one < 0.2);
    CHECK(pinched(thorny(0.15, true), barrel.mesh) == doctest::Approx(2.0 * one).epsilon(0.01));
    CHECK(pinched(pit, barrel.mesh) > 0.05);
    CHECK(pinched(pit, thorn) > 0.05);
    CHECK(pinched(thorn, thorn) == 0.0);
    CHECK(pinched(flatter, thorn) == 0.0);
    Mesh elsewhere = barrel.mesh;
    for (Vec3& p : elsewhere.edit_positions()) p = 3.0 * Vec3(p.y(), p.z(), p.x());
    CHECK(pinched(thorn, elsewhere) == doctest::Approx(one));
    const Mesh waist = barrel.moved([](Vec3& p) {
        if (p.y() <= 0.0 || p.y() >= 1.0) return;
        p.x() *= 1.0 - 0.5 * p.y();
        p.z() *= 1.0 - 0.5 * p.y();
    });
    CHECK(pinched(waist, barrel.mesh) == 0.0);
}

TEST_CASE("a straight tube of many sides on one of few has no flare, for all its slivers") {
    const auto lobed = [](double from) {
        return [from](double angle, double height) {
            const double radius = 1.0 + 0.1 * std::cos(3.0 * angle);
            return Vec3(from + 2.0 * height, radius * std::cos(angle), radius * std::sin(angle));
        };
    };
    const Mesh source = tube(600, 5, lobed(0.0)), target = tube(16, 5, lobed(2.2));
    const MergeResult made = merge(source, target, {}, {.find_intersections = false});
    CHECK(made.report.seam.collar_added > 0);
    CHECK(made.report.joins[0].band.flare < 10.0 * kDegree);
}

TEST_CASE("a tip beside the seam is seen, one that was there before, ridges and ledges are not") {
    const Barrel barrel;
    CHECK(barrel.measured(barrel.mesh).spike < 1e-6);
    CHECK(barrel.measured(barrel.mesh).rest_spike < 1e-6);
    const auto with_tip = [&](double out) {
        return barrel.moved([out](Vec3& p) {
            const double reach = (p - Vec3(0.0, 0.2, 1.0)).norm() / 0.3;
            if (reach < 1.0) p.z() += out * (1.0 - reach);
        });
    };
    const Mesh spiky = with_tip(0.5);
    CHECK(barrel.measured(spiky).spike > 120.0 * kDegree);
    CHECK(barrel.measured(with_tip(-0.5)).spike > 120.0 * kDegree);
    CHECK(barrel.measured(with_tip(0.1)).spike < 60.0 * kDegree);
    const BandQuality same = band_quality(
        {&spiky, barrel.below, barrel.seam}, {&spiky, barrel.above, barrel.seam},
        {&spiky, barrel.below, barrel.seam}, {&spiky, barrel.above, barrel.seam}, 1.0, false);
    CHECK(same.spike == doctest::Approx(same.rest_spike));
    const Mesh ledge = barrel.moved([](Vec3& p) {
        const double out = 1.0 + 0.4 * std::exp(-30.0 * p.y() * p.y());
        p.x() *= out;
        p.z() *= out;
    });
    CHECK(barrel.measured(ledge).spike < 60.0 * kDegree);
}

TEST_CASE("lost volume is seen on a mesh that is inside out as well") {
    const Barrel barrel;
    Mesh rest = barrel.mesh, caved = barrel.moved([](Vec3&p) {
        if (p.y() > 0.0) p.y() *= 0.5;
    });
    flip(rest);
    flip(caved);
    const BandQuality band = band_quality(
        {&caved, barrel.below, barrel.seam}, {&caved, barrel.above, barrel.seam},
        {&rest, barrel.below, barrel.seam}, {&rest, barrel.above, barrel.seam}, 1.0, false);
    CHECK(band.source_volume == doctest::Approx(0.5));
    CHECK(band.target_volume == doctest::Approx(1.0));
}

TEST_CASE("one point of a seam does not decide how much it bends, a tenth of it does") {
    const Barrel barrel;
    const auto dented = [&](double width) {
        return barrel.measured(barrel.moved([&](Vec3& p) {
            const double angle = std::atan2(p.x(), p.z());
            if (p.y() <= 0.0 || p.y() > 1.0 || std::abs(angle) > width) return;
            const double in = 1.0 - 0.9 * p.y();
            p.x() *= in;
            p.z() *= in;
        }));
    };
    CHECK(dented(0.1).max_bend < 30.0 * kDegree);
    CHECK(dented(1.0).max_bend > 35.0 * kDegree);
}

TEST_CASE("a slit beside the seam counts by its sharp edges, one that was there before does not") {
    const Barrel barrel;
    CHECK(barrel.measured(barrel.mesh).sharpened == 0.0);
    // One line of vertices along the column is drawn in.
    const Mesh slit = barrel.moved([](Vec3& p) {
        if (p.y() > 0.0 && std::abs(p.x()) < 0.05 && p.z() > 0.0) p.z() -= 0.4;
    });
    const BandQuality cut = barrel.measured(slit);
    CHECK(cut.sharpened > 0.4);
    CHECK(cut.sharpened < 3.0);
    const BandQuality same = band_quality(
        {&slit, barrel.below, barrel.seam}, {&slit, barrel.above, barrel.seam},
        {&slit, barrel.below, barrel.seam}, {&slit, barrel.above, barrel.seam}, 1.0, false);
    CHECK(same.sharpened == 0.0);
    // Whatever the size.
    Mesh large = slit, large_rest = barrel.mesh;
    transform(large, scaling(Vec3(128, 128, 128), Vec3::Zero()));
    transform(large_rest, scaling(Vec3(128, 128, 128), Vec3::Zero()));
    const BandQuality scaled =
        band_quality({&large, barrel.below, barrel.seam}, {&large, barrel.above, barrel.seam},
                     {&large_rest, barrel.below, barrel.seam},
                     {&large_rest, barrel.above, barrel.seam}, 1.0, false);
    CHECK(scaled.sharpened == doctest::Approx(cut.sharpened));
}

TEST_CASE("a single tooth does not make the edges beside a boundary steep, pleats do") {
    const auto rest_steep = [](double part) {
        const Barrel barrel;
        const Mesh pleated = barrel.moved([part](Vec3& p) {
            const double turn = std::atan2(p.x(), p.z()) / (2.0 * kPi) + 0.5;
            if (p.y() <= 0.0 || turn > part) return;
            const double out = std::lround(turn * kAround) % 2 == 0 ? 1.15 : 0.9;
            p.x() *= out;
            p.z() *= out;
        });
        return band_quality({&pleated, barrel.below, barrel.seam},
                            {&pleated, barrel.above, barrel.seam},
                            {&pleated, barrel.below, barrel.seam},
                            {&pleated, barrel.above, barrel.seam}, 1.0, false)
            .rest_steep;
    };
    CHECK(rest_steep(0.0) < 15.0 * kDegree);
    CHECK(rest_steep(0.5 / kAround) < 30.0 * kDegree);
    CHECK(rest_steep(1.0) > 60.0 * kDegree);
}
