#include "kernel/hair/dynamics/body_capsules.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// Samples of the body along the longest side of the box, and ends that capsules may have.
constexpr int kBodySteps = 32;
constexpr std::size_t kMaxEnds = 100;
// Parts of a capsule's axis at which its room is measured.
constexpr int kAxisParts = 8;
// Moves towards deeper places, each as long as the last or half of it.
constexpr int kDeepenRounds = 8;
constexpr Index kMaxCapsules = 64;

struct BodySample {
    Vec3 place = Vec3::Zero();
    double depth = 0.0;
};

void require_capsules(const BodyDistance& distance, const CapsuleOptions& options) {
    require(distance != nullptr, "capsules need the distance to a body");
    require(options.count >= 1 && options.count <= kMaxCapsules, "there are 1 to 64 capsules");
    require(options.cover > 0.0 && options.cover <= 1.0,
            "the part to cover is above 0 and at most 1");
    require(options.tolerance >= 0.0 && std::isfinite(options.tolerance),
            "the tolerance of capsules is 0 or more");
}

// Places of a grid over the box that lie in the body.
std::vector<BodySample> samples_of(const BodyDistance& distance, const Box& box,
                                   const Context& context) {
    const Vec3 size = box.max - box.min;
    const double step = size.maxCoeff() / kBodySteps;
    require(step > 0.0 && std::isfinite(step), "the box of capsules has no size");
    std::vector<BodySample> samples;
    for (double z = box.min.z() + 0.5 * step; z < box.max.z(); z += step) {
        context.checkpoint();
        for (double y = box.min.y() + 0.5 * step; y < box.max.y(); y += step) {
            for (double x = box.min.x() + 0.5 * step; x < box.max.x(); x += step) {
                const Vec3 place(x, y, z);
                const double depth = -distance(place);
                if (depth > 0.0) samples.push_back({place, depth});
            }
        }
    }
    require(!samples.empty(), "the box of capsules holds no part of the body");
    return samples;
}

// Goes up to a place that is deepest among those around it, to a small part of `step`.
BodySample deepened(BodySample sample, const BodyDistance& distance, double step) {
    for (int round = 0; round < kDeepenRounds; ++round) {
        BodySample best = sample;
        for (Index c = 0; c < 6; ++c) {
            const Vec3 place = sample.place + (c < 3 ? step : -step) * Vec3::Unit(c % 3);
            const double depth = -distance(place);
            if (depth > best.depth) best = {place, depth};
        }
        if (best.depth == sample.depth) step *= 0.5;
        sample = best;
    }
    return sample;
}

// Deep places far from one another: each the deepest that no ball of a former one covers to half.
std::vector<BodySample> ends_of(std::vector<BodySample> samples) {
    std::stable_sort(samples.begin(), samples.end(),
                     [](const BodySample& a, const BodySample& b) { return a.depth > b.depth; });
    std::vector<BodySample> ends;
    for (const BodySample& sample : samples) {
        if (ends.size() == kMaxEnds) break;
        const bool is_near = std::any_of(ends.begin(), ends.end(), [&](const BodySample& end) {
            return (end.place - sample.place).norm() < 0.5 * end.depth;
        });
        if (!is_near) ends.push_back(sample);
    }
    return ends;
}

// The thickest capsule between two places, which stands out by the tolerance at most.
Capsule capsule_between(const BodySample& a, const BodySample& b, const BodyDistance& distance,
                        double tolerance) {
    Capsule capsule{a.place, b.place, std::min(a.depth, b.depth)};
    for (int i = 1; i < kAxisParts && a.place != b.place; ++i) {
        const double t = static_cast<double>(i) / kAxisParts;
        capsule.radius = std::min(capsule.radius, -distance((1.0 - t) * a.place + t * b.place));
    }
    capsule.radius += tolerance;
    return capsule;
}

class CapsuleChooser {
  public:
    CapsuleChooser(const BodyDistance& distance, std::vector<BodySample> samples,
                   const CapsuleOptions& options, const Context& context)
        : samples_(std::move(samples)),
          covered_(samples_.size(), false),
          options_(options),
          context_(context) {
        std::vector<BodySample> ends = ends_of(samples_);
        for (BodySample& end : ends) end = deepened(end, distance, 0.25 * end.depth);
        for (std::size_t i = 0; i < ends.size(); ++i) {
            context.checkpoint();
            for (std::size_t j = i; j < ends.size(); ++j) {
                const Capsule made = capsule_between(ends[i], ends[j], distance, options.tolerance);
                if (made.radius > options.tolerance) candidates_.push_back(made);
            }
        }
        gains_.resize(candidates_.size());
    }

    BodyCapsules run() {
        measure();
        BodyCapsules chosen;
        const auto all = static_cast<double>(samples_.size());
        while (count_of(chosen.capsules) < options_.count && chosen.covered < options_.cover) {
            const std::size_t best = best_candidate();
            if (best == candidates_.size() || gains_[best] == 0) break;
            take(candidates_[best]);
            chosen.capsules.push_back(candidates_[best]);
            chosen.covered =
                static_cast<double>(std::count(covered_.begin(), covered_.end(), true)) / all;
        }
        return chosen;
    }

  private:
    void measure() {
        context_.parallel_for(0, count_of(candidates_), 16, [&](Index begin, Index end) {
            for (Index i = begin; i < end; ++i) gains_[at(i)] = gain(candidates_[at(i)]);
        });
    }

    // The first of those that cover most of the samples left. Gains only shrink as samples are
    // covered, so those below the best up to date one need no new measure.
    std::size_t best_candidate() {
        std::size_t best = candidates_.size();
        std::vector<std::size_t> order(candidates_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t i, std::size_t j) { return gains_[i] > gains_[j]; });
        for (const std::size_t i : order) {
            if (best != candidates_.size() && gains_[i] < gains_[best]) break;
            context_.checkpoint();
            gains_[i] = gain(candidates_[i]);
            const bool is_better = best == candidates_.size() || gains_[i] > gains_[best] ||
                                   (gains_[i] == gains_[best] && i < best);
            if (is_better) best = i;
        }
        return best;
    }

    Index gain(const Capsule& capsule) const {
        Index count = 0;
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            count += !covered_[i] && distance_to(capsule, samples_[i].place) < 0.0 ? 1 : 0;
        }
        return count;
    }

    void take(const Capsule& capsule) {
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            if (distance_to(capsule, samples_[i].place) < 0.0) covered_[i] = true;
        }
    }

    std::vector<BodySample> samples_;
    std::vector<bool> covered_;
    const CapsuleOptions& options_;
    const Context& context_;
    std::vector<Capsule> candidates_;
    std::vector<Index> gains_;
};

}  // namespace

double distance_to(const Capsule& capsule, const Vec3& point) {
    const Vec3 axis = capsule.b - capsule.a;
    const double square = axis.squaredNorm();
    const double t =
        square > 0.0 ? std::clamp((point - capsule.a).dot(axis) / square, 0.0, 1.0) : 0.0;
    return (point - capsule.a - t * axis).norm() - capsule.radius;
}

BodyCapsules fit_capsules(const BodyDistance& distance, const Box& box,
                          const CapsuleOptions& options, const Context& context) {
    require_capsules(distance, options);
    return CapsuleChooser(distance, samples_of(distance, box, context), options, context).run();
}

}  // namespace lissom
