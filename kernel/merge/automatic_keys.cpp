#include "kernel/merge/automatic_keys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kernel/deform/polar.h"

namespace lissom {
namespace {

constexpr int kSamples = 128;
// Offsets closer than this to the best one are the same guess.
constexpr int kSameGuess = kSamples / 10;
// What a mismatch of normals counts beside a misfit of points in sizes of the target.
constexpr double kNormalWeight = 0.5;
constexpr double kFrameSigma = 0.015;

// A loop at evenly spaced parameters.
struct Samples {
    std::array<Vec3, kSamples> points, normals;

    explicit Samples(const Loop& loop) {
        const std::vector<Mat3> frames = loop.frames(kFrameSigma);
        for (int k = 0; k < kSamples; ++k) {
            const LoopPoint place = loop.place_at(static_cast<double>(k) / kSamples);
            points[k] = point_of(loop.points(), place);
            normals[k] = interpolated(frames, place).col(1).normalized();
        }
    }
};

struct Similarity {
    Mat3 rotation = Mat3::Identity();
    double scale = 1.0;
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();

    Vec3 operator()(const Vec3& p) const { return to + scale * (rotation * (p - from)); }
};

// Points that are to meet, with weights. The last of several joins are their centres.
struct Matches {
    std::vector<Vec3> from, to;

    Similarity fit() const {
        Similarity s;
        const auto n = static_cast<double>(from.size());
        for (const Vec3& p : from) s.from += p / n;
        for (const Vec3& p : to) s.to += p / n;
        Mat3 products = Mat3::Zero();
        double from_squares = 0.0, to_squares = 0.0;
        for (std::size_t i = 0; i < from.size(); ++i) {
            const Vec3 a = from[i] - s.from, b = to[i] - s.to;
            products += b * a.transpose();
            from_squares += a.squaredNorm();
            to_squares += b.squaredNorm();
        }
        s.rotation = nearest_rotation(products / std::sqrt(from_squares * to_squares));
        s.scale = std::sqrt(to_squares / from_squares);
        return s;
    }
};

double misfit(const Samples& source, const Samples& target, int offset, const Similarity& s,
              double size) {
    double squares = 0.0, mismatch = 0.0;
    for (int k = 0; k < kSamples; ++k) {
        const int other = (k + offset) % kSamples;
        squares += (s(source.points[k]) - target.points[other]).squaredNorm();
        mismatch += 1.0 - (s.rotation * source.normals[k]).dot(target.normals[other]);
    }
    return std::sqrt(squares / kSamples) / size + kNormalWeight * mismatch / kSamples;
}

// The lowest of costs at cyclic offsets, refined below the sample step by a parabola.
OffsetGuess lowest(const std::array<double, kSamples>& cost) {
    const int best = static_cast<int>(std::min_element(cost.begin(), cost.end()) - cost.begin());
    double second = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kSamples; ++k) {
        const int apart = std::abs(k - best);
        if (std::min(apart, kSamples - apart) > kSameGuess) second = std::min(second, cost[k]);
    }
    const double before = cost[(best + kSamples - 1) % kSamples], at = cost[best];
    const double after = cost[(best + 1) % kSamples];
    const double bend = before - 2.0 * at + after;
    const double shift = bend > 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
    // A loop that fits without any misfit fits another way only where that one has none either.
    const double floor = 1e-6;
    return {{0.0, (best + shift) / kSamples}, (second + floor) / (at + floor)};
}

}  // namespace

std::vector<OffsetGuess> guess_offsets(std::span<const LoopJoin> joins) {
    std::vector<Samples> source, target;
    for (const LoopJoin& join : joins) {
        source.emplace_back(*join.source);
        target.emplace_back(*join.target);
    }
    std::array<double, kSamples> cost{};
    std::array<Similarity, kSamples> fits;
    for (int offset = 0; offset < kSamples; ++offset) {
        Matches matches;
        for (int k = 0; k < kSamples; ++k) {
            matches.from.push_back(source[0].points[k]);
            matches.to.push_back(target[0].points[(k + offset) % kSamples]);
        }
        // A centre counts as much as the samples of one loop.
        for (std::size_t j = 1; j < joins.size(); ++j) {
            matches.from.insert(matches.from.end(), kSamples, joins[j].source->center());
            matches.to.insert(matches.to.end(), kSamples, joins[j].target->center());
        }
        fits[offset] = matches.fit();
        double squares = 0.0;
        for (std::size_t i = 0; i < matches.from.size(); ++i) {
            squares += (fits[offset](matches.from[i]) - matches.to[i]).squaredNorm();
        }
        const double size = joins[0].target->radius();
        cost[offset] = misfit(source[0], target[0], offset, fits[offset], size);
        if (joins.size() > 1) cost[offset] += std::sqrt(squares / matches.from.size()) / size;
    }
    std::vector<OffsetGuess> guesses{lowest(cost)};
    const int chosen = static_cast<int>(std::min_element(cost.begin(), cost.end()) - cost.begin());
    for (std::size_t j = 1; j < joins.size(); ++j) {
        for (int offset = 0; offset < kSamples; ++offset) {
            cost[offset] =
                misfit(source[j], target[j], offset, fits[chosen], joins[j].target->radius());
        }
        guesses.push_back(lowest(cost));
    }
    return guesses;
}

}  // namespace lissom
