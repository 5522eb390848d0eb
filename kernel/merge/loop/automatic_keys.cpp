#include "kernel/merge/loop/automatic_keys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kernel/deform/rotation/polar.h"

namespace lissom {
namespace {

constexpr int kSamples = 128;
// Offsets closer than this to the best one are the same guess.
constexpr int kSameGuess = kSamples / 10;
// What a mismatch of normals counts beside a misfit of points in sizes of the target.
constexpr double kNormalWeight = 0.5;
constexpr double kFrameSigma = 0.015;
// Steps of the search between samples: the last is a millionth of a loop.
constexpr int kRefinements = 20;

// A loop at evenly spaced parameters from `start`.
struct Samples {
    std::array<Vec3, kSamples> points, normals;

    Samples(const Loop& loop, const std::vector<Mat3>& frames, double start) {
        for (int k = 0; k < kSamples; ++k) {
            const LoopPoint place = loop.place_at(start + static_cast<double>(k) / kSamples);
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

double misfit(const Samples& source, const Samples& target, const Similarity& s, double size) {
    double squares = 0.0, mismatch = 0.0;
    for (int k = 0; k < kSamples; ++k) {
        squares += (s(source.points[k]) - target.points[k]).squaredNorm();
        mismatch += 1.0 - (s.rotation * source.normals[k]).dot(target.normals[k]);
    }
    return std::sqrt(squares / kSamples) / size + kNormalWeight * mismatch / kSamples;
}

// Where costs at cyclic offsets are lowest, and how certain that is.
struct Lowest {
    int offset = 0;
    double certainty = 1.0;
};

Lowest lowest(const std::array<double, kSamples>& cost) {
    Lowest best;
    best.offset = static_cast<int>(std::min_element(cost.begin(), cost.end()) - cost.begin());
    double second = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kSamples; ++k) {
        const int apart = std::abs(k - best.offset);
        if (std::min(apart, kSamples - apart) > kSameGuess) second = std::min(second, cost[k]);
    }
    // Costs below this are those of one fit.
    const double floor = 1e-6;
    best.certainty = (second + floor) / (cost[best.offset] + floor);
    return best;
}

// Golden section: `cost` has one minimum between a sample before and one after the best offset.
template <typename Cost>
double refined(int offset, const Cost& cost) {
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    double low = (offset - 1.0) / kSamples, high = (offset + 1.0) / kSamples;
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double at_a = cost(a), at_b = cost(b);
    for (int step = 0; step < kRefinements; ++step) {
        if (at_a < at_b) {
            high = b;
            b = a;
            at_b = at_a;
            a = high - golden * (high - low);
            at_a = cost(a);
        } else {
            low = a;
            a = b;
            at_a = at_b;
            b = low + golden * (high - low);
            at_b = cost(b);
        }
    }
    return 0.5 * (low + high);
}

// All joins, to try offsets of the first one.
class OffsetSearch {
  public:
    explicit OffsetSearch(std::span<const LoopJoin> joins) : joins_(joins) {
        for (const LoopJoin& join : joins) {
            frames_.push_back(join.target->frames(kFrameSigma));
            source_.emplace_back(*join.source, join.source->frames(kFrameSigma), 0.0);
        }
    }

    // The similarity for an offset of the first join, with the centres of all others, each of which
    // counts as much as the samples of one loop.
    Similarity fit(double offset) const {
        const Samples to = target(0, offset);
        Matches matches;
        matches.from.assign(source_[0].points.begin(), source_[0].points.end());
        matches.to.assign(to.points.begin(), to.points.end());
        for (std::size_t j = 1; j < joins_.size(); ++j) {
            matches.from.insert(matches.from.end(), kSamples, joins_[j].source->center());
            matches.to.insert(matches.to.end(), kSamples, joins_[j].target->center());
        }
        return matches.fit();
    }

    double cost(std::size_t join, double offset, const Similarity& s) const {
        return misfit(source_[join], target(join, offset), s, joins_[join].target->radius());
    }

    // Of the first join, with how far the similarity leaves the other joins apart.
    double first_cost(double offset) const {
        const Similarity s = fit(offset);
        const double size = joins_[0].target->radius();
        double squares = 0.0;
        for (std::size_t j = 1; j < joins_.size(); ++j) {
            squares += (s(joins_[j].source->center()) - joins_[j].target->center()).squaredNorm();
        }
        return cost(0, offset, s) + std::sqrt(squares / static_cast<double>(joins_.size())) / size;
    }

  private:
    Samples target(std::size_t join, double offset) const {
        return {*joins_[join].target, frames_[join], offset};
    }

    std::span<const LoopJoin> joins_;
    std::vector<std::vector<Mat3>> frames_;
    std::vector<Samples> source_;
};

template <typename Cost>
OffsetGuess best_offset(const Cost& cost) {
    std::array<double, kSamples> costs{};
    for (int k = 0; k < kSamples; ++k) costs[k] = cost(static_cast<double>(k) / kSamples);
    const Lowest best = lowest(costs);
    return {{0.0, refined(best.offset, cost)}, best.certainty};
}

}  // namespace

std::vector<OffsetGuess> guess_offsets(std::span<const LoopJoin> joins) {
    const OffsetSearch search(joins);
    std::vector<OffsetGuess> guesses{
        best_offset([&](double offset) { return search.first_cost(offset); })};
    const Similarity fit = search.fit(guesses.front().key.target);
    for (std::size_t j = 1; j < joins.size(); ++j) {
        guesses.push_back(best_offset([&](double offset) { return search.cost(j, offset, fit); }));
    }
    return guesses;
}

}  // namespace lissom
