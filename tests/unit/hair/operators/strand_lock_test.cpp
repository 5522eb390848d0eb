// Guides, and the operators that work on locks: gather, twist, pinch, curl, frizz.
#include <cmath>

#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_guides.h"
#include "kernel/hair/strands/strand_resample.h"
#include "kernel/hair/strands/strand_trim.h"
#include "tests/unit/hair/operators/operator_scenes.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Upright strands of 0.2 metres with 41 points: a guide at the origin and others around it.
Strands tuft(Index count) {
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < count; ++s) {
        const double angle = 2.0 * kPi * s / count, away = s == 0 ? 0.0 : 0.01;
        std::vector<Vec3> points;
        for (int k = 0; k <= 40; ++k) {
            points.emplace_back(away * std::cos(angle), 0.005 * k, away * std::sin(angle));
        }
        lists.push_back(points);
    }
    return strands_of(lists);
}

double distance_to_axis(const Strands& strands, Index s, Index k) {
    const Vec3 p = strands.strand(s).col(k).cast<double>();
    return std::hypot(p.x(), p.z());
}

}  // namespace

TEST_CASE("guides stay with strands that are selected, joined, trimmed, scaled and copied") {
    Strands strands = rich_hair(60);
    GuideOptions options;
    options.count = 8;
    options.within_groups = false;
    assign_guides(strands, options);
    REQUIRE(strands.guides().ids.size() == 60);
    CHECK(strands.guides().ids[3] == strands.id(3));
    for (Index s = 0; s < 60; ++s) {
        const std::uint32_t guide = strands.guides().ids[static_cast<std::size_t>(s)];
        CHECK(guide >= 1000);
        CHECK(guide < 1008);
    }
    const Strands back = select(strands, [](Index s) { return s >= 30; });
    CHECK(back.guides().ids[0] == strands.guides().ids[30]);

    Strands both = strands;
    append(both, strands);
    CHECK(both.guides().ids[5] == strands.guides().ids[5]);
    const std::uint32_t old = strands.guides().ids[20];
    CHECK(both.guides().ids[80] == both.id(60 + static_cast<Index>(old - 1000)));

    StrandTrimOptions half;
    half.factor = 0.5;
    Strands cut = strands;
    trim(cut, half);
    CHECK(cut.guides().arcs[40] == doctest::Approx(0.5 * strands.guides().arcs[40]).epsilon(1e-3));

    Strands larger = strands;
    transform(larger, {2.0 * Mat3::Identity(), Vec3::Zero()});
    CHECK(larger.guides().arcs[7] == doctest::Approx(2.0 * strands.guides().arcs[7]));
    CHECK(hash(Strands(strands)) == hash(strands));
    CHECK(resample(strands, {.count = 9}).guides() == strands.guides());
}

TEST_CASE("lists of guides that do not fit the strands are refused") {
    Strands strands = random_hair(3);
    CHECK(error_of([&] {
              strands.set_guides({{0, 0}, {0.1f, 0.1f}});
          }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] {
              strands.set_guides({{0, 0, 0}, {0.1f}});
          }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] {
              strands.set_guides({{0, 0, 0}, {0.1f, -0.1f, 0.1f}});
          }).code() == ErrorCode::invalid_argument);
    CHECK(strands.guides().ids.empty());
}

TEST_CASE("gathered strands lie on their guide but for the spread, from the end of the ramp on") {
    Strands strands = tuft(30);
    GatherOptions options;
    options.guides = 1;
    options.ramp = 0.03;
    options.spread = 0.0;
    gather(strands, options);
    for (Index s = 1; s < 30; ++s) {
        CHECK(distance_to_axis(strands, s, 0) == doctest::Approx(0.01));
        CHECK(distance_to_axis(strands, s, 3) == doctest::Approx(0.005).epsilon(0.01));
        for (Index k = 6; k <= 40; ++k) CHECK(distance_to_axis(strands, s, k) < 1e-6);
    }
    options.guides = 0;
    options.spread = 0.002;
    Strands spread = tuft(30);
    assign_guides(spread, {.count = 1});
    gather(spread, options);
    double mean = 0.0;
    for (Index s = 1; s < 30; ++s) mean += distance_to_axis(spread, s, 40) / 29.0;
    CHECK(mean > 0.0015);
    CHECK(mean < 0.0035);
}

TEST_CASE("twisted strands turn about their guide at the same distance; the guide stays") {
    Strands strands = tuft(9);
    TwistOptions options;
    options.guides = 1;
    options.wavelength = 0.1;
    options.ramp = 0.0;
    twist(strands, options);
    for (Index s = 1; s < 9; ++s) {
        for (Index k = 0; k <= 40; ++k) {
            CHECK(distance_to_axis(strands, s, k) == doctest::Approx(0.01).epsilon(1e-3));
        }
        // A quarter of a turn at 25 mm.
        const Eigen::Vector3f root = strands.root(s), p = strands.strand(s).col(5);
        CHECK(std::abs(root.x() * p.x() + root.z() * p.z()) < 1e-6f);
    }
    CHECK(same_points(strands.strand(0), tuft(9).strand(0)));
}

