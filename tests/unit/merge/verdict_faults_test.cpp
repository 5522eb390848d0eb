// The verdict on surfaces: halves of one mesh are good, planted faults are found and named.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/merge/loop/band_quality.h"
#include "kernel/merge/merge_once.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/merge/verdict.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/merge/seam_column.h"
#include "tests/unit/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A part of a waisted vase around z, from one height to another.
Mesh part_of_vase(Index count, Index rings, double from, double to) {
    return tube(count, rings, [&](double angle, double height) {
        const double z = from + (to - from) * height, radius = 1.0 + 0.2 * std::sin(2.0 * z);
        return Vec3(radius * std::cos(angle), radius * std::sin(angle), z);
    });
}

struct Halves {
    Mesh lower, upper;
};

Halves halves(Index lower, Index upper) {
    return {part_of_vase(lower, std::max<Index>(4, lower / 2), 0.0, 1.5),
            part_of_vase(upper, std::max<Index>(4, upper / 2), 1.5, 3.0)};
}

// A turn, and a size.
Affine turned(double size) {
    return scaling(Vec3::Constant(size), Vec3::Zero()) *
           rotation({0.3, -0.5, 0.8}, 1.1, Vec3::Zero());
}

}  // namespace

TEST_CASE("two halves of one mesh are good at any density, direction and size") {
    for (const auto& counts : {std::pair(12, 12), std::pair(48, 48), std::pair(24, 70)}) {
        const Halves parts = halves(counts.first, counts.second);
        for (const double size : {1e-3, 1.0, 1e3}) {
            CAPTURE(counts.first);
            CAPTURE(counts.second);
            CAPTURE(size);
            const Affine map = turned(size);
            const MergeResult made = merge(moved(parts.upper, map), moved(parts.lower, map));
            CHECK_MESSAGE(made.report.ok, made.report.verdict);
        }
    }
}

namespace {

constexpr Index kFaultAround = 96, kFaultRows = 72;

// The source is above.
struct Column : SeamColumn {
    Column() : SeamColumn(kFaultAround, kFaultRows) {}

    // The verdict on a merge that made `made` of the halves of `rest`.
    Verdict judged(const Mesh& made, const Mesh& rest) const {
        MergeReport report;
        report.source_rim = report.target_rim = seam_quality(rest, {&seam, 1});
        report.seam.after = seam_quality(made, {&seam, 1});
        report.joins.resize(1);
        report.joins[0].band = band(made, rest);
        return verdict_of(report, {});
    }
    BandQuality band(const Mesh& made, const Mesh& rest) const {
        return band_quality({&made, below, seam, false, rest.positions()},
                            {&made, above, seam, false, rest.positions()}, {&rest, below, seam},
                            {&rest, above, seam}, 1.0, false);
    }
    Verdict judged(const Mesh& made) const { return judged(made, mesh); }
};

double out_of_row(const Vec3& p) {
    const double column = std::atan2(p.x(), p.z()) * kFaultAround / (2.0 * kPi);
    const auto number = std::lround(column) + std::lround(p.y() * kFaultRows / 4.0);
    return number % 2 == 0 ? 1.03 : 0.97;
}

void scale_out(Vec3& p, double out) {
    p.x() *= out;
    p.z() *= out;
}

bool names(const Verdict& verdict, MergeFault fault) {
    return std::any_of(verdict.reasons.begin(), verdict.reasons.end(),
                       [&](const MergeReason& r) { return r.fault == fault; });
}

}  // namespace

