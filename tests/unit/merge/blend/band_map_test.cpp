// The map from coordinates beside a seam to places on the band.
#include "kernel/merge/blend/band_map.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace lissom;

namespace {

constexpr Index kAround = 17, kRows = 5;
constexpr double kMapWidth = 0.8;

// A strip of triangles around a seam, its vertices out of line; the map's vertices count from 100.
BandChart noisy_strip(SeamSide side) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> noise(-0.25, 0.25);
    BandChart chart;
    chart.side = side;
    for (Index row = 0; row < kRows; ++row) {
        for (Index k = 0; k < kAround; ++k) {
            const double angle = (k + 0.4 + noise(random)) / kAround;
            chart.vertex.push_back(100 + count_of(chart.vertex));
            chart.angle.push_back(angle - std::floor(angle));
            chart.distance.push_back(row == 0 ? 0.0 : 0.2 * (row + noise(random)));
        }
    }
    for (Index row = 0; row + 1 < kRows; ++row) {
        for (Index k = 0; k < kAround; ++k) {
            const Index a = row * kAround + k, b = row * kAround + (k + 1) % kAround;
            const Index c = a + kAround, d = b + kAround;
            const bool target = side == SeamSide::target;
            chart.triangles.push_back(target ? Triangle{a, b, d} : Triangle{b, a, d});
            chart.triangles.push_back(target ? Triangle{a, d, c} : Triangle{d, a, c});
        }
    }
    return chart;
}

// Difference of two angles, at most half a turn.
double apart(double a, double b) {
    return a - b - std::round(a - b);
}

void check_coordinates(const BandChart& chart, const BandPlace& place, double angle,
                       double distance) {
    double turn = 0.0, away = 0.0, total = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Index local = place.vertices[k] - 100;
        CHECK(place.weights[k] >= -1e-8);
        total += place.weights[k];
        turn += place.weights[k] * apart(chart.angle[local], angle);
        away += place.weights[k] * chart.distance[local] / kMapWidth;
    }
    CHECK(total == doctest::Approx(1.0));
    CHECK(std::abs(turn) < 1e-12);
    CHECK(away == doctest::Approx(distance));
}

}  // namespace

TEST_CASE("band map: a place has the coordinates that it was asked for, all around and away") {
    for (const SeamSide side : {SeamSide::target, SeamSide::source}) {
        const BandChart chart = noisy_strip(side);
        const BandMap map(chart, kMapWidth);
        CHECK(map.flipped() == 0);
        for (int i = 0; i < 200; ++i) {
            // The last row begins at 4 steps of .2, less its noise.
            for (const double distance : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9}) {
                const double angle = i / 200.0;
                const auto place = map.locate(angle, distance);
                REQUIRE(place);
                check_coordinates(chart, *place, angle, distance);
            }
            CHECK(!map.locate(i / 200.0, 1.1));
        }
    }
}

TEST_CASE("band map: the nearest vertex is that of all, across the end of the turn as well") {
    const BandChart chart = noisy_strip(SeamSide::target);
    const BandMap map(chart, kMapWidth);
    for (int i = 0; i < 100; ++i) {
        for (const double distance : {0.0, 0.4, 1.0, 3.0}) {
            const double angle = i / 100.0;
            const auto away = [&](Index local) {
                return std::hypot(apart(angle, chart.angle[local]),
                                  distance - chart.distance[local] / kMapWidth);
            };
            double least = std::numeric_limits<double>::infinity();
            for (Index v = 0; v < count_of(chart.vertex); ++v) least = std::min(least, away(v));
            const auto place = map.nearest(angle, distance);
            REQUIRE(place);
            const auto one = std::find(place->weights.begin(), place->weights.end(), 1.0);
            REQUIRE(one != place->weights.end());
            CHECK(away(place->vertices[one - place->weights.begin()] - 100) ==
                  doctest::Approx(least));
        }
    }
}

TEST_CASE("band map: triangles that turn over within the width are counted and not found") {
    BandChart chart = noisy_strip(SeamSide::target);
    std::swap(chart.triangles[3][0], chart.triangles[3][1]);
    const BandMap map(chart, kMapWidth);
    CHECK(map.flipped() == 1);
    Index missing = 0;
    for (int i = 0; i < 200; ++i) missing += map.locate(i / 200.0, 0.15) ? 0 : 1;
    CHECK(missing > 0);
    CHECK(missing < 200 / kAround + 2);
    // All triangles turn over for the other side; those that begin beyond the width do not count.
    chart.side = SeamSide::source;
    CHECK(BandMap(chart, kMapWidth).flipped() == count_of(chart.triangles) - 1);
    const Index few = BandMap(chart, 0.1).flipped();
    CHECK(few > 0);
    CHECK(few <= 2 * kAround);
    CHECK(!BandMap({}, 1.0).locate(0.5, 0.0));
    CHECK(!BandMap({}, 1.0).nearest(0.5, 0.0));
}