TEST_CASE("pinched strands meet their guide at one place") {
    Strands strands = tuft(9);
    PinchOptions options;
    options.guides = 1;
    pinch(strands, options);
    CHECK(distance_to_axis(strands, 3, 20) < 1e-6);
    CHECK(distance_to_axis(strands, 3, 40) > 0.0099);
    CHECK(distance_to_axis(strands, 3, 2) > 0.0099);
}

TEST_CASE("a curl has the radius and the turns asked, with hair that keeps its length or not") {
    CurlOptions options;
    options.guides = 1;
    options.radius = 0.005;
    options.wavelength = 0.02;
    options.start = 0.0;
    options.ramp = 0.02;
    options.hang = options.variation = 0.0;
    options.keep_length = false;
    options.points_per_turn = 24;
    Strands free = tuft(1);
    curl(free, options);
    const StrandView long_curl = free.strand(0);
    for (Index k = 0; k < long_curl.cols(); ++k) {
        if (long_curl(1, k) > 0.021f)
            CHECK(distance_to_axis(free, 0, k) == doctest::Approx(0.005).epsilon(0.01));
    }
    // Half turns: changes of the sign of x along the whole.
    int crossings = 0;
    for (Index k = 1; k < long_curl.cols(); ++k) {
        if (long_curl(1, k) > 0.021f && long_curl(0, k) * long_curl(0, k - 1) < 0.0f) ++crossings;
    }
    CHECK(crossings >= 17);
    CHECK(crossings <= 19);
    CHECK(length(long_curl) > 1.6 * 0.2);

    options.keep_length = true;
    Strands kept = tuft(1);
    curl(kept, options);
    CHECK(length(kept.strand(0)) == doctest::Approx(0.2).epsilon(1e-4));
    // sqrt(1 + (2 pi .005 / .02)^2) = 1.862, but for the ramp.
    const double height = kept.strand(0)(1, kept.point_count(0) - 1);
    CHECK(height > 0.2 / 1.862 - 0.005);
    CHECK(height < 0.2 / 1.862 + 0.02);
}

TEST_CASE("strands of one guide curl together whatever their lengths are") {
    // Gathered to one line, then curled without a difference of phase.
    Strands strands = tuft(12);
    for (Index s = 1; s < 12; ++s)
        strands.edit_strand(s).row(1) *= 1.0f - 0.04f * static_cast<float>(s);
    assign_guides(strands, {.count = 1});
    GatherOptions tight;
    tight.ramp = 0.01;
    tight.spread = 0.0;
    gather(strands, tight);
    CurlOptions options;
    options.phase = 0.0;
    options.keep_length = false;
    options.ramp = 0.02;
    options.points_per_turn = 24;
    curl(strands, options);
    const StrandView guide = strands.strand(0);
    for (Index s = 1; s < 12; ++s) {
        const StrandView strand = strands.strand(s);
        for (Index k = 0; k < strand.cols(); ++k) {
            if (strand(1, k) < 0.03f) continue;
            double nearest = 1.0;
            for (Index g = 0; g < guide.cols(); ++g) {
                nearest = std::min(nearest, double((guide.col(g) - strand.col(k)).norm()));
            }
            CHECK(nearest < 0.0035);
        }
    }
}

TEST_CASE("neighbours on a head wave alike, towards the head or along it") {
    // Strands bent over a ball, in planes through its middle.
    std::vector<std::vector<Vec3>> lists;
    for (int s = 0; s < 24; ++s) {
        std::vector<Vec3> points;
        const double side = 0.02 * s;
        for (int k = 0; k <= 60; ++k) {
            const double angle = 0.3 + 0.025 * k;
            points.emplace_back(0.1 * std::sin(angle) * std::cos(side), 0.1 * std::cos(angle),
                                0.1 * std::sin(angle) * std::sin(side));
        }
        lists.push_back(points);
    }
    const Strands strands = strands_of(lists);
    CurlOptions options = wave_options();
    options.radius = 0.004;
    options.wavelength = 0.04;
    options.start = options.ramp = 0.01;
    options.variation = options.phase = options.points_per_turn = 0;
    options.hand = CurlHand::right;
    options.keep_length = false;
    options.guides = 24;
    options.depth = 0.0;
    Strands made = strands;
    curl(made, options);
    double highest = 0.0, apart = 0.0, swaying = 0.0;
    for (Index s = 0; s + 1 < made.size(); ++s) {
        const Vec3 across(-std::sin(0.02 * s), 0.0, std::cos(0.02 * s));
        const Vec3 next(-std::sin(0.02 * (s + 1)), 0.0, std::cos(0.02 * (s + 1)));
        for (Index k = 20; k < 60; ++k) {
            const Vec3 a = point_of(made.strand(s), k), b = point_of(made.strand(s + 1), k);
            highest = std::max(highest, std::abs(a.norm() - 0.1));
            swaying = std::max(swaying, std::abs(a.dot(across)));
            apart = std::max(apart, std::abs(a.dot(across) - b.dot(next)));
        }
    }
    CHECK(swaying > 0.0035);
    CHECK(apart < 0.0015);
    CHECK(highest < 0.0005);
}

