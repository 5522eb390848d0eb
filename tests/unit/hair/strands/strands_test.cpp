#include "tests/unit/hair/strands/strand_support.h"

using namespace lissom;
using namespace lissom::test;

TEST_CASE("strands: all that they hold counts as memory") {
    const Strands rich = rich_hair(50);
    Strands strands = random_hair(50);
    std::size_t least = strands.memory_bytes();
    const auto check_grown = [&](std::size_t by) {
        least += by;
        CHECK(strands.memory_bytes() >= least);
        least = strands.memory_bytes();
    };
    strands.set_ids(rich.ids());
    check_grown(50 * sizeof(std::uint32_t));
    strands.set_colors(*rich.colors());
    check_grown(static_cast<std::size_t>(rich.point_count()) * sizeof(Eigen::Vector3f));
    strands.set_widths(rich.widths());
    check_grown(50 * sizeof(float));
    strands.set_roots(rich.roots());
    check_grown(50 * (sizeof(Index) + 5 * sizeof(float)));
    strands.set_groups(rich.groups(), rich.group_names());
    check_grown(50 * sizeof(Index));
    strands.set_transparency({0.0f, StrandDomain::strand, std::vector<float>(50, 0.5f)});
    check_grown(50 * sizeof(float));
}

TEST_CASE("strands show their points without a copy") {
    Strands strands =
        strands_of({{{0, 0, 0}, {0, 1, 0}}, {{1, 0, 0}}, {{2, 0, 0}, {2, 1, 0}, {2, 2, 0}}});
    CHECK(strands.size() == 3);
    CHECK(strands.point_count() == 6);
    CHECK(strands.point_count(1) == 1);
    CHECK(strands.strand(2).cols() == 3);
    CHECK(strands.strand(2).data() == strands.points().data() + 9);
    strands.edit_strand(0).col(1) = Eigen::Vector3f(5, 6, 7);
    CHECK(strands.points()[4] == 6.0f);
    CHECK(strands.root(2) == Eigen::Vector3f(2, 0, 0));
}

TEST_CASE("no strands are valid") {
    const Strands strands;
    CHECK(strands.empty());
    CHECK(strands.point_count() == 0);
    CHECK(Strands({}, {0}).size() == 0);
}

TEST_CASE("points take 12 bytes each") {
    const Strands strands(std::vector<float>(3 * 10000), [] {
        std::vector<Index> offsets;
        for (Index s = 0; s <= 100; ++s) offsets.push_back(100 * s);
        return offsets;
    }());
    CHECK(strands.memory_bytes() <= 12 * 10000 + 8 * 101);
}

TEST_CASE("offsets that contradict the points are refused") {
    const std::vector<float> two(6, 0.0f);
    for (const std::vector<Index>& offsets : std::vector<std::vector<Index>>{
             {}, {0}, {1, 2}, {0, 1}, {0, 3}, {0, 0, 2}, {0, 2, 1, 2}, {0, -1, 2}}) {
        CAPTURE(offsets.size());
        CHECK(error_of([&] { Strands(two, offsets); }).code() == ErrorCode::invalid_argument);
    }
    CHECK(error_of([&] { Strands({1, 2}, {0, 1}); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("lists must fit the strands") {
    Strands strands = random_hair(4);
    const auto refused = [](const auto& action) {
        return error_of(action).code() == ErrorCode::invalid_argument;
    };
    CHECK(refused([&] { strands.set_ids({1, 2}); }));
    CHECK(refused([&] { strands.set_groups({0, 0, 0, 1}, {"one"}); }));
    CHECK(refused([&] { strands.set_groups({0, 0, 0, -2}, {"one"}); }));
    CHECK(refused([&] { strands.set_roots({{1, 2, 3, 4}, {}, {}}); }));
    StrandWidths widths;
    widths.domain = StrandDomain::point;
    widths.values = {1, 2, 3, 4};
    CHECK(refused([&] { strands.set_widths(widths); }));
    CHECK(strands.widths().domain == StrandDomain::all);
}

TEST_CASE("the profile is linear between its factors") {
    StrandWidths widths;
    CHECK(widths.factor(0.3) == 1.0f);
    widths.profile = {1.0f, 0.5f, 0.0f};
    CHECK(widths.factor(0.0) == 1.0f);
    CHECK(widths.factor(0.25) == 0.75f);
    CHECK(widths.factor(1.0) == 0.0f);
    CHECK(widths.factor(2.0) == 0.0f);
    widths.profile = {0.5f};
    CHECK(widths.factor(0.7) == 0.5f);
}

TEST_CASE("released memory can be used again") {
    Strands strands = random_hair(10);
    const float* const memory = strands.points().data();
    std::vector<float> points;
    std::vector<Index> offsets;
    strands.release(points, offsets);
    CHECK(strands.empty());
    CHECK(points.data() == memory);
    CHECK(Strands(std::move(points), std::move(offsets)).size() == 10);
}
