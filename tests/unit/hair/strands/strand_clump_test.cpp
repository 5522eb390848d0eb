#include "kernel/hair/strands/strand_clump.h"

#include <Eigen/Geometry>

#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_guides.h"
#include "tests/unit/hair/strands/strand_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Strands clumped(Strands strands, const ClumpOptions& options) {
    clump(strands, options);
    return strands;
}

// One guide with everything but the pull itself turned off.
ClumpOptions full_pull() {
    ClumpOptions options;
    options.clumps = 1;
    options.strength = 1.0;
    options.variation = 0.0;
    options.tip_spread = 0.0;
    options.radius = std::numeric_limits<double>::infinity();
    options.keep_length = false;
    return options;
}

double spread_of_tips(const Strands& strands) {
    Box box;
    for (Index s = 0; s < strands.size(); ++s) {
        box.extend(strands.strand(s).col(strands.point_count(s) - 1).cast<double>());
    }
    return box.diagonal();
}

}  // namespace

TEST_CASE("at full strength all tips meet that of the guide, and the guide stays") {
    const Strands strands = random_hair(50);
    const Strands made = clumped(strands, full_pull());
    CHECK(spread_of_tips(made) < 1e-6);
    CHECK((made.strand(0) - strands.strand(0)).norm() < 1e-6);
}

TEST_CASE("the tip spreads by what is asked") {
    ClumpOptions options = full_pull();
    options.tip_spread = 0.01;
    const double spread = spread_of_tips(clumped(random_hair(300), options));
    CHECK(spread > 0.02);
    CHECK(spread < 0.035);
}

TEST_CASE("a copy of the guide beside it stays parallel where the pull begins") {
    std::vector<Vec3> guide, copy;
    for (int k = 0; k <= 50; ++k) {
        guide.emplace_back(0.05 * std::sin(0.05 * k), 0.004 * k, 0.02 * std::cos(0.1 * k));
        copy.push_back(guide.back() + Vec3(0.01, 0, 0));
    }
    ClumpOptions options = full_pull();
    options.shape = 8.0;
    const Strands strands = strands_of({guide, copy});
    const Strands made = clumped(strands, options);
    CHECK((made.strand(1).leftCols(10) - strands.strand(1).leftCols(10)).norm() < 1e-5);
}

TEST_CASE("a point moves by what is asked, for every shape, strength and distance of roots") {
    // Around a straight guide the frame is the same everywhere.
    std::vector<std::vector<Vec3>> lists(1);
    for (int k = 0; k <= 10; ++k) lists[0].emplace_back(0.0, 0.02 * k, 0.0);
    for (int s = 1; s <= 8; ++s) {
        std::vector<Vec3> points;
        for (int k = 0; k <= 10; ++k)
            points.emplace_back(0.01 * s + 0.003 * k, 0.02 * k, -0.004 * k);
        lists.push_back(points);
    }
    const Strands strands = strands_of(lists);
    ClumpOptions options = full_pull();
    options.radius = 0.1;
    for (const double shape : {0.5, 1.0, 3.0}) {
        for (const double strength : {0.25, 1.0}) {
            options.shape = shape;
            options.strength = strength;
            const Strands made = clumped(strands, options);
            for (Index s = 1; s <= 8; ++s) {
                // Level at the guide and at the radius, half in between.
                const double d = 0.1 * s;
                const double pull = strength * (1.0 - d * d * (3.0 - 2.0 * d));
                for (Index k = 0; k <= 10; ++k) {
                    const double along = std::pow(0.1 * k, shape);
                    const Vec3 p = strands.strand(s).col(k).cast<double>();
                    const Vec3 goal(0.01 * s * (1.0 - along), 0.02 * k, 0.0);
                    const Vec3 wanted = p + along * pull * (goal - p);
                    CHECK((made.strand(s).col(k).cast<double>() - wanted).norm() < 1e-6);
                }
            }
        }
    }
}

