#include "viewer/window/screen/fill.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using namespace lissom;
using namespace lissom::window;

namespace {

// Draws slices until none is left; `cost` seconds a strand, by their number so far.
template <typename Cost>
std::vector<Slice> run(Fill& fill, StrandPace& pace, const Cost& cost, double& longest) {
    std::vector<Slice> slices;
    while (const auto slice = fill.next(pace)) {
        double seconds = 0.0;
        for (Index s = slice->begin; s < slice->end; ++s) seconds += cost(s);
        longest = std::max(longest, seconds);
        pace.add(slice->end - slice->begin, seconds);
        fill.drawn();
        slices.push_back(*slice);
        if (slices.size() > 10000) break;
    }
    return slices;
}

}  // namespace

TEST_CASE("fill: slices follow each other, picture after picture, until all strands are drawn") {
    StrandPace pace(0.020);
    Fill fill(100000, 800, 60.0);
    double longest = 0.0;
    const auto slices = run(
        fill, pace, [](Index) { return 30e-6; }, longest);
    Index begin = 0, pictures = 0, of = 0;
    for (const Slice& slice : slices) {
        CHECK(slice.begin == begin);
        CHECK(slice.end > slice.begin);
        CHECK((slice.is_first() || slice.of == of));
        of = slice.of;
        begin = slice.is_last() ? 0 : slice.end;
        pictures += slice.is_last() ? 1 : 0;
    }
    CHECK(of == 100000);
    CHECK(begin == 0);
    CHECK(pictures >= 2);
    CHECK(pictures <= 5);
    CHECK(slices.front().end == 300);
}

TEST_CASE("fill: no slice is longer than 30 ms, by what it measures") {
    // Of strands that cost alike, that become dearer, and that differ at random.
    const auto even = [](Index) { return 80e-6; };
    const auto dearer = [](Index s) { return 20e-6 + 1e-9 * s; };
    const auto mixed = [](Index s) { return 40e-6 * (1.0 + 0.4 * std::sin(0.01 * s)); };
    for (int kind = 0; kind < 3; ++kind) {
        StrandPace pace(0.020);
        Fill fill(60000, 500, 60.0);
        double longest = 0.0;
        const auto slices = kind == 0   ? run(fill, pace, even, longest)
                            : kind == 1 ? run(fill, pace, dearer, longest)
                                        : run(fill, pace, mixed, longest);
        CHECK(longest <= 0.030);
        CHECK(slices.size() > 20);
    }
}

TEST_CASE("fill: a slow slice makes the next one short at once") {
    StrandPace pace(0.020);
    for (int i = 0; i < 10; ++i) pace.add(pace.count(), 1e-5 * pace.count());
    CHECK(pace.count() == 2000);
    pace.add(2000, 0.1);
    CHECK(pace.count() == 400);
    pace.add(400, 10.0);
    CHECK(pace.count() == 25);
    pace.add(0, 0.0);
    CHECK(pace.count() == 25);
}

TEST_CASE("fill: a fast driver draws all strands in a few slices") {
    StrandPace pace(0.020);
    Fill fill(100000, 1000, 3.0);
    double longest = 0.0, all = 0.0;
    const auto cost = [&](Index) {
        all += 0.3e-6;
        return 0.3e-6;
    };
    const auto slices = run(fill, pace, cost, longest);
    CHECK(slices.back().of == 100000);
    CHECK(slices.size() < 15);
    CHECK(all < 0.1);
    // The next time it knows.
    Fill again(100000, 1000, 3.0);
    CHECK(run(again, pace, cost, longest).size() <= 3);
}

TEST_CASE("fill: where all strands take too long the last picture has as many as do not") {
    StrandPace pace(0.020);
    Fill fill(1000000, 800, 3.0);
    double longest = 0.0;
    const auto slices = run(
        fill, pace, [](Index) { return 50e-6; }, longest);
    REQUIRE(!slices.empty());
    CHECK(slices.back().is_last());
    CHECK(slices.back().of <= 61000);
    CHECK(slices.back().of >= 30000);
}

TEST_CASE("fill: a first slice of few strands leaves time for what is prepared with it") {
    const double preparing = 0.024, each = 50e-6;
    for (const Index first : {25, 300}) {
        bool prepared = false;
        StrandPace pace(0.014, first);
        Fill fill(20000, 800, 60.0);
        double longest = 0.0;
        const auto slices = run(
            fill, pace,
            [&](Index) { return std::exchange(prepared, true) ? each : each + preparing; },
            longest);
        CHECK(slices.front().end == first);
        CHECK(slices.back().end == 20000);
        CHECK((longest < 0.030) == (first == 25));
    }
}

TEST_CASE("fill: nothing is drawn where all is seen, and one strand where there is one") {
    StrandPace pace(0.020);
    CHECK_FALSE(Fill(0, 0, 1.0).next(pace));
    // What moved has no smooth edges.
    CHECK(Fill(500, 500, 1.0).next(pace)->of == 500);
    StrandPace slow(0.020);
    slow.add(100, 10.0);
    CHECK(Fill(100000, 800, 1.0).next(slow)->of == 4000);
    Fill one(1, 0, 1.0);
    const auto slice = one.next(pace);
    REQUIRE(slice);
    CHECK(slice->end == 1);
    CHECK(slice->is_last());
    one.drawn();
    CHECK_FALSE(one.next(pace));
}
