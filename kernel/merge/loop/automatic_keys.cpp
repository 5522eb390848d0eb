#include "kernel/merge/loop/automatic_keys.h"

#include <Eigen/Geometry>
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
// Steps of the search between samples: the last is a billionth of a loop.
constexpr int kRefinements = 30;
// Certainty is told in costs of the best offset and at least these: of a fit alone, and where
// directions or parts decide.
constexpr double kFitFloor = 1e-6, kLeaningFloor = 0.05;
// Costs that differ by less are equally good; sampling changes them by as much.
constexpr double kTie = 1e-3;
// Costs of neighbours that differ by less are level: rounding changes them by less than that where
// a copy of the source lies elsewhere.
constexpr double kFlat = 1e-6;
// A rise below this is none, whatever the sign that rounding gives it.
constexpr double kLevel = 1e-10;
// Directions whose parts in the planes of the loops have a smaller product say nothing.
constexpr double kLeastLean = 0.01;
// What directions of the user's count where they are opposite to each other, halved.
constexpr double kDirectionWeight = 4.0;
// The same of the planes in which the parts are mirror images of themselves.
constexpr double kMirrorWeight = 1.0;

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
        const double n = from.size();
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

using Costs = std::array<double, kSamples>;

int wrapped_sample(int k) {
    return (k + kSamples) % kSamples;
}

// A bottom that is flat at the scale of samples has no place of its own.
bool is_flat(const Costs& cost, int k) {
    return std::max(cost[wrapped_sample(k - 1)], cost[wrapped_sample(k + 1)]) - cost[k] <= kFlat;
}

// The first of the offsets that are as good as the best one, or the bottom next to it.
int first_of_lowest(const Costs& cost) {
    const double least = *std::min_element(cost.begin(), cost.end());
    int k = 0;
    while (cost[k] > least + kTie) ++k;
    while (!is_flat(cost, k)) {
        const int before = wrapped_sample(k - 1), after = wrapped_sample(k + 1);
        const int next = cost[before] < cost[after] - kFlat ? before : after;
        if (!(cost[next] < cost[k])) break;
        k = next;
    }
    return k;
}

// `floor`: costs below this are those of one fit.
double certainty_of(const Costs& cost, int best, double floor) {
    double second = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kSamples; ++k) {
        const int apart = std::abs(k - best);
        if (std::min(apart, kSamples - apart) > kSameGuess) second = std::min(second, cost[k]);
    }
    return std::max(1.0, (second + floor) / (cost[best] + floor));
}