TEST_CASE("clumps differ in strength by the variation, and move as wholes by the offset") {
    // Pairs far from each other: a guide and a strand beside it that leans away from it.
    std::vector<std::vector<Vec3>> lists;
    for (int s = 0; s < 200; ++s) lists.push_back({Vec3(s, 0, 0), Vec3(s, 0.2, 0)});
    for (int s = 0; s < 200; ++s)
        lists.push_back({Vec3(s + 0.001, 0, 0), Vec3(s + 0.001, 0.2, 0.1)});
    const Strands strands = strands_of(lists);
    ClumpOptions options = full_pull();
    options.clumps = 200;
    options.strength = 0.4;
    options.variation = 0.5;
    Strands made = clumped(strands, options);
    double least = 1.0, most = 0.0, sum = 0.0;
    for (Index s = 200; s < 400; ++s) {
        const double pull = 1.0 - made.strand(s)(2, 1) / 0.1;
        least = std::min(least, pull);
        most = std::max(most, pull);
        sum += pull / 200.0;
    }
    CHECK(least == doctest::Approx(0.2).epsilon(0.05));
    CHECK(most == doctest::Approx(0.6).epsilon(0.05));
    CHECK(sum == doctest::Approx(0.4).epsilon(0.05));
    options.strength = 1.0;
    options.variation = 0.0;
    options.offset = 0.02;
    made = clumped(strands, options);
    double farthest = 0.0;
    for (Index s = 0; s < 200; ++s) {
        const Eigen::Vector3f moved = made.strand(s).col(1) - strands.strand(s).col(1);
        CHECK((made.strand(s + 200).col(1) - made.strand(s).col(1)).norm() < 1e-4);
        farthest = std::max(farthest, double(moved.norm()));
    }
    CHECK(farthest > 0.015);
    CHECK(farthest < 0.035);
}

TEST_CASE("strands beyond the radius and of other groups stay") {
    Strands strands = strands_of({{{0, 0, 0}, {0, 1, 0}},
                                  {{0.02, 0, 0}, {0.1, 1, 0}},
                                  {{0.5, 0, 0}, {0.6, 1, 0}},
                                  {{0.02, 0, 0.01}, {0.1, 1, 0}}});
    strands.set_groups({0, 0, 0, 1}, {"left", "right"});
    ClumpOptions options = full_pull();
    options.radius = 0.1;
    const Strands made = clumped(strands, options);
    CHECK(!same_points(made.strand(1), strands.strand(1)));
    CHECK(same_points(made.strand(2), strands.strand(2)));
    CHECK(same_points(made.strand(3), strands.strand(3)));
    options.within_groups = false;
    CHECK(!same_points(clumped(strands, options).strand(3), strands.strand(3)));
}

TEST_CASE("strands gather with those of their side of a parting") {
    // Guides at x = 1 mm and -4 mm, combed to the right and to the left; a strand at -1 mm.
    const auto combed = [](double x, double side) {
        return std::vector<Vec3>{{x, 0, 0}, {x + side * 0.05, 0.02, 0}, {x + side * 0.1, -0.05, 0}};
    };
    const Strands strands = strands_of({combed(0.001, 1), combed(-0.004, -1), combed(-0.001, -1)});
    ClumpOptions options = full_pull();
    options.clumps = 2;
    options.radius = 0.03;
    const Strands made = clumped(strands, options);
    CHECK((made.strand(2) - strands.strand(2)).norm() < 0.01);
    options.apart = 0.0;
    CHECK((clumped(strands, options).strand(2) - strands.strand(2)).norm() > 0.05);
}

TEST_CASE("lengths are kept where asked") {
    ClumpOptions options;
    options.clumps = 10;
    options.radius = 0.2;
    const Strands strands = random_hair(100), made = clumped(strands, options);
    for (Index s = 0; s < strands.size(); ++s) {
        CHECK(length(made.strand(s)) == doctest::Approx(length(strands.strand(s))).epsilon(1e-5));
    }
}

TEST_CASE("the frame of a guide is orthonormal and turns as little as it can") {
    // A closed turn in a plane must bring the normal that stands on the plane back.
    std::vector<Vec3> circle;
    for (int k = 0; k <= 100; ++k) {
        circle.emplace_back(std::cos(0.02 * kPi * k), std::sin(0.02 * kPi * k), 0.0);
    }
    const GuideCurve guide(strands_of({circle}).strand(0));
    const double along = guide.at(0.0).frame.col(0).z();
    for (double t = 0.0; t <= 1.0; t += 0.05) {
        const Mat3 frame = guide.at(t).frame;
        CHECK((frame.transpose() * frame - Mat3::Identity()).norm() < 1e-6);
        CHECK(frame.determinant() == doctest::Approx(1.0));
        CHECK(frame.col(0).z() == doctest::Approx(along).epsilon(1e-6));
    }
}

