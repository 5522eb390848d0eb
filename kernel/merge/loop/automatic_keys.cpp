#include "kernel/merge/loop/automatic_keys.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kernel/merge/loop/loop_fit.h"

namespace lissom {
namespace {

constexpr int kSamples = kLoopSamples;
// Offsets closer than this to the best one are the same guess.
constexpr int kSameGuess = kSamples / 10;
// Weight of a mismatch of normals beside a misfit of points in sizes of the target.
constexpr double kNormalWeight = 0.5;
constexpr double kFrameSigma = 0.015;
// Contrast is measured in costs of the best offset and at least these: of a fit alone, and with
// directions or parts.
constexpr double kFitFloor = 1e-6, kLeaningFloor = 0.05;
// Costs that differ by less are equally good; sampling changes them by as much.
constexpr double kTie = 1e-3;
// Costs of neighbours that differ by less are level: rounding changes them by less than that for a
// copy of the source at another place.
constexpr double kFlat = 1e-6;
// Beyond this angle between the axes every turn rotates a source by nearly as much, and an error of
// 10 degrees in how it lies may turn it by 40.
constexpr double kTurnedOver = 150.0 * kPi / 180.0;
// Offsets closer than this part of the loop are one turn.
constexpr double kSameTurn = 10.0 / 360.0;
// A minimum is the least of the samples this near to it.
constexpr int kNear = 6;
// Halvings between two samples: the last is below the rounding of a parameter.
constexpr int kHalvings = 50;
// Directions whose parts in the planes of the loops have a smaller product say nothing.
constexpr double kMinLean = 0.01;
// Weight of the user's directions if they are opposite to each other, halved.
constexpr double kDirectionWeight = 4.0;
// The same of the planes in which the parts are mirror images of themselves.
constexpr double kMirrorWeight = 1.0;

double misfit(const LoopSamples& source, const LoopSamples& target, const SimilarityMap& s,
              double size) {
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
double contrast_of(const Costs& cost, int best, double floor) {
    double second = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kSamples; ++k) {
        const int apart = std::abs(k - best);
        if (std::min(apart, kSamples - apart) > kSameGuess) second = std::min(second, cost[k]);
    }
    return std::max(1.0, (second + floor) / (cost[best] + floor));
}

Vec3 square_to(const Vec3& direction, const Vec3& axis) {
    return direction - direction.dot(axis) * axis;
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
    SimilarityMap fit(double offset) const {
        const LoopSamples to = target(0, offset);
        Matches matches;
        matches.from.assign(source_[0].points.begin(), source_[0].points.end());
        matches.to.assign(to.points.begin(), to.points.end());
        for (std::size_t j = 1; j < joins_.size(); ++j) {
            matches.from.insert(matches.from.end(), kSamples, joins_[j].source->center());
            matches.to.insert(matches.to.end(), kSamples, joins_[j].target->center());
        }
        return matches.fit();
    }

    double cost(std::size_t join, double offset, const SimilarityMap& s) const {
        return misfit(source_[join], target(join, offset), s, joins_[join].target->radius());
    }

    // How far the similarity leaves the other joins apart, in radii of the first.
    double others_apart(const SimilarityMap& s) const {
        double squares = 0.0;
        for (std::size_t j = 1; j < joins_.size(); ++j) {
            squares += (s(joins_[j].source->center()) - joins_[j].target->center()).squaredNorm();
        }
        return std::sqrt(squares / joins_.size()) / joins_[0].target->radius();
    }

    double first_cost(double offset, const SimilarityMap& s) const {
        return cost(0, offset, s) + others_apart(s);
    }

    // The best offsets of the joins behind the first one under a similarity.
    void add_others(const SimilarityMap& s, std::vector<OffsetGuess>& guesses) const;

  private:
    LoopSamples target(std::size_t join, double offset) const {
        return {*joins_[join].target, frames_[join], offset};
    }

    std::span<const LoopJoin> joins_;
    std::vector<std::vector<Mat3>> frames_;
    std::vector<LoopSamples> source_;
};

// How far a rotation brings the directions together that belong together, in the planes of the
// loops.
class DirectionCost {
  public:
    DirectionCost(const LoopJoin& join, std::span<const DirectionPair> directions)
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
        if (pair.length > kMinLean) pairs_.push_back(pair);
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
        is_flat(costs, best) ? static_cast<double>(best) / kSamples : refined_offset(best, cost);
    return {{0.0, offset}, contrast_of(costs, best, floor)};
}

void OffsetSearch::add_others(const SimilarityMap& s, std::vector<OffsetGuess>& guesses) const {
    for (std::size_t j = 1; j < joins_.size(); ++j) {
        guesses.push_back(
            best_offset([&](double offset) { return cost(j, offset, s); }, kFitFloor));
    }
}

// The angle, -pi to pi, by which a rotation turns about an axis.
double twist_about(const Vec3& axis, const Mat3& rotation) {
    const Eigen::Quaterniond q(rotation);
    return std::remainder(2.0 * std::atan2(q.vec().dot(axis), q.w()), 2.0 * kPi);
}

// The sample of a twist after which it passes through 0, with the least values beside it; -1 if it
// never does. It also changes its sign at half a turn.
int untwisted_sample(const std::array<double, kSamples + 1>& twist) {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kSamples; ++k) {
        const double size = std::max(std::abs(twist[k]), std::abs(twist[k + 1]));
        if ((twist[k] <= 0.0) == (twist[k + 1] <= 0.0) || !(size < least)) continue;
        best = k;
        least = size;
    }
    return best;
}

// The offset under which a source with one loop is turned least: without a twist about the axis.
double untwisted_offset(const OffsetSearch& search, const Vec3& axis) {
    const auto twist = [&](double u) { return twist_about(axis, search.fit(u).rotation); };
    std::array<double, kSamples + 1> twists{};
    for (int k = 0; k <= kSamples; ++k) twists[k] = twist(static_cast<double>(k) / kSamples);
    const int best = untwisted_sample(twists);
    if (best < 0) return 0.0;
    double low = static_cast<double>(best) / kSamples, high = low + 1.0 / kSamples;
    const bool below = twists[best] <= 0.0;
    for (int step = 0; step < kHalvings; ++step) {
        const double middle = 0.5 * (low + high);
        ((twist(middle) <= 0.0) == below ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// The same of several loops, whose centres come together as well.
double min_turned_offset(const OffsetSearch& search) {
    const auto cost = [&](double u) {
        const SimilarityMap fit = search.fit(u);
        return search.others_apart(fit) + 0.25 * (3.0 - fit.rotation.trace());
    };
    return best_offset(cost, kFitFloor).key.target;
}

// Evidence that a direction of each part gives for a rotation of the source: the cosine between
// them in the plane of the target's loop, or 0 if one of them is too short.
struct Leans {
    Vec3 source, target;

    double along(const Mat3& rotation) const {
        const double lengths = source.norm() * target.norm();
        return lengths > kMinLean ? (rotation * source).dot(target) / lengths : 0.0;
    }
    double weight() const { return std::min(1.0, source.norm()) * std::min(1.0, target.norm()); }
};

class CandidateSearch {
  public:
    explicit CandidateSearch(const LoopJoin& join)
        : search_(std::span(&join, 1)),
          mirror_{square_to(join.source_part->mirror, join.source->axis()),
                  square_to(join.target_part->mirror, join.target->axis())},
          mass_{join.source_part->mass, join.target_part->mass},
          neck_{join.source_part->neck, join.target_part->neck} {}

    std::vector<TurnCandidate> candidates() {
        propose([&](double u) { return search_.first_cost(u, search_.fit(u)); });
        propose([&](double u) { return -std::abs(mirror_.along(rotation(u))); });
        propose([&](double u) { return neck_.along(rotation(u)); });
        propose([&](double u) { return mass_.along(rotation(u)); });
        propose([&](double u) { return -mass_.along(rotation(u)); });
        if (found_.empty()) found_.push_back(judged(0.0));
        return std::move(found_);
    }

  private:
    Mat3 rotation(double offset) const { return search_.fit(offset).rotation; }

    // Takes the minima of a cost, the lowest first, that are not near an earlier one.
    template <typename Cost>
    void propose(const Cost& cost) {
        Costs costs{};
        for (int k = 0; k < kSamples; ++k) costs[k] = cost(static_cast<double>(k) / kSamples);
        std::vector<int> minima;
        for (int k = 0; k < kSamples; ++k) {
            if (is_clear_minimum(costs, k)) minima.push_back(k);
        }
        // Costs that differ by rounding are one, so that the place of the source does not decide.
        const auto steps = [&](int k) { return std::floor(costs[k] / kTie); };
        std::stable_sort(minima.begin(), minima.end(),
                         [&](int x, int y) { return steps(x) < steps(y); });
        for (const int k : minima) add(refined_offset(k, cost));
    }

    // The least within kNear samples, from which the cost rises by more than a tie.
    static bool is_clear_minimum(const Costs& costs, int k) {
        double most = costs[k];
        for (int d = 1; d <= kNear; ++d) {
            const double before = costs[wrapped_sample(k - d)],
                         after = costs[wrapped_sample(k + d)];
            if (before < costs[k] || after <= costs[k]) return false;
            most = std::max({most, before, after});
        }
        return most > costs[k] + kTie;
    }

    void add(double offset) {
        const bool near = std::any_of(found_.begin(), found_.end(), [&](const TurnCandidate& one) {
            return std::abs(std::remainder(one.offset - offset, 1.0)) < kSameTurn;
        });
        if (!near && found_.size() < kTurnCandidates) found_.push_back(judged(offset));
    }

    TurnCandidate judged(double offset) const {
        const SimilarityMap fit = search_.fit(offset);
        const double mirror = mirror_.along(fit.rotation);
        const double off = std::sqrt(std::max(0.0, 1.0 - mirror * mirror));
        return {offset, fit, search_.first_cost(offset, fit), mirror == 0.0 ? 0.0 : off,
                mass_.along(fit.rotation) * mass_.weight()};
    }

    OffsetSearch search_;
    Leans mirror_, mass_, neck_;
    std::vector<TurnCandidate> found_;
};

}  // namespace

bool directions_count(const LoopJoin& join, std::span<const DirectionPair> directions) {
    return DirectionCost({join.source, join.target}, directions).counts();
}

bool is_turned_over(const LoopJoin& join) {
    const double along = join.source->axis().dot(join.target->axis());
    return std::acos(std::clamp(along, -1.0, 1.0)) > kTurnedOver;
}

std::vector<OffsetGuess> as_placed_offsets(std::span<const LoopJoin> joins) {
    const OffsetSearch search(joins);
    const double offset = joins.size() > 1 ? min_turned_offset(search)
                                           : untwisted_offset(search, joins.front().target->axis());
    std::vector<OffsetGuess> guesses{{{0.0, offset}, kSureContrast}};
    search.add_others(search.fit(offset), guesses);
    return guesses;
}

std::vector<TurnCandidate> turn_candidates(const LoopJoin& join) {
    return CandidateSearch(join).candidates();
}

std::vector<OffsetGuess> guess_offsets(std::span<const LoopJoin> joins,
                                       std::span<const DirectionPair> directions) {
    const OffsetSearch search(joins);
    const DirectionCost leaning(joins.front(), directions);
    std::vector<OffsetGuess> guesses{best_offset(
        [&](double offset) {
            const SimilarityMap fit = search.fit(offset);
            return search.first_cost(offset, fit) + leaning.cost(fit.rotation);
        },
        leaning.counts() ? kLeaningFloor : kFitFloor)};
    search.add_others(search.fit(guesses.front().key.target), guesses);
    return guesses;
}

std::vector<OffsetGuess> nearest_offsets(std::span<const LoopJoin> joins) {
    const OffsetSearch search(joins);
    std::vector<OffsetGuess> guesses;
    for (std::size_t j = 0; j < joins.size(); ++j) {
        const Loop &source = *joins[j].source, &target = *joins[j].target;
        const SimilarityMap met{shortest_turn(source.axis(), target.axis()),
                                target.radius() / source.radius(), source.center(),
                                target.center()};
        guesses.push_back(
            best_offset([&](double offset) { return search.cost(j, offset, met); }, kFitFloor));
    }
    return guesses;
}

}  // namespace lissom
