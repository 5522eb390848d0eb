#include "viewer/render/strands/packed_strands.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "kernel/hair/strands/strand_random.h"
#include "tests/unit/viewer/render/strands/strand_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// Straight strands whose roots lie at random in the unit square, sorted as a file may have them:
// dense on the left.
Strands sorted_strands(Index count) {
    std::vector<double> places;
    for (Index s = 0; s < count; ++s) {
        const double x = 0.5 + 0.5 * random_vector(1, s).x();
        places.push_back(x * x);
    }
    std::sort(places.begin(), places.end());
    std::vector<std::vector<Vec3>> lines;
    for (Index s = 0; s < count; ++s) {
        const Vec3 root(places[at(s)], 0.5 + 0.5 * random_vector(2, s).y(), 0.0);
        lines.push_back({root, root + Vec3(0, 0, 0.1), root + Vec3(0, 0, 0.2)});
    }
    return test::strands_of(lines, 0.001);
}

DrawnStrands drawn(const Strands& strands, const StrandStyle& style = {}) {
    return {test::shared(strands), style, {}};
}

double width_of(const PackedStrands& packed, const PackedPoint& point) {
    return packed.widest * std::pow(point.look[3] / 255.0, 2);
}

}  // namespace

TEST_CASE("packed strands: every beginning of the order is a fair sample") {
    const Strands strands = sorted_strands(20000);
    const std::vector<Index> order = even_order(strands, strands.size());
    std::vector<Index> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    for (Index s = 0; s < strands.size(); ++s) REQUIRE(sorted[at(s)] == s);
    // In each of 4 x 4 fields the same share as of all, much nearer than chance would have it.
    const auto counts = [&](Index first) {
        std::vector<double> result(16, 0.0);
        for (Index i = 0; i < first; ++i) {
            const Eigen::Vector3f root = strands.root(order[at(i)]);
            result[at(std::min(static_cast<int>(4 * root.x()), 3) +
                      4 * std::min(static_cast<int>(4 * root.y()), 3))] += 1.0;
        }
        return result;
    };
    const std::vector<double> all = counts(strands.size());
    for (const Index first : {200, 777, 1000, 5000, 13000}) {
        const std::vector<double> part = counts(first);
        for (std::size_t field = 0; field < 16; ++field) {
            const double wanted = all[field] * first / strands.size();
            CHECK(std::abs(part[field] - wanted) < 2.0 + 0.15 * wanted);
        }
    }
}

TEST_CASE("packed strands: the order is one of the strands that the style draws") {
    const Strands strands = sorted_strands(1000);
    for (const Index count : {0, 1, 2, 3, 511, 512, 513, 1000}) {
        std::vector<Index> order = even_order(strands, count);
        std::sort(order.begin(), order.end());
        REQUIRE(count_of(order) == count);
        for (Index s = 0; s < count; ++s) CHECK(order[at(s)] == s);
    }
    StrandStyle style;
    style.count = 10;
    const PackedStrands packed = pack_strands(drawn(strands, style));
    CHECK(packed.all.size() == 10);
    // Each stands for a hundred.
    CHECK(packed.widest == Approx(0.1));
}

TEST_CASE("packed strands: a ribbon begins and ends without width, where its strand does") {
    StrandStyle style;
    style.color = kWhite;
    style.root_tone = style.tip_tone = 1.0;
    style.strand_tone = style.clump_tone = 0.0;
    const Strands one = test::strands_of({{Vec3(1, 2, 3), Vec3(1, 2, 4), Vec3(1, 2, 6)}}, 0.002);
    const PackedStrands packed = pack_strands(drawn(one, style));
    REQUIRE(packed.all.points.size() == 5);
    const auto& points = packed.all.points;
    CHECK(points[0].position == std::array{1.0f, 2.0f, 3.0f});
    CHECK(points[0].position == points[1].position);
    CHECK(points[2].position == std::array{1.0f, 2.0f, 4.0f});
    CHECK(points[3].position == std::array{1.0f, 2.0f, 6.0f});
    CHECK(points[4].position == points[3].position);
    CHECK(points[0].look[3] == 0);
    CHECK(points[4].look[3] == 0);
    for (const std::size_t i : {1, 2, 3}) {
        CHECK(width_of(packed, points[i]) == Approx(0.002));
        // White, as far as eight bits tell.
        CHECK(kBrightest * std::pow(points[i].look[0] / 255.0, 2) == Approx(1.0).epsilon(0.01));
    }
    CHECK(packed.ribbon_area == Approx(0.006));
}

TEST_CASE("packed strands: points that are not finite split a strand; one point is no hair") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Vec3 bad(0, nan, 0);
    const auto at = [](double x) { return Vec3(x, 0, 0); };
    const Strands strands =
        test::strands_of({{at(0)}, {at(0), at(1), bad, at(2), at(3)}, {bad, bad}, {bad, at(1)}});
    const PackedStrands packed = pack_strands(drawn(strands));
    CHECK(packed.all.size() == 4);
    for (const PackedPoint& p : packed.all.points) CHECK(std::isfinite(p.position[1]));
    // Strand 1 in two pieces of two points, and what is left of the last.
    CHECK(packed.all.points.size() == 4 + 4 + 3);
    CHECK(packed.all.shifts.size() == packed.all.points.size());
    CHECK(pack_strands(drawn(Strands())).all.size() == 0);
    CHECK(pack_strands(drawn(test::strands_of({{at(0)}}))).all.points.empty());
}

TEST_CASE(
    "packed strands: few points are there of few strands, and no others where none are asked") {
    const Strands strands = sorted_strands(kFewStrands + 100);
    PackedStrands packed = pack_strands(drawn(strands), true);
    CHECK(packed.few.size() == kFewStrands);
    CHECK(packed.all.size() == 0);
    packed = pack_strands(drawn(strands));
    CHECK(packed.all.size() == strands.size());
    // The first of all are the same strands.
    for (Index i = 0; i < 100; ++i) {
        CHECK(packed.few.points[at(packed.few.offsets[at(i)])] ==
              packed.all.points[at(packed.all.offsets[at(i)])]);
    }
    const std::vector<Vec3> line = [] {
        std::vector<Vec3> points;
        for (int i = 0; i < 100; ++i) points.emplace_back(0.01 * i, 0.0, 0.0);
        return points;
    }();
    packed = pack_strands(drawn(test::strands_of({line})));
    CHECK(packed.few.points.size() == kFewPoints + 2);
    CHECK(packed.few.points.back().position == packed.all.points.back().position);
}

TEST_CASE("packed strands: the fewer the wider, never more than they are fewer") {
    PackedStrands packed;
    packed.outer_area = 1.0;
    for (const double layers : {0.1, 6.0, 30.0}) {
        packed.ribbon_area = layers;
        double before = 1e9;
        for (const Index count : {10, 100, 250, 500, 999, 1000}) {
            const double wider = widening(packed, count, 1000);
            CHECK(wider >= 1.0);
            CHECK(wider <= 1000.0 / count * (1 + 1e-12));
            CHECK(wider <= before);
            before = wider;
        }
        CHECK(widening(packed, 1000, 1000) == 1.0);
        // As opaque as is needed, or as the hair is.
        CHECK(widening(packed, 10, 1000) * 10 / 1000 * layers == Approx(std::min(layers, 6.0)));
    }
    CHECK(widening({}, 0, 0) == 1.0);
}
