#include "kernel/hair/guides/guide_set.h"

#include <doctest/doctest.h>

#include <set>
#include <vector>

#include "kernel/hair/guides/strand_clusters.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_guides.h"
#include "kernel/hair/strands/strand_measures.h"
#include "tests/unit/hair/hair_support.h"
#include "tests/unit/hair/strands/strand_support.h"

namespace lissom::test {
namespace {

// Strands on a square of 10 cm, combed to both sides of a parting at x = 0, 10 cm long.
Strands parted(Index count) {
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < count; ++s) {
        const double x = std::fmod(0.618034 * s + 0.05, 1.0) - 0.5,
                     z = std::fmod(0.754878 * s, 1.0);
        const double side = x < 0.0 ? -1.0 : 1.0;
        std::vector<Vec3> points;
        for (int k = 0; k < 9; ++k) {
            const double a = 0.1 * k / 8;
            points.push_back(Vec3(0.1 * x + side * a, -3.0 * a * a, 0.1 * z + 0.2 * a * x));
        }
        lists.push_back(points);
    }
    return strands_of(lists);
}

double error_of(const Strands& hair, Index guides) {
    return make_guide_set(hair, {.count = guides}).error.rms;
}

TEST_CASE("guide set: strands that are guides follow themselves alone, and exactly") {
    const Strands hair = parted(200);
    const GuideSet set = make_guide_set(hair, {.count = 12, .points = 9});
    REQUIRE(set.guide_count() == 12);
    for (Index g = 0; g < set.guide_count(); ++g) {
        const GuidedStrand& strand = set.guided[at(set.strands[at(g)])];
        CHECK(strand.guides[0] == static_cast<std::uint32_t>(g));
        CHECK(strand.weights[0] == doctest::Approx(1.0f).epsilon(1e-4));
        CHECK(strand.length == doctest::Approx(1.0f).epsilon(1e-4));
    }
}

TEST_CASE("guide set: weights are positive and sum to one") {
    const GuideSet set = make_guide_set(parted(300), {.count = 20});
    for (const GuidedStrand& strand : set.guided) {
        float sum = 0.0f;
        for (const float weight : strand.weights) {
            CHECK(weight >= 0.0f);
            sum += weight;
        }
        CHECK(sum == doctest::Approx(1.0f).epsilon(1e-5));
        CHECK(strand.weights[0] >= strand.weights[1]);
        CHECK(strand.weights[1] >= strand.weights[2]);
    }
}

TEST_CASE("guide set: more guides are nearer, and details are exact") {
    const Strands hair = parted(400);
    const double few = error_of(hair, 4), more = error_of(hair, 40);
    CHECK(more < few);
    const GuideSet set = make_guide_set(hair, {.count = 8, .points = 9});
    CHECK(set.error.max >= set.error.rms);
    const auto made = rebuild_strands(set);
    double off = 0.0;
    for (Index s = 0; s < hair.size(); ++s) {
        const double length_of = length(hair.strand(s));
        CHECK((made[at(9 * s)] - hair.root(s)).norm() < 1e-6f);
        CHECK((made[at(9 * s + 8)].cast<double>() - point_of(hair.strand(s), 8)).norm() <
              1e-4 * length_of);
        off = std::max(off, double{(made[at(9 * s + 8)] - hair.strand(s).col(8)).norm()});
    }
    CHECK(off < 2.0 * set.detail_step + 1e-6);
}

TEST_CASE("guide set: no strand follows a guide across the parting") {
    const Strands hair = parted(400);
    const GuideSet set = make_guide_set(hair, {.count = 30});
    for (Index s = 0; s < hair.size(); ++s) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (set.guided[at(s)].weights[i] < 0.02f) continue;
            const Index guide = set.strands[set.guided[at(s)].guides[i]];
            CHECK(hair.root(s).x() * hair.root(guide).x() > 0.0f);
        }
    }
}

TEST_CASE("guide set: moved guides take strands along") {
    const GuideSet set = make_guide_set(parted(100), {.count = 6});
    std::vector<Eigen::Vector3f> moved = set.curves;
    const Eigen::Vector3f by(0.1f, -0.2f, 0.3f);
    for (Eigen::Vector3f& p : moved) p += by;
    const auto rest = rebuild_strands(set), made = rebuild_strands(set, {.curves = moved});
    for (std::size_t i = 0; i < rest.size(); ++i) CHECK((made[i] - rest[i] - by).norm() < 1e-6f);
}

