#include "kernel/thesis/comparison/frames.h"

#include "kernel/deform/rotation/polar.h"
#include "kernel/thesis/comparison/fields.h"
#include "kernel/thesis/comparison/system.h"

namespace lissom {
namespace {

class Frames : public ComparisonMethod {
  public:
    Frames(const ComparisonProblem& problem, const Context& context)
        : rings_(build_rings(problem.patch.real_count, problem.patch.triangles)),
          rest_(problem.patch.rest),
          weights_(harmonic_weights(problem, rings_, context, costs_)),
          system_(rings_.size()) {
        const std::vector<double> edge_weight = positive_edge_weights(problem, rings_);
        for (Index i = 0; i < rings_.size(); ++i) {
            for (Index e = rings_.begin[i]; e < rings_.begin[i + 1]; ++e) {
                system_.add(rings_.neighbor[e], 1.0);
                system_.add(i, -1.0);
                system_.end_row(edge_weight[e]);
            }
        }
        const std::span<const char> known = problem.known.position;
        system_.factor(known.first(rings_.size()), context);
    }

    // Solved for deviations from the rigid part of the base transform.
    void solve(const ComparisonFrame& frame, std::span<Vec3> positions, std::span<Mat3> gradients,
               const Context& context) const override {
        const Affine base{nearest_rotation(frame.base.linear), frame.base.translation};
        const std::size_t n = positions.size(), rows = rings_.neighbor.size();
        solve_frames(frame, gradients);
        std::vector<double> b(3 * rows), x(3 * n);
        for (Index i = 0; i < rings_.size(); ++i) {
            const Mat3 change = gradients[i] - base.linear;
            for (Index e = rings_.begin[i]; e < rings_.begin[i + 1]; ++e) {
                const Vec3 edge = change * (rest_[rings_.neighbor[e]] - rest_[i]);
                for (int d = 0; d < 3; ++d) b[d * rows + e] = edge[d];
            }
            const Vec3 deviation = positions[i] - base(rest_[i]);
            for (int d = 0; d < 3; ++d) x[d * n + i] = deviation[d];
        }
        system_.solve(b, x, 3, context);
        for (const Index i : system_.free_unknowns()) {
            positions[i] = base(rest_[i]) + Vec3(x[i], x[n + i], x[2 * n + i]);
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
    // The first system, and orthonormal frames from its solution.
    void solve_frames(const ComparisonFrame& frame, std::span<Mat3> rotations) const {
        std::vector<Mat3> known;
        for (const SourceMotion& s : frame.sources) known.push_back(nearest_rotation(s.gradient));
        for (Index i = 0; i < rings_.size(); ++i) {
            const std::span<const double> weights = weights_.at(i);
            Mat3 sum = Mat3::Zero();
            for (std::size_t s = 0; s < known.size(); ++s) sum += weights[s] * known[s];
            rotations[i] = nearest_rotation(sum);
        }
    }

    Rings rings_;
    const std::vector<Vec3>& rest_;
    ComparisonCosts costs_;
    SourceWeights weights_;
    LeastSquares system_;
};

}  // namespace

std::unique_ptr<ComparisonMethod> make_frames(const ComparisonProblem& problem,
                                              const Context& context) {
    return std::make_unique<Frames>(problem, context);
}

}  // namespace lissom
