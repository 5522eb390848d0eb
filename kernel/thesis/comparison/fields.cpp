#include "kernel/thesis/comparison/fields.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/deform/patch/operators.h"
#include "kernel/thesis/comparison/system.h"

namespace lissom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Beside flat and obtuse triangles, edges count at least this much: a part must not come loose.
constexpr double kSmallestCotangent = 1e-4;

// Keeps the inverse finite at vertices that coincide with a handle.
constexpr double kSmallestDistance = 1e-100;

// Arrival time at c of a flat front that passes a and b at the times ta and tb; infinity if it does
// not come through the triangle.
double front_arrival(const Vec3& a, const Vec3& b, const Vec3& c, double ta, double tb) {
    const Vec3 u = a - c, v = b - c;
    Eigen::Matrix2d gram;
    gram << u.dot(u), u.dot(v), u.dot(v), v.dot(v);
    const double determinant = gram.determinant();
    if (!(determinant > 1e-12 * gram(0, 0) * gram(1, 1))) return kInfinity;
    const Eigen::Matrix2d q = gram.inverse();
    const Eigen::Vector2d ones(1.0, 1.0), t(ta, tb);
    const double p2 = ones.dot(q * ones), p1 = ones.dot(q * t), p0 = t.dot(q * t) - 1.0;
    const double discriminant = p1 * p1 - p2 * p0;
    if (discriminant < 0.0) return kInfinity;
    const double time = (p1 + std::sqrt(discriminant)) / p2;
    const Eigen::Vector2d share = q * (time * ones - t);
    return share.minCoeff() > 0.0 ? time : kInfinity;
}

class FastMarch {
  public:
    FastMarch(const Patch& patch, const Rings& rings) : patch_(patch), rings_(rings) {
        begin_.assign(at(rings.size()) + 1, 0);
        const auto& triangles = patch.triangles.triangle;
        for (const Triangle& t : triangles) {
            for (const Index v : t) ++begin_[v + 1];
        }
        for (Index v = 0; v < rings.size(); ++v) begin_[v + 1] += begin_[v];
        around_.resize(3 * triangles.size());
        std::vector<Index> fill(begin_.begin(), begin_.end() - 1);
        for (std::size_t n = 0; n < triangles.size(); ++n) {
            for (const Index v : triangles[n]) around_[fill[v]++] = index_of(n);
        }
    }

    std::vector<double> run(std::span<const Index> source, Index from) {
        distance_.assign(rings_.size(), kInfinity);
        done_.assign(distance_.size(), 0);
        for (Index v = 0; v < rings_.size(); ++v) {
            if (source[v] == from) reach(v, 0.0);
        }
        while (!queue_.empty()) {
            const Index v = queue_.top().second;
            queue_.pop();
            if (std::exchange(done_[v], 1)) continue;
            pass(v);
        }
        return std::move(distance_);
    }

  private:
    void reach(Index v, double distance) {
        if (done_[v] || !(distance < distance_[v])) return;
        distance_[v] = distance;
        queue_.emplace(distance, v);
    }

    // The distance of v is final: it spreads along edges and, with that of another vertex, through
    // triangles.
    void pass(Index v) {
        const auto& at = patch_.rest;
        for (const Index n : rings_.ring(v)) reach(n, distance_[v] + (at[n] - at[v]).norm());
        for (Index e = begin_[v]; e < begin_[v + 1]; ++e) {
            const Triangle& t = patch_.triangles.triangle[around_[e]];
            const std::size_t k = std::find(t.begin(), t.end(), v) - t.begin();
            for (const std::size_t step : {1, 2}) {
                const Index a = t[(k + step) % 3], c = t[(k + 3 - step) % 3];
                if (!done_[a] || done_[c]) continue;
                reach(c, front_arrival(at[v], at[a], at[c], distance_[v], distance_[a]));
            }
        }
    }

    const Patch& patch_;
    const Rings& rings_;
    std::vector<Index> begin_, around_;
    std::vector<double> distance_;
    std::vector<char> done_;
    std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>,
                        std::greater<>>
        queue_;
};