TEST_CASE("guide set: guides that turn take the details along, as lissom_hair.h does") {
    const GuideSet set = make_guide_set(parted(100), {.count = 6});
    const Affine turn = rotation(Vec3(1.0, 0.5, -0.3), 0.9, Vec3::Zero());
    std::vector<Eigen::Vector3f> moved;
    for (const Eigen::Vector3f& p : set.curves) {
        moved.push_back(turn(p.cast<double>()).cast<float>());
    }
    const auto rest = rebuild_strands(set), made = rebuild_strands(set, {.curves = moved});
    float off = 0.0f, still = 0.0f;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const std::size_t root = i - i % 16;
        const Eigen::Vector3f way = turn.linear.cast<float>() * (rest[i] - rest[root]);
        off = std::max(off, (made[i] - made[root] - way).norm());
        still = std::max(still, (rest[i] - rest[root] - way).norm());
    }
    // A turn about the guide itself is not known from its places.
    CHECK(off < 0.1f * still);
}

TEST_CASE("guide set: of groups and of locks there is one each") {
    Strands hair = parted(90);
    std::vector<Index> groups;
    for (Index s = 0; s < 90; ++s) groups.push_back(s % 3);
    CHECK_THROWS_AS(make_guide_set(hair, {.of = GuideChoice::groups}), Error);
    CHECK_THROWS_AS(make_guide_set(hair, {.of = GuideChoice::locks}), Error);
    hair.set_groups(groups, {"a", "b", "c"});
    const GuideSet of_groups = make_guide_set(hair, {.of = GuideChoice::groups});
    REQUIRE(of_groups.guide_count() == 3);
    for (Index s = 0; s < 90; ++s) {
        CHECK(hair.group(of_groups.strands[of_groups.guided[at(s)].guides[0]]) == s % 3);
    }
    assign_guides(hair, {.count = 12});
    CHECK(make_guide_set(hair, {.of = GuideChoice::locks}).guide_count() == 12);
}

TEST_CASE("guide set: threads do not matter, bad input is refused") {
    const Strands hair = parted(500);
    ContextOptions two;
    two.threads = 2;
    const GuideSet a = make_guide_set(hair, {.count = 25}),
                   b = make_guide_set(hair, {.count = 25}, Context(two));
    CHECK(a.strands == b.strands);
    CHECK(a.details == b.details);
    CHECK_THROWS_AS(make_guide_set(hair, {.count = 0}), Error);
    CHECK_THROWS_AS(make_guide_set(hair, {.points = 1}), Error);
    CHECK_THROWS_AS(make_guide_set({}, {}), Error);
    CHECK_THROWS_AS(make_guide_set(parted(1), {.count = 3}), Error);
    CHECK_THROWS_AS(make_guide_set(parted(2)), Error);
    for (const Index few : {1, 2}) CHECK_THROWS_AS(make_guide_set(hair, {.count = few}), Error);
    CHECK(make_guide_set(parted(3), {.count = 1000}).guide_count() == 3);
    Strands bad = parted(5);
    bad.edit_points()[7] = std::numeric_limits<float>::quiet_NaN();
    try {
        make_guide_set(bad);
        FAIL("NaN was taken");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::not_finite);
    }
    // A strand without length is its root.
    Strands bald({0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 1, 2, 1, 1, 2, 2, 1, 3, 1, 1, 3, 2, 1},
                 {0, 2, 4, 6, 8});
    const GuideSet one = make_guide_set(bald, {.points = 4});
    CHECK(one.guided[0].length == 0.0f);
    CHECK(rebuild_strands(one)[3].norm() == 0.0f);
}

TEST_CASE("strand clusters: locks stay together, groups apart") {
    Strands hair = parted(300);
    assign_guides(hair, {.count = 40});
    const StrandClusters clusters = cluster_strands(hair, {.count = 10, .unit = ClusterUnit::lock});
    CHECK(clusters.medoids.size() == 10);
    const std::vector<Index> guides = present_guides(hair);
    for (Index s = 0; s < hair.size(); ++s) {
        CHECK(clusters.of_strand[at(s)] == clusters.of_strand[at(guides[at(s)])]);
    }
    const std::set<Index> used(clusters.of_strand.begin(), clusters.of_strand.end());
    CHECK(used.size() == 10);
    for (Index c = 0; c < 10; ++c) CHECK(clusters.of_strand[at(clusters.medoids[at(c)])] == c);
}

}  // namespace
}  // namespace lissom::test
