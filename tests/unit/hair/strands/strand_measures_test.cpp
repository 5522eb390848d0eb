#include "kernel/hair/strands/strand_edit.h"
#include "tests/unit/hair/strands/strand_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("lengths and turns of known strands") {
    const Strands strands = strands_of({{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                                        {{0, 0, 0}, {0, 2, 0}, {0, 2, 0}, {0, 4, 0}},
                                        {{0, 0, 0}, {0, 1, 0}, {0, 0.5, 0}}});
    const StrandStatistics found = strand_statistics(strands);
    CHECK(found.strands == 3);
    CHECK(found.points == 10);
    CHECK(found.min_points == 3);
    CHECK(found.max_points == 4);
    CHECK(found.min_length == doctest::Approx(1.5));
    CHECK(found.max_length == doctest::Approx(4.0));
    CHECK(found.mean_length == doctest::Approx(7.5 / 3));
    CHECK(found.max_turn == doctest::Approx(kPi));
    CHECK(found.max_turn_strand == 2);
    CHECK(found.sharp == 1);
    CHECK(found.zero_segments == 1);
    CHECK(found.zero_length == 0);
    CHECK(found.not_finite == 0);
}

TEST_CASE("strands that are damaged are counted and spoil nothing else") {
    const Strands strands =
        strands_of({{{0, 0, 0}, {0, 1, 0}}, {{0, kNan, 0}, {0, 1, 0}}, {{3, 3, 3}}});
    const StrandStatistics found = strand_statistics(strands);
    CHECK(found.not_finite == 1);
    CHECK(found.zero_length == 1);
    CHECK(found.min_length == 0.0);
    CHECK(found.mean_length == doctest::Approx(0.5));
    CHECK(bounds(strands).max == Vec3(3, 3, 3));
    CHECK(bounds(strands).min == Vec3(0, 0, 0));
}

TEST_CASE("penetration is measured by the distance that is given") {
    const Strands strands = strands_of({{{0, 1, 0}, {0, -0.5, 0}}, {{0, 1, 0}, {0, 2, 0}}});
    StrandStatisticsOptions options;
    options.distance = [](const Vec3& p) { return p.y(); };
    CHECK(strand_statistics(strands, options).penetrating == 1);
    CHECK(strand_statistics(strands, options).deepest == doctest::Approx(0.5));
    options.depth = 0.6;
    CHECK(strand_statistics(strands, options).penetrating == 0);
}

TEST_CASE("statistics do not depend on the number of threads") {
    const Strands strands = random_hair(2000);
    const StrandStatistics one = strand_statistics(strands, {}, threads(1));
    const StrandStatistics many = strand_statistics(strands, {}, threads(4));
    CHECK(one.mean_length == many.mean_length);
    CHECK(one.max_turn_strand == many.max_turn_strand);
}

TEST_CASE("statistics of no strands are zero") {
    CHECK(strand_statistics({}).strands == 0);
    CHECK(strand_statistics({}).mean_length == 0.0);
    CHECK(bounds(Strands()).empty());
}

TEST_CASE("arc length fractions run from 0 to 1, also without length") {
    std::vector<double> t;
    arc_fractions(strands_of({{{0, 0, 0}, {0, 1, 0}, {0, 4, 0}}}).strand(0), t);
    CHECK(t == std::vector<double>{0.0, 0.25, 1.0});
    arc_fractions(strands_of({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}).strand(0), t);
    CHECK(t == std::vector<double>{0.0, 0.5, 1.0});
    arc_fractions(strands_of({{{1, 1, 1}}}).strand(0), t);
    CHECK(t == std::vector<double>{0.0});
}

TEST_CASE("widths at the points hold the profile") {
    Strands strands = strands_of({{{0, 0, 0}, {0, 1, 0}, {0, 4, 0}}});
    StrandWidths widths;
    widths.common = 2.0f;
    widths.profile = {1.0f, 0.0f};
    strands.set_widths(widths);
    std::vector<float> found;
    widths_of(strands, 0, found);
    CHECK(found == std::vector<float>{2.0f, 1.5f, 0.0f});
}

TEST_CASE("the hash tells every difference") {
    const Strands strands = rich_hair(20);
    const std::uint64_t whole = hash(strands);
    CHECK(hash(rich_hair(20)) == whole);
    CHECK(hash(prefix(strands, 19)) != whole);
    const auto differs = [&](const auto& change) {
        Strands other = strands;
        change(other);
        return hash(other) != whole;
    };
    CHECK(differs([](Strands& s) { s.edit_points()[10] += 1e-6f; }));
    CHECK(differs([](Strands& s) { s.set_ids({}); }));
    CHECK(differs([](Strands& s) { s.set_groups({}, {}); }));
    CHECK(differs([](Strands& s) { s.set_widths({}); }));
    CHECK(differs([](Strands& s) { s.set_comment(""); }));
    CHECK(differs([](Strands& s) { s.set_roots({}); }));
}