TEST_CASE("each planted fault of a surface is found and named, and nothing where there is none") {
    const Column column;
    CHECK(column.judged(column.mesh).good);

    const Verdict fold = column.judged(column.moved([](Vec3& p) {
        if (p.y() > 0.2 && p.y() < 0.6) p.y() = 0.4 - 0.5 * (p.y() - 0.2);
    }));
    CHECK(names(fold, MergeFault::folds));

    // Faces of one place that are turned over.
    const Verdict flipped = column.judged(column.moved([](Vec3& p) {
        const bool there = std::abs(std::atan2(p.x(), p.z())) < 0.4 && p.y() > 0.2 && p.y() < 0.3;
        if (there) p.y() += 0.25;
    }));
    CHECK(names(flipped, MergeFault::folds));

    const Verdict lip = column.judged(column.moved([](Vec3& p) {
        if (p.y() > -1e-9) scale_out(p, 1.0 + 0.35 * std::exp(-12.0 * p.y() * p.y()));
    }));
    CHECK(!lip.good);
    CHECK((names(lip, MergeFault::flare) || names(lip, MergeFault::bend)));

    const Verdict pit = column.judged(column.moved([](Vec3& p) {
        const double reach = (p - Vec3(0.0, 0.2, 1.0)).norm() / 0.3;
        if (reach < 1.0) p.z() -= 0.5 * (1.0 - reach);
    }));
    CHECK(names(pit, MergeFault::spike));

    const Verdict caved = column.judged(column.moved([](Vec3& p) {
        if (p.y() > 0.0) p.y() *= 0.3;
    }));
    CHECK(names(caved, MergeFault::volume));
}

TEST_CASE("a bitten edge along a part of a seam is found, at a single edge it does not show") {
    const Column column;
    const auto bitten = [&](double width) {
        return column.judged(column.moved([width](Vec3& p) {
            if (std::abs(p.y()) < 1e-9 && std::abs(std::atan2(p.x(), p.z())) < width) {
                scale_out(p, 0.975);
            }
        }));
    };
    CHECK(names(bitten(0.6), MergeFault::seam));
    const Verdict single = bitten(0.03);
    CHECK_MESSAGE(single.good, single.text);
}

TEST_CASE("a smooth source that crumples is found beside a rough target, a rough source is not") {
    const Column column;
    const auto crumple = [](Vec3& p, bool is_source) {
        const bool on_side = is_source ? p.y() > 0.1 : p.y() < -0.1;
        if (on_side && std::abs(p.y()) < 0.45) scale_out(p, out_of_row(p));
    };
    const Mesh rough_target = column.moved([&](Vec3& p) { crumple(p, false); });
    const Mesh rough = column.moved([&](Vec3& p) {
        crumple(p, false);
        crumple(p, true);
    });
    const Verdict same = column.judged(rough_target, rough_target);
    CHECK_MESSAGE(same.good, same.text);
    CHECK(column.judged(rough, rough).good);
    const Verdict crumpled = column.judged(rough, rough_target);
    CHECK(names(crumpled, MergeFault::roughness));
    CHECK(crumpled.text.find("rough") != std::string::npos);
}

namespace {

// The reason of that kind; one without a value if there is none.
MergeReason reason_of(const Verdict& verdict, MergeFault fault) {
    for (const MergeReason& reason : verdict.reasons) {
        if (reason.fault == fault) return reason;
    }
    return {};
}

}  // namespace

TEST_CASE("a ragged rim of a smooth target is found, one that was as ragged before is not") {
    const Column column;
    const Mesh ragged = column.moved([](Vec3& p) {
        if (p.y() < -0.02 && p.y() > -0.3) scale_out(p, 1.0 + 0.3 * (out_of_row(p) - 1.0));
    });
    const MergeReason found = reason_of(column.judged(ragged), MergeFault::roughness);
    CHECK_MESSAGE(found.text.find("the target beside the seam is rough") != std::string::npos,
                  found.text);
    CHECK(found.value < 9.0 * kDegree);
    CHECK(column.judged(ragged, ragged).good);
}

TEST_CASE("wrinkles of a rough source are found, its own roughness is not") {
    const Column column;
    const auto roughen = [](Vec3& p) {
        if (std::abs(p.y()) > 0.05) scale_out(p, 1.0 + 0.72 * (out_of_row(p) - 1.0));
    };
    const Mesh rough = column.moved(roughen);
    CHECK(column.judged(rough, rough).good);
    const Mesh wrinkled = column.moved([&](Vec3& p) {
        const double wave = std::cos(16.0 * std::atan2(p.x(), p.z()));
        if (p.y() > 0.05 && p.y() < 0.5) scale_out(p, 1.0 + 0.0235 * wave);
        roughen(p);
    });
    const MergeReason found = reason_of(column.judged(wrinkled, rough), MergeFault::roughness);
    CHECK_MESSAGE(found.text.find("the source beside the seam is rough") != std::string::npos,
                  found.text);
    CHECK(found.value > 14.0 * kDegree);
    CHECK(found.value < 16.0 * kDegree);
}

