#include "kernel/hair/operators/strand_braid.h"

#include <algorithm>
#include <cmath>

#include "tests/unit/hair/strands/strand_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Upright strands of 0.2 metres around the y axis, and one far from it.
Strands sheaf(Index count) {
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < count; ++s) {
        const double angle = 2.4 * s, away = 0.02 * std::sqrt((s + 0.5) / count);
        std::vector<Vec3> points;
        for (int k = 0; k <= 20; ++k) {
            points.emplace_back(away * std::cos(angle), 0.01 * k, away * std::sin(angle));
        }
        lists.push_back(points);
    }
    lists.push_back({{0.3, 0, 0}, {0.3, 0.2, 0}});
    return strands_of(lists);
}

BraidOptions along_y() {
    BraidOptions options;
    options.spine = {{0, 0.1, 0}, {0, 0.25, 0}, {0, 0.6, 0}};
    return options;
}

}  // namespace

TEST_CASE("a braid takes the strands that pass its tie, keeps them before it, and leaves others") {
    Strands strands = sheaf(300);
    const Strands before = strands;
    const BraidReport report = braid(strands, along_y());
    CHECK(report.braided == 300);
    CHECK(report.missed == 1);
    CHECK(same_points(strands.strand(300), before.strand(300)));
    for (Index s = 0; s < 300; ++s) {
        CHECK(strands.strand(s).leftCols(10) == before.strand(s).leftCols(10));
        CHECK(strands.strand(s).allFinite());
    }
}

TEST_CASE("a braid is as long and as wide as asked, and its three tubes cross") {
    Strands strands = sheaf(600);
    BraidOptions options = along_y();
    options.taper = options.loose = options.early = 0.0;
    braid(strands, options);
    double widest = 0.0, highest = 0.0;
    // Strands across the middle of the braid: of each, its place and its place half a turn further.
    int crossed = 0;
    for (Index s = 0; s < 600; ++s) {
        const StrandView strand = strands.strand(s);
        double x = 0.0, later = 0.0;
        for (Index k = 0; k < strand.cols(); ++k) {
            highest = std::max(highest, double(strand(1, k)));
            if (strand(1, k) > 0.15f && strand(1, k) < 0.3f)
                widest = std::max(widest, std::abs(double(strand(0, k))));
            if (std::abs(strand(1, k) - 0.2f) < 0.002f) x = strand(0, k);
            if (std::abs(strand(1, k) - 0.24375f) < 0.002f) later = strand(0, k);
        }
        if (x * later < 0.0) ++crossed;
    }
    CHECK(widest > 2.0 * 0.0125);
    CHECK(widest < 2.6 * 0.0125);
    CHECK(highest > 0.37);
    CHECK(highest < 0.3901 + 0.004);
    CHECK(crossed > 200);
}

TEST_CASE("a bun lies on its torus around the tie") {
    Strands strands = sheaf(200);
    BunOptions options;
    options.tie = {{0, 0.1, 0}, {0, 1, 0}, 0.05};
    options.loose = 0.0;
    const BraidReport report = bun(strands, options);
    CHECK(report.braided == 200);
    for (Index s = 0; s < 200; ++s) {
        const StrandView strand = strands.strand(s);
        for (Index k = strand.cols() - 40; k < strand.cols(); ++k) {
            const double r = std::hypot(strand(0, k), strand(2, k));
            const double tube = std::hypot(r - options.radius, strand(1, k) - 0.105);
            CHECK(tube < options.tube + 0.001);
        }
    }
}

TEST_CASE("braids do not depend on threads; a mask keeps strands out") {
    const Strands before = sheaf(120);
    Strands strands = before, again = before;
    BraidOptions options = along_y();
    options.mask.assign(121, 1.0f);
    options.mask[7] = 0.0f;
    braid(strands, options);
    braid(again, options, threads(8));
    CHECK(hash(strands) == hash(again));
    CHECK(same_points(strands.strand(7), before.strand(7)));
}

TEST_CASE("braids without enough strands or with bad spines are refused, and strands stay") {
    Strands strands = sheaf(2);
    const std::uint64_t before = hash(strands);
    const auto refused = [&](const auto& change) {
        BraidOptions options = along_y();
        change(options);
        return error_of([&] { braid(strands, options); }).code() == ErrorCode::invalid_argument;
    };
    CHECK(refused([](auto&) {}));
    strands = sheaf(100);
    CHECK(refused([](auto& o) { o.spine = {{0, 1, 0}}; }));
    CHECK(refused([](auto& o) { o.spine = {{0, 1, 0}, {0, 1, 0}}; }));
    CHECK(refused([](auto& o) { o.across = Vec3::UnitY(); }));
    CHECK(refused([](auto& o) { o.radius = 0.0; }));
    CHECK(refused([](auto& o) { o.length = -1.0; }));
    CHECK(refused([](auto& o) { o.taper = 1.0; }));
    CHECK(refused([](auto& o) { o.step = 1e-9; }));
    CHECK(hash(strands) == hash(sheaf(100)));
    strands = sheaf(2);
    CHECK(hash(strands) == before);
    CHECK(error_of([&] { bun(strands, {}); }).code() == ErrorCode::invalid_argument);
}
