#include "viewer/render/strands/strand_raster.h"

#include "kernel/core/geometry.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

using namespace lissom;
using doctest::Approx;

namespace {

constexpr int kSize = 40;

SampleTile tile() {
    return {0, 0, kSize, kSize};
}

int count(const SampleTile& tile, std::uint32_t id) {
    int samples = 0;
    for (int y = tile.top(); y < tile.top() + tile.height(); ++y) {
        for (int x = tile.left(); x < tile.left() + tile.width(); ++x) {
            for (int k = 0; k < SampleTile::kSamples; ++k) samples += tile.id(x, y, k) == id;
        }
    }
    return samples;
}

double pixels(const SampleTile& tile, std::uint32_t id) {
    return count(tile, id) / double(SampleTile::kSamples);
}

// A line through the middle of the tile, from side to side.
std::array<ScreenPoint, 2> line(double angle, double offset, double width) {
    const double c = std::cos(angle), s = std::sin(angle), m = kSize / 2.0;
    const auto point = [&](double along) {
        return ScreenPoint{static_cast<float>(m + along * c - offset * s),
                           static_cast<float>(m + along * s + offset * c), 0.5f,
                           static_cast<float>(0.5 * width)};
    };
    return {point(-15.0), point(15.0)};
}

}  // namespace

TEST_CASE("strand samples: sixteen a pixel, one in each row and column of it") {
    const SampleTile samples = tile();
    for (const int x : {0, 7, 31}) {
        std::set<int> rows, columns, squares;
        for (int k = 0; k < SampleTile::kSamples; ++k) {
            const Eigen::Vector2f p = samples.position(x, 5, k) - Eigen::Vector2f(x, 5);
            columns.insert(static_cast<int>(16 * p.x()));
            rows.insert(static_cast<int>(16 * p.y()));
            squares.insert(static_cast<int>(4 * p.x()) + 4 * static_cast<int>(4 * p.y()));
        }
        CHECK(rows.size() == 16);
        CHECK(columns.size() == 16);
        CHECK(squares.size() == 16);
    }
}

TEST_CASE("strand samples: a strand covers its width, wherever it lies") {
    for (const double width : {0.12, 0.5, 1.0, 3.3}) {
        for (int turn = 0; turn < 12; ++turn) {
            for (int shift = 0; shift < 5; ++shift) {
                SampleTile samples = tile();
                const auto [a, b] = line(kPi * turn / 12.0, 0.23 * shift, width);
                samples.draw_segment(a, b, 7);
                const double expected = 30.0 * width + 0.25 * kPi * width * width;
                CAPTURE(width);
                CAPTURE(turn);
                CHECK(pixels(samples, 7) == Approx(expected).epsilon(width < 0.2 ? 0.3 : 0.1));
            }
        }
    }
}

TEST_CASE("strand samples: half a pixel's width is half the cover in the mean") {
    double sum = 0.0;
    for (int i = 0; i < 64; ++i) {
        SampleTile samples = tile();
        const auto [a, b] = line(0.05 * i, 0.017 * i, 0.5);
        samples.draw_segment(a, b, 1);
        sum += pixels(samples, 1) / (30.0 * 0.5);
    }
    CHECK(sum / 64 == Approx(1.0 + 0.25 * kPi * 0.25 / 15.0).epsilon(0.01));
}

TEST_CASE("strand samples: a taper covers the mean of its widths") {
    SampleTile samples = tile();
    auto [a, b] = line(0.4, 0.1, 2.0);
    b.radius = 0.0f;
    samples.draw_segment(a, b, 1);
    CHECK(pixels(samples, 1) == Approx(30.0 + 0.125 * kPi * 4.0).epsilon(0.05));
}

TEST_CASE("strand samples: pieces of a strand meet without gap") {
    SampleTile whole = tile(), pieces = tile();
    const auto [a, b] = line(0.7, 0.0, 0.8);
    whole.draw_segment(a, b, 1);
    ScreenPoint from = a;
    for (int i = 1; i <= 9; ++i) {
        const float t = static_cast<float>(i) / 9.0f;
        const ScreenPoint to{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), 0.5f, a.radius};
        pieces.draw_segment(from, to, 1);
        from = to;
    }
    CHECK(std::abs(count(whole, 1) - count(pieces, 1)) <= 2);
}