TEST_CASE("wrinkles between the creases of a source are found, creases that stay are not") {
    const Column column;
    const auto flute = [](Vec3& p) {
        scale_out(p, 1.0 + 0.25 * std::abs(std::sin(4.0 * std::atan2(p.x(), p.z()))));
    };
    const Mesh fluted = column.moved(flute);
    CHECK(column.judged(fluted, fluted).good);
    const auto wrinkle = [&](double height) {
        return column.moved([&](Vec3& p) {
            const double wave = std::cos(24.0 * std::atan2(p.x(), p.z()) + 30.0 * p.y());
            if (p.y() > 0.05 && p.y() < 0.5) scale_out(p, 1.0 + height * wave);
            flute(p);
        });
    };
    CHECK(column.judged(wrinkle(0.002), fluted).good);
    const MergeReason found =
        reason_of(column.judged(wrinkle(0.013), fluted), MergeFault::roughness);
    CHECK_MESSAGE(found.text.find("the source between its creases") != std::string::npos,
                  found.text);
}

TEST_CASE("dimples of a rough source that it did not have are found, a bend of all of it is not") {
    const Column column;
    const auto roughen = [](Vec3& p) {
        if (std::abs(p.y()) > 0.05) scale_out(p, 1.0 + 0.6 * (out_of_row(p) - 1.0));
    };
    const Mesh rough = column.moved(roughen);
    const auto bent = [](Vec3& p) { p.x() += 0.15 * p.y() * p.y(); };
    const Mesh leaning = column.moved([&](Vec3& p) {
        roughen(p);
        bent(p);
    });
    CHECK(column.judged(leaning, rough).good);
    CHECK(column.band(leaning, rough).crumpled < 0.1);
    const auto dimpled = [&](double depth) {
        return column.moved([&](Vec3& p) {
            const double around = std::cos(12.0 * std::atan2(p.x(), p.z()));
            const double up = std::exp(-std::pow((p.y() - 0.2) / 0.08, 2.0));
            roughen(p);
            if (p.y() > 0.0) scale_out(p, 1.0 - depth * around * up);
            bent(p);
        });
    };
    CHECK(column.band(dimpled(0.001), rough).crumpled < 0.1);
    const Mesh found = dimpled(0.2);
    const double length = column.band(found, rough).crumpled;
    CHECK(length > 6.0);
    CHECK(!column.judged(found, rough).good);
    // However both lie, and of any size.
    CHECK(column.band(moved(found, turned(1e3)), rough).crumpled == doctest::Approx(length));
    CHECK(column.band(found, moved(rough, turned(1e-3))).crumpled == doctest::Approx(length));
}

TEST_CASE("corners of a source that become round at the seam are no crumpled edges") {
    const Column column;
    const auto polygonal = [](Vec3& p, double sides, double share) {
        const double angle = std::atan2(p.x(), p.z());
        const double part = 2.0 * kPi / sides, off = std::remainder(angle, part);
        const double flat = std::cos(0.5 * part) / std::cos(std::abs(off) - 0.5 * part);
        scale_out(p, 1.0 + share * (1.0 / flat * std::cos(0.5 * part) - 1.0));
    };
    for (const double sides : {6.0, 8.0, 12.0}) {
        const Mesh rest = column.moved([&](Vec3& p) { polygonal(p, sides, 1.0); });
        const Mesh made =
            column.moved([&](Vec3& p) { polygonal(p, sides, std::clamp(2.0 * p.y(), 0.0, 1.0)); });
        CHECK(column.band(made, rest).crumpled < 0.5);
    }
}
