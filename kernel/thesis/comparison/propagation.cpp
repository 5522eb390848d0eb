#include "kernel/thesis/comparison/propagation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kernel/deform/rotation/winding.h"
#include "kernel/thesis/comparison/fields.h"
#include "kernel/thesis/comparison/system.h"

namespace lissom {
namespace {

// Triangles count as having at least the area of one with an angle of half a degree.
const double kSmallestSine = std::sin(0.5 * kPi / 180.0);

class Propagation : public ComparisonMethod {
  public:
    Propagation(const ComparisonProblem& problem, const Context& context)
        : triangles_(problem.patch.triangles),
          rest_(problem.patch.rest),
          system_(problem.patch.real_count) {
        const Rings rings = build_rings(problem.patch.real_count, triangles_);
        weights_ = problem.options.method == DeformMethod::geodesic
                       ? geodesic_weights(problem, rings, context)
                       : harmonic_weights(problem, rings, context, costs_);
        for (std::size_t n = 0; n < triangles_.size(); ++n) add_triangle(n);
        const std::span<const char> known = problem.known.position;
        system_.factor(known.first(rings.size()), context);
    }

    // Solved for deviations from the base transform of the rest shape, whose gradients are its
    // linear part.
    void solve(const ComparisonFrame& frame, std::span<Vec3> positions, std::span<Mat3> gradients,
               const Context& context) const override {
        const std::size_t n = positions.size(), rows = 3 * triangles_.size();
        std::vector<Mat3> stretch;
        for (const SourceMotion& s : frame.sources) {
            stretch.push_back(rotation_of_turn(s.rotation).transpose() * s.gradient);
        }
        std::vector<double> mean;
        std::vector<double> b(3 * rows), x(3 * n);
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            const Mat3 change = triangle_transform(frame, stretch, t, mean) - frame.base.linear;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 edge = change * edge_of(t, k);
                for (int d = 0; d < 3; ++d) b[d * rows + 3 * t + k] = edge[d];
            }
        }
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 deviation = positions[i] - frame.base(rest_[i]);
            for (int d = 0; d < 3; ++d) x[d * n + i] = deviation[d];
        }
        system_.solve(b, x, 3, context);
        for (const Index i : system_.free_unknowns()) {
            positions[i] = frame.base(rest_[i]) + Vec3(x[i], x[n + i], x[2 * n + i]);
        }
        for (std::size_t i = 0; i < n; ++i) {
            gradients[i] = blend(frame, stretch, weights_.at(index_of(i)));
        }
    }

    ComparisonCosts costs() const override {
        ComparisonCosts costs = costs_;
        const FactorStats& s = system_.stats();
        costs.second_nonzeros = s.factor_nonzeros;
        costs.factor_bytes = s.factor_bytes + weights_.value.size() * sizeof(double);
        costs.second_seconds = s.analyze_seconds + s.factor_seconds;
        return costs;
    }

  private:
    // The edge opposite corner k.
    Vec3 edge_of(std::size_t triangle, std::size_t k) const {
        const Triangle& t = triangles_.triangle[triangle];
        return rest_[t[(k + 2) % 3]] - rest_[t[(k + 1) % 3]];
    }

    // The integral of |grad x - M grad v|^2 over a triangle is the sum over its edges of cot / 2
    // times the squared difference along the edge.
    void add_triangle(std::size_t n) {
        const Triangle& t = triangles_.triangle[n];
        const Vec3 e[3] = {edge_of(n, 0), edge_of(n, 1), edge_of(n, 2)};
        const double longest =
            std::max({e[0].squaredNorm(), e[1].squaredNorm(), e[2].squaredNorm()});
        const double twice_area = std::max(e[0].cross(e[1]).norm(), kSmallestSine * longest);
        for (std::size_t k = 0; k < 3; ++k) {
            system_.add(t[(k + 2) % 3], 1.0);
            system_.add(t[(k + 1) % 3], -1.0);
            const double cotangent = -e[(k + 1) % 3].dot(e[(k + 2) % 3]) / twice_area;
            system_.end_row(longest > 0.0 ? 0.5 * triangles_.weight[n] * cotangent : 0.0);
        }
    }

    // `stretch` is that of each source.
    static Mat3 blend(const ComparisonFrame& frame, const std::vector<Mat3>& stretch,
                      std::span<const double> weights) {
        Vec3 rotation = Vec3::Zero();
        Mat3 mean_stretch = Mat3::Zero();
        for (std::size_t s = 0; s < weights.size(); ++s) {
            if (weights[s] == 1.0) return frame.sources[s].gradient;
            rotation += weights[s] * frame.sources[s].rotation;
            mean_stretch += weights[s] * stretch[s];
        }
        return rotation_of_turn(rotation) * mean_stretch;
    }

    // `mean` is scratch.
    Mat3 triangle_transform(const ComparisonFrame& frame, const std::vector<Mat3>& stretch,
                            std::size_t n, std::vector<double>& mean) const {
        mean.assign(weights_.sources, 0.0);
        for (const Index v : triangles_.triangle[n]) {
            const std::span<const double> w = weights_.at(v);
            for (std::size_t s = 0; s < mean.size(); ++s) mean[s] += w[s] / 3.0;
        }
        return blend(frame, stretch, mean);
    }

    const WeightedTriangles& triangles_;
    const std::vector<Vec3>& rest_;
    SourceWeights weights_;
    LeastSquares system_;
    ComparisonCosts costs_;
};

}  // namespace

std::unique_ptr<ComparisonMethod> make_propagation(const ComparisonProblem& problem,
                                                   const Context& context) {
    return std::make_unique<Propagation>(problem, context);
}

}  // namespace lissom