TEST_CASE("strands whose turns begin with their way from a line have crests along it") {
    // Bowed strands in one plane, each rooted further along the way of the first.
    std::vector<std::vector<Vec3>> lists;
    for (int s = 0; s < 8; ++s) {
        std::vector<Vec3> points;
        for (int k = 0; k <= 80; ++k) {
            const double angle = 0.01 * (3 * s + k);
            points.emplace_back(0.2 * std::cos(angle), 0.2 * std::sin(angle), 0.0);
        }
        lists.push_back(points);
    }
    CurlOptions options = wave_options();
    options.radius = 0.003;
    options.wavelength = 0.05;
    options.start = options.ramp = 0.0;
    options.tip = 1.0;
    options.variation = options.phase = options.points_per_turn = 0;
    options.hand = CurlHand::right;
    options.keep_length = false;
    options.guides = 8;
    for (int s = 0; s < 8; ++s) options.begin.push_back(float(0.2 * 0.03 * s / 0.05));
    Strands made = strands_of(lists);
    curl(made, options);
    double apart = 0.0;
    for (Index s = 0; s + 1 < made.size(); ++s) {
        for (Index k = 10; k < 70; ++k) {
            const auto a = made.strand(s)(2, k + 3), b = made.strand(s + 1)(2, k);
            apart = std::max(apart, std::abs(double(a) - b));
        }
    }
    CHECK(apart < 0.0004);
    options.begin.pop_back();
    CHECK(error_of([&] { curl(made, options); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("hang draws turns out at the root and tightens them at the tip") {
    CurlOptions options;
    options.guides = 1;
    options.start = options.ramp = 0.0;
    options.variation = 0.0;
    options.keep_length = false;
    options.wavelength = 0.02;
    options.points_per_turn = 24;
    const auto crossings = [&](double hang, double from, double to) {
        options.hang = hang;
        Strands strands = tuft(1);
        curl(strands, options);
        const StrandView strand = strands.strand(0);
        int count = 0;
        for (Index k = 2; k < strand.cols(); ++k) {
            const bool there = strand(1, k) > from && strand(1, k) < to;
            if (there && strand(0, k) * strand(0, k - 1) < 0.0f) ++count;
        }
        return count;
    };
    CHECK(crossings(0.9, 0.15, 0.2) > crossings(0.9, 0.0, 0.05) + 1);
    CHECK(std::abs(crossings(0.0, 0.15, 0.2) - crossings(0.0, 0.0, 0.05)) <= 1);
}

TEST_CASE("frizz moves tips by about the amplitude, and some strands more") {
    const Strands before = random_hair(2000);
    Strands strands = before;
    FrizzOptions options;
    options.amplitude = 0.001;
    options.keep_length = false;
    options.flyaways = 0.05;
    frizz(strands, options);
    Index far = 0;
    double mean = 0.0;
    for (Index s = 0; s < strands.size(); ++s) {
        const Index tip = strands.point_count(s) - 1;
        const auto moved = double((strands.strand(s).col(tip) - before.strand(s).col(tip)).norm());
        mean += moved / strands.size();
        if (moved > 0.0028) ++far;
    }
    CHECK(mean > 0.0008);
    CHECK(mean < 0.0022);
    CHECK(far > 30);
    CHECK(far < 110);
}

TEST_CASE("operators of locks refuse options out of range, and guides are as before") {
    Strands strands = random_hair(5);
    const auto refused = [&](auto options, const auto& change, const auto& run) {
        change(options);
        return error_of([&] { run(strands, options, Context()); }).code() ==
               ErrorCode::invalid_argument;
    };
    CHECK(refused(
        GatherOptions(), [](auto& o) { o.ramp = -1.0; }, gather));
    CHECK(refused(
        GatherOptions(), [](auto& o) { o.spread = std::nan(""); }, gather));
    CHECK(refused(
        GatherOptions(), [](auto& o) { o.guides = -1; }, gather));
    CHECK(refused(
        TwistOptions(), [](auto& o) { o.wavelength = 0.0; }, twist));
    CHECK(refused(
        PinchOptions(), [](auto& o) { o.width = 0.0; }, pinch));
    CHECK(refused(
        CurlOptions(), [](auto& o) { o.wavelength = 0.0; }, curl));
    CHECK(refused(
        CurlOptions(), [](auto& o) { o.hang = 2.0; }, curl));
    CHECK(refused(
        CurlOptions(), [](auto& o) { o.phase = 1.5; }, curl));
    CHECK(refused(
        CurlOptions(), [](auto& o) { o.variation = 1.0; }, curl));
    CHECK(refused(
        FrizzOptions(), [](auto& o) { o.wavelength = 0.0; }, frizz));
    CHECK(refused(
        FrizzOptions(), [](auto& o) { o.flyaways = 2.0; }, frizz));
    CHECK(strands.guides().ids.empty());
}