// Throws if a connected part has vertices without a gradient and no source.
void require_sources(const ComparisonProblem& problem, const Rings& rings) {
    std::vector<char> reached(rings.size(), 0);
    std::vector<Index> stack;
    for (Index v = 0; v < rings.size(); ++v) {
        if (problem.source[v] == kNoIndex) continue;
        reached[v] = 1;
        stack.push_back(v);
    }
    while (!stack.empty()) {
        const Index v = stack.back();
        stack.pop_back();
        for (const Index n : rings.ring(v)) {
            if (!std::exchange(reached[n], 1)) stack.push_back(n);
        }
    }
    Elements free{ElementKind::vertex, 0, {}};
    for (Index v = 0; v < rings.size(); ++v) {
        if (!reached[v]) free.add(problem.patch.mesh_vertex[v]);
    }
    if (free.count == 0) return;
    const std::string names = describe(free);
    throw Error(ErrorCode::unconstrained,
                "no gradient is prescribed on the connected part of " + names +
                    ", and this method propagates gradients; add a handle with a gradient there",
                std::move(free));
}

SourceWeights no_weights(const ComparisonProblem& problem, const Rings& rings) {
    SourceWeights weights{problem.source_count, {}};
    weights.value.assign(at(rings.size()) * weights.sources, 0.0);
    for (Index v = 0; v < rings.size(); ++v) {
        const Index s = problem.source[v];
        if (s != kNoIndex) weights.value[at(v) * weights.sources + s] = 1.0;
    }
    return weights;
}

void normalise(std::span<double> values) {
    double sum = 0.0;
    for (const double w : values) sum += w;
    for (double& w : values) w /= sum;
}

}  // namespace

std::vector<double> patch_distances(const Patch& patch, const Rings& rings,
                                    std::span<const Index> source, Index from) {
    return FastMarch(patch, rings).run(source, from);
}

SourceWeights geodesic_weights(const ComparisonProblem& problem, const Rings& rings,
                               const Context& context) {
    require_sources(problem, rings);
    SourceWeights weights = no_weights(problem, rings);
    FastMarch march(problem.patch, rings);
    for (Index s = 0; s < weights.sources; ++s) {
        context.checkpoint();
        const std::vector<double> distance = march.run(problem.source, s);
        for (Index v = 0; v < rings.size(); ++v) {
            if (problem.source[v] != kNoIndex) continue;
            weights.value[at(v) * weights.sources + s] =
                1.0 / std::max(distance[v], kSmallestDistance);
        }
    }
    for (Index v = 0; v < rings.size(); ++v) {
        normalise({weights.value.data() + at(v) * weights.sources, at(weights.sources)});
    }
    return weights;
}

std::vector<double> positive_edge_weights(const ComparisonProblem& problem, const Rings& rings) {
    if (problem.options.weights == LaplacianWeights::uniform) {
        return std::vector<double>(rings.neighbor.size(), 1.0);
    }
    const std::span<const Vec3> rest = problem.patch.rest;
    std::vector<double> weights =
        ring_geometry(rings, problem.patch.triangles, rest.first(rings.begin.size() - 1)).cotangent;
    for (double& w : weights) w = std::max(w, kSmallestCotangent);
    return weights;
}

SourceWeights harmonic_weights(const ComparisonProblem& problem, const Rings& rings,
                               const Context& context, ComparisonCosts& costs) {
    require_sources(problem, rings);
    SourceWeights weights = no_weights(problem, rings);
    const std::vector<double> edge_weight = positive_edge_weights(problem, rings);
    LeastSquares system(rings.size());
    for (Index i = 0; i < rings.size(); ++i) {
        for (Index e = rings.begin[i]; e < rings.begin[i + 1]; ++e) {
            if (rings.neighbor[e] < i) continue;
            system.add(i, 1.0);
            system.add(rings.neighbor[e], -1.0);
            system.end_row(edge_weight[e]);
        }
    }
    std::vector<char> known;
    for (Index v = 0; v < rings.size(); ++v) known.push_back(problem.source[v] != kNoIndex);
    system.factor(known, context);
    costs.first_nonzeros = system.stats().factor_nonzeros;
    costs.first_seconds = system.stats().analyze_seconds + system.stats().factor_seconds;

    std::vector<double> x(known.size());
    for (Index s = 0; s < weights.sources; ++s) {
        for (Index v = 0; v < rings.size(); ++v) x[v] = problem.source[v] == s ? 1.0 : 0.0;
        system.solve({}, x, 1, context);
        for (const Index v : system.free_unknowns()) {
            weights.value[at(v) * weights.sources + s] = std::clamp(x[v], 0.0, 1.0);
        }
    }
    for (const Index v : system.free_unknowns()) {
        normalise({weights.value.data() + at(v) * weights.sources, at(weights.sources)});
    }
    return weights;
}

}  // namespace lissom