// The offset near a sample at which `cost` is as high a little before as a little after: in a
// bottom of any shape that is a zero with a slope, so that rounding hardly moves it.
template <typename Cost>
double refined(int offset, const Cost& cost) {
    const double apart = 0.5 / kSamples;
    const auto rise = [&](double x) { return cost(x + apart) - cost(x - apart); };
    double low = (offset - 1.0) / kSamples, high = (offset + 1.0) / kSamples;
    if (!(rise(low) < -kLevel && rise(high) > kLevel)) {
        return static_cast<double>(offset) / kSamples;
    }
    for (int step = 0; step < kRefinements; ++step) {
        const double middle = 0.5 * (low + high);
        (rise(middle) < -kLevel ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

Vec3 square_to(const Vec3& direction, const Vec3& axis) {
    return direction - direction.dot(axis) * axis;
}

// Turns one unit vector onto another the shortest way; either may be zero.
Mat3 shortest_turn(const Vec3& from, const Vec3& to) {
    const Vec3 across = from.cross(to);
    const double sine = across.norm(), cosine = from.dot(to);
    if (sine == 0.0 && cosine >= 0.0) return Mat3::Identity();
    const Vec3 axis = sine > 0.0 ? Vec3(across / sine) : from.unitOrthogonal();
    return Eigen::AngleAxisd(std::atan2(sine, cosine), axis).toRotationMatrix();
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
    double first_cost(double offset, const Similarity& s) const {
        const double size = joins_[0].target->radius();
        double squares = 0.0;
        for (std::size_t j = 1; j < joins_.size(); ++j) {
            squares += (s(joins_[j].source->center()) - joins_[j].target->center()).squaredNorm();
        }
        return cost(0, offset, s) + std::sqrt(squares / joins_.size()) / size;
    }

  private:
    Samples target(std::size_t join, double offset) const {
        return {*joins_[join].target, frames_[join], offset};
    }

    std::span<const LoopJoin> joins_;
    std::vector<std::vector<Mat3>> frames_;
    std::vector<Samples> source_;
};

// How far a rotation brings the directions together that belong together, in the planes of the
// loops.
class Leaning {
  public:
    Leaning(const LoopJoin& join, std::span<const DirectionPair> directions)
        : source_axis_(join.source->axis()), target_axis_(join.target->axis()) {
        for (const DirectionPair& pair : directions) {
            add(kDirectionWeight, pair.source.normalized(), pair.target.normalized(), false);
        }
        if (!join.source_part || !join.target_part) return;
        add(kMirrorWeight, join.source_part->mirror, join.target_part->mirror, true);
    }

    bool counts() const { return !pairs_.empty(); }

    double cost(const Mat3& rotation) const {
        double sum = 0.0;
        for (const Pair& pair : pairs_) {
            const double along = square_to(rotation * pair.source, target_axis_).dot(pair.target);
            sum += pair.weight * (pair.length - (pair.either_way ? std::abs(along) : along));
        }
        return sum;
    }

  private:
    struct Pair {
        Vec3 source, target;
        // Product of both lengths, which is the most they can have in common.
        double length = 0.0, weight = 0.0;
        bool either_way = false;
    };

    void add(double weight, const Vec3& from, const Vec3& to, bool either_way) {
        Pair pair{square_to(from, source_axis_), square_to(to, target_axis_), 0.0, weight,
                  either_way};
        pair.length = pair.source.norm() * pair.target.norm();
        if (pair.length > kLeastLean) pairs_.push_back(pair);
    }

    Vec3 source_axis_, target_axis_;
    std::vector<Pair> pairs_;
};

template <typename Cost>
OffsetGuess best_offset(const Cost& cost, double floor) {
    Costs costs{};
    for (int k = 0; k < kSamples; ++k) costs[k] = cost(static_cast<double>(k) / kSamples);
    const int best = first_of_lowest(costs);
    const double offset =
        is_flat(costs, best) ? static_cast<double>(best) / kSamples : refined(best, cost);
    return {{0.0, offset}, certainty_of(costs, best, floor)};
}

}  // namespace

std::vector<OffsetGuess> guess_offsets(std::span<const LoopJoin> joins,
                                       std::span<const DirectionPair> directions) {
    const OffsetSearch search(joins);
    const Leaning leaning(joins.front(), directions);
    std::vector<OffsetGuess> guesses{best_offset(
        [&](double offset) {
            const Similarity fit = search.fit(offset);
            return search.first_cost(offset, fit) + leaning.cost(fit.rotation);
        },
        leaning.counts() ? kLeaningFloor : kFitFloor)};
    const Similarity fit = search.fit(guesses.front().key.target);
    for (std::size_t j = 1; j < joins.size(); ++j) {
        guesses.push_back(
            best_offset([&](double offset) { return search.cost(j, offset, fit); }, kFitFloor));
    }
    return guesses;
}

std::vector<OffsetGuess> nearest_offsets(std::span<const LoopJoin> joins) {
    const OffsetSearch search(joins);
    std::vector<OffsetGuess> guesses;
    for (std::size_t j = 0; j < joins.size(); ++j) {
        const Loop &source = *joins[j].source, &target = *joins[j].target;
        const Similarity met{shortest_turn(source.axis(), target.axis()),
                             target.radius() / source.radius(), source.center(), target.center()};
        guesses.push_back(
            best_offset([&](double offset) { return search.cost(j, offset, met); }, kFitFloor));
    }
    return guesses;
}

}  // namespace lissom