TEST_CASE("a guide's key is its root, and how far its middle is from there") {
    for (const double apart : {0.0, 0.5, 2.0}) {
        // Straight strands with points at uneven places.
        const Strands strands = strands_of(
            {{{1, 2, 3}, {1.125, 2, 3}, {1.25, 2, 3}, {5, 2, 3}}, {{4, 5, 6}, {4, 9, 6}}});
        GuideKey first, second;
        first << 1, 2, 3, 2 * apart, 0, 0;
        second << 4, 5, 6, 0, 2 * apart, 0;
        CHECK((guide_key(strands.strand(0), apart) - first).norm() < 1e-6);
        CHECK((guide_key(strands.strand(1), apart) - second).norm() < 1e-6);
    }
}

TEST_CASE("the tree finds what a search of all keys finds") {
    std::vector<GuideKey> keys;
    const Strands strands = random_hair(300);
    for (Index s = 0; s < 200; ++s) keys.push_back(guide_key(strands.strand(s), 0.5));
    const GuideTree tree(keys);
    for (Index s = 0; s < 300; ++s) {
        const GuideKey key = guide_key(strands.strand(s), 0.5);
        Index best = 0;
        for (Index g = 1; g < 200; ++g) {
            const auto distance = [&](Index i) {
                return (keys[static_cast<std::size_t>(i)] - key).squaredNorm();
            };
            if (distance(g) < distance(best)) best = g;
        }
        CHECK(tree.nearest(key) == best);
    }
    CHECK(GuideTree({}).nearest(GuideKey::Zero()) == kNoIndex);
}

TEST_CASE("clump refuses options out of range") {
    Strands strands = random_hair(3);
    const auto refused = [&](const auto& change) {
        ClumpOptions options;
        change(options);
        return error_of([&] { clump(strands, options); }).code() == ErrorCode::invalid_argument;
    };
    CHECK(refused([](ClumpOptions& o) { o.clumps = -1; }));
    CHECK(refused([](ClumpOptions& o) { o.strength = 1.1; }));
    CHECK(refused([](ClumpOptions& o) { o.strength = -0.1; }));
    CHECK(refused([](ClumpOptions& o) { o.variation = 1.1; }));
    CHECK(refused([](ClumpOptions& o) { o.variation = -0.1; }));
    CHECK(refused([](ClumpOptions& o) { o.apart = -1.0; }));
    CHECK(refused([](ClumpOptions& o) { o.tip_spread = -1.0; }));
    CHECK(refused([](ClumpOptions& o) { o.radius = 0.0; }));
    CHECK(refused([](ClumpOptions& o) { o.shape = -1.0; }));
    CHECK(refused([](ClumpOptions& o) { o.offset = std::nan(""); }));
}

TEST_CASE("clump is seen at its defaults: tips come nearer to their guide by a third and more") {
    const Strands before = random_hair(7200);
    Strands made = before;
    clump(made);
    GuideOptions options;
    options.count = 900;
    const std::vector<Index> guides = nearest_guides(before, options);
    const auto apart = [&](const Strands& strands) {
        double sum = 0.0;
        for (Index s = 0; s < strands.size(); ++s) {
            const StrandView strand = strands.strand(s);
            const StrandView guide = strands.strand(guides[static_cast<std::size_t>(s)]);
            sum += double((strand.col(strand.cols() - 1) - guide.col(guide.cols() - 1)).norm());
        }
        return sum;
    };
    CHECK(apart(made) < 0.67 * apart(before));
}

TEST_CASE("clump without a number of its own takes the guides that strands have") {
    Strands strands = random_hair(200);
    GuideOptions three;
    three.count = 3;
    assign_guides(strands, three);
    ClumpOptions options = full_pull();
    options.clumps = 0;
    const Strands made = clumped(strands, options);
    for (Index s = 0; s < 200; ++s) {
        const std::uint32_t guide = strands.guides().ids[static_cast<std::size_t>(s)];
        REQUIRE(guide < 3);
        const StrandView a = made.strand(s), b = made.strand(static_cast<Index>(guide));
        CHECK((a.col(a.cols() - 1) - b.col(b.cols() - 1)).norm() < 1e-5f);
    }
    CHECK(made.guides() == strands.guides());
}

TEST_CASE("clump at its defaults is seen on few strands too") {
    for (const Index count : {400, 2000}) {
        const Strands strands = random_hair(count);
        Strands made = strands;
        clump(made);
        Index moved = 0;
        for (Index s = 0; s < count; ++s) {
            const Index tip = strands.point_count(s) - 1;
            if ((made.strand(s).col(tip) - strands.strand(s).col(tip)).norm() > 0.002f) ++moved;
        }
        CHECK(2 * moved > count);
    }
}