TEST_CASE("strand samples: the nearest is seen, in any order") {
    auto [a, b] = line(0.3, 0.0, 2.0);
    auto [c, d] = line(2.0, 0.0, 2.0);
    c.depth = d.depth = 0.4f;
    SampleTile one = tile(), other = tile();
    one.draw_segment(a, b, 1);
    one.draw_segment(c, d, 2);
    other.draw_segment(c, d, 2);
    other.draw_segment(a, b, 1);
    CHECK(count(one, 2) == Approx(16 * 60).epsilon(0.1));
    CHECK(count(one, 1) < count(one, 2));
    bool same = true;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            for (int k = 0; k < 16; ++k) same = same && one.id(x, y, k) == other.id(x, y, k);
        }
    }
    CHECK(same);
    // At the same depth the lower id, whatever comes first.
    SampleTile tie = tile();
    tie.draw_segment(a, b, 4);
    tie.draw_segment(a, b, 3);
    tie.draw_segment(a, b, 5);
    CHECK(count(tie, 3) > 0);
    CHECK(count(tie, 4) + count(tie, 5) == 0);
}

TEST_CASE("strand samples: a lot of layers still show the nearest") {
    SampleTile samples = tile();
    for (std::uint32_t i = 0; i < 200; ++i) {
        auto [a, b] = line(0.01 * i, 0.0, 4.0);
        a.depth = b.depth = 0.9f - 0.001f * static_cast<float>((i * 77) % 200);
        samples.draw_segment(a, b, i);
    }
    std::uint32_t front = 0;
    while ((front * 77) % 200 != 199) ++front;
    CHECK(pixels(samples, front) == Approx(120.0 + kPi * 4.0).epsilon(0.02));
}

TEST_CASE("strand samples: triangles cover their area, meet, and hide what is behind") {
    SampleTile samples = tile();
    const ScreenPoint a{3, 4, 0.5f, 0}, b{35, 9, 0.5f, 0}, c{30, 33, 0.5f, 0}, d{6, 30, 0.5f, 0};
    samples.draw_triangle({a, b, c});
    samples.draw_triangle({a, d, c});
    const double area = 0.5 * std::abs((c.x - a.x) * (d.y - b.y) - (d.x - b.x) * (c.y - a.y));
    CHECK(pixels(samples, SampleTile::kSurface) == Approx(area).epsilon(0.01));
    auto [from, to] = line(0.8, 0.0, 2.0);
    from.depth = to.depth = 0.6f;
    samples.draw_segment(from, to, 1);
    CHECK(count(samples, 1) < 16 * 8);
    from.depth = to.depth = 0.4f;
    samples.draw_segment(from, to, 2);
    CHECK(pixels(samples, 2) == Approx(60.0).epsilon(0.1));
}

TEST_CASE("strand samples: degenerate segments draw little or nothing, and nothing outside") {
    SampleTile samples(10, 20, 8, 8);
    const float nan = std::nanf("");
    samples.draw_segment({14, 24, 0.5f, 1}, {nan, 24, 0.5f, 1}, 1);
    samples.draw_segment({14, 24, 0.5f, 0}, {15, 24, 0.5f, 0}, 1);
    samples.draw_segment({14, 24, -0.5f, 1}, {15, 24, 0.5f, 1}, 1);
    samples.draw_triangle({ScreenPoint{14, 24, 0.5f, 0}, {14, 24, 0.5f, 0}, {17, 25, 0.5f, 0}});
    samples.draw_segment({100, 24, 0.5f, 1}, {200, 24, 0.5f, 1}, 1);
    CHECK(count(samples, SampleTile::kNothing) == 8 * 8 * 16);
    // Seen from its end, a strand is a dot.
    samples.draw_segment({14, 24, 0.5f, 1}, {14, 24, 0.6f, 1}, 1);
    CHECK(pixels(samples, 1) == Approx(kPi).epsilon(0.1));
    // Through the whole tile and far beyond.
    samples.draw_segment({-1e5f, 24, 0.5f, 50}, {1e5f, 24, 0.5f, 50}, 2);
    CHECK(count(samples, SampleTile::kNothing) == 0);
}
