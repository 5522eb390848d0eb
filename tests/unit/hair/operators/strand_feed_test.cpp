#include "kernel/hair/operators/strand_feed.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/core/error.h"
#include "tests/unit/hair/strands/strand_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Strands of 0.1 metres along y that begin in a row of 0.3 metres along x, and one far away.
Strands row_of_strands(Index count) {
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < count; ++s) {
        std::vector<Vec3> points;
        for (int k = 0; k <= 20; ++k) points.emplace_back(0.3 * s / count, 0.005 * k, 0.0);
        lists.push_back(points);
    }
    lists.push_back({{0.1, 0, 1}, {0.1, 0.1, 1}});
    return strands_of(lists);
}

FeedBraidOptions along_row() {
    FeedBraidOptions options;
    options.spine = {{-0.05, 0.06, 0.005}, {0.2, 0.06, 0.005}, {0.45, 0.06, 0.005}};
    options.across = Vec3::UnitY();
    return options;
}

double length_of(const StrandView& strand) {
    double sum = 0.0;
    for (Index k = 1; k < strand.cols(); ++k) sum += (strand.col(k) - strand.col(k - 1)).norm();
    return sum;
}

double turn_at(const StrandView& strand, Index k) {
    const Eigen::Vector3f a = strand.col(k) - strand.col(k - 1);
    const Eigen::Vector3f b = strand.col(k + 1) - strand.col(k);
    return std::acos(std::clamp(double(a.normalized().dot(b.normalized())), -1.0, 1.0));
}

}  // namespace

TEST_CASE("strands join a braid where they come near, stay before it, and others stay") {
    Strands strands = row_of_strands(200);
    const Strands before = strands;
    const BraidReport report = feed_braid(strands, along_row());
    CHECK(report.braided == 200);
    CHECK(report.missed == 1);
    CHECK(same_points(strands.strand(200), before.strand(200)));
    for (Index s = 0; s < 200; ++s) {
        // The first point within 10 mm of the spine is the 11th.
        CHECK(strands.strand(s).leftCols(11) == before.strand(s).leftCols(11));
        CHECK(strands.strand(s).cols() > 30);
        CHECK(strands.strand(s).allFinite());
    }
}

TEST_CASE("strands run in the braid as long as asked, within its section") {
    Strands strands = row_of_strands(300);
    FeedBraidOptions options = along_row();
    options.loose = 0.0;
    feed_braid(strands, options);
    for (Index s = 0; s < 300; ++s) {
        const StrandView strand = strands.strand(s);
        const double run = strand.col(strand.cols() - 1).x() - strand.col(0).x();
        CHECK(run > options.min_run - 0.012);
        CHECK(run < options.max_run + 0.012);
        for (Index k = 25; k < strand.cols(); ++k) {
            CHECK(std::abs(strand(1, k) - 0.06) < 2.4 * 1.15 * options.radius);
            CHECK(std::abs(strand(2, k) - 0.005) < 2.0 * options.radius);
        }
    }
}

TEST_CASE("strands that join a braid at a right angle have no kink there") {
    Strands strands = row_of_strands(200);
    FeedBraidOptions options = along_row();
    options.loose = 0.0;
    feed_braid(strands, options);
    int sharp = 0;
    for (Index s = 0; s < 200; ++s) {
        const StrandView strand = strands.strand(s);
        CHECK(turn_at(strand, 10) < 30 * kDegree);
        for (Index k = 11; k + 1 < strand.cols(); ++k) {
            CHECK(turn_at(strand, k) < 100 * kDegree);
            sharp += turn_at(strand, k) > 65 * kDegree;
        }
    }
    CHECK(sharp < 20);
}

TEST_CASE("a strand fed into a braid does not depend on the number of others") {
    Strands few = row_of_strands(50), all = row_of_strands(50);
    all = [&] {
        std::vector<std::vector<Vec3>> lists;
        for (Index s = 0; s < 50; ++s) {
            lists.emplace_back();
            for (Index k = 0; k < all.point_count(s); ++k) {
                lists.back().push_back(point_of(all.strand(s), k));
            }
        }
        for (Index s = 0; s < 70; ++s) lists.push_back({{0.1, 0, 0}, {0.1, 0.08, 0}});
        return strands_of(lists);
    }();
    feed_braid(few, along_row());
    feed_braid(all, along_row());
    for (Index s = 0; s < 50; ++s) CHECK(same_points(few.strand(s), all.strand(s)));
    FeedBraidOptions other = along_row();
    other.seed = 2;
    Strands changed = row_of_strands(50);
    feed_braid(changed, other);
    CHECK(!same_points(few.strand(0), changed.strand(0)));
}

TEST_CASE("a mask leaves strands out of a braid, and others can be dropped") {
    Strands strands = row_of_strands(100);
    const Strands before = strands;
    FeedBraidOptions options = along_row();
    options.mask.assign(101, 1.0f);
    options.mask[3] = 0.4f;
    options.drop_others = true;
    CHECK(feed_braid(strands, options).braided == 99);
    CHECK(strands.size() == 100);
    CHECK(same_points(strands.strand(3), before.strand(3)));
}

TEST_CASE("points and strands without length are no hair for a braid") {
    Strands strands = strands_of(
        {{{0.1, 0.06, 0}}, {{0.1, 0.06, 0}, {0.1, 0.06, 0}}, {{0.1, 0, 0}, {0.1, 0.07, 0}}});
    CHECK(feed_braid(strands, along_row()).braided == 1);
    CHECK(strands.point_count(0) == 1);
    CHECK(strands.point_count(1) == 2);
    CHECK(length_of(strands.strand(2)) > 0.1);
}

TEST_CASE("a braid that no strand comes near, or with options out of range, changes nothing") {
    Strands strands = row_of_strands(20);
    const Strands before = strands;
    const auto refused = [&](auto change) {
        FeedBraidOptions options = along_row();
        change(options);
        CHECK_THROWS_AS(feed_braid(strands, options), Error);
        CHECK(strands.size() == before.size());
        CHECK(same_points(strands.strand(0), before.strand(0)));
    };
    refused([](auto& o) { o.spine = {{0, 3, 0}, {1, 3, 0}}; });
    refused([](auto& o) { o.spine = {{0, 0, 0}, {0, 0, 0}}; });
    refused([](auto& o) { o.across.setZero(); });
    refused([](auto& o) { o.radius = 0.0; });
    refused([](auto& o) { o.step = 0.0; });
    refused([](auto& o) { o.step = 1e-9; });
    refused([](auto& o) { o.max_run = 0.01; });
    refused([](auto& o) { o.joined = 0.0; });
    refused([](auto& o) { o.tail = 1.5; });
    refused([](auto& o) { o.wide = std::numeric_limits<double>::infinity(); });
    refused([](auto& o) { o.mask.assign(3, 1.0f); });
}
