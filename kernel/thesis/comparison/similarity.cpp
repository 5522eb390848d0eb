#include "kernel/thesis/comparison/similarity.h"

#include <Eigen/LU>
#include <cmath>

#include "kernel/deform/patch/operators.h"
#include "kernel/thesis/comparison/system.h"

namespace lissom {
namespace {

Mat3 cross_matrix(const Vec3& v) {
    Mat3 m;
    m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
    return m;
}

// The least-squares T = s I + [h] that takes points p_k, relative to their mean, to points q_k:
// s = sum p . q / sum |p|^2 and h = (sum |p|^2 I - p p^T)^-1 sum p x q.
class SimilarityFit {
  public:
    SimilarityFit(const Rings& rings, std::span<const Vec3> rest, Index i) {
        mean_ = rest[i];
        for (const Index j : rings.ring(i)) mean_ += rest[j];
        mean_ /= rings.count(i) + 1;
        Mat3 inertia = Mat3::Zero();
        const auto add = [&](const Vec3& point) {
            const Vec3 p = point - mean_;
            squares_ += p.squaredNorm();
            inertia += p.squaredNorm() * Mat3::Identity() - p * p.transpose();
        };
        add(rest[i]);
        for (const Index j : rings.ring(i)) add(rest[j]);
        bool regular = false;
        inertia.computeInverseWithCheck(inverse_, regular, 1e-14 * std::pow(squares_, 3));
        if (!regular) inverse_.setZero();
    }

    // How s and h change with the position of one of the points, at rest `point`.
    Vec3 scale_row(const Vec3& point) const { return (point - mean_) / squares_; }
    Mat3 turn_block(const Vec3& point) const { return inverse_ * cross_matrix(point - mean_); }

  private:
    Vec3 mean_;
    double squares_ = 0.0;
    Mat3 inverse_;
};

class Similarity : public ComparisonMethod {
  public:
    Similarity(const ComparisonProblem& problem, const Context& context)
        : rings_(build_rings(problem.patch.real_count, problem.patch.triangles)),
          rest_(problem.patch.rest.begin(), problem.patch.rest.begin() + rings_.size()),
          system_(3 * rings_.size(), 3) {
        const RingGeometry geometry = ring_geometry(rings_, problem.patch.triangles, rest_);
        const Laplacian laplacian =
            make_laplacian(rings_, geometry, problem.options.weights, problem.options.scale_free);
        for (Index i = 0; i < rings_.size(); ++i) {
            if (rings_.count(i) > 0) add_vertex(laplacian, i);
        }
        std::vector<char> known;
        for (Index i = 0; i < rings_.size(); ++i) {
            known.insert(known.end(), 3, problem.known.position[i]);
        }
        system_.factor(known, context);
    }

    // The rest shape, scaled and moved, solves the system; deviations from it are solved for.
    void solve(const ComparisonFrame& frame, std::span<Vec3> positions, std::span<Mat3> gradients,
               const Context& context) const override {
        const Mat3& base = frame.base.linear;
        const double scale =
            (base.isDiagonal(0.0) && base == base(0, 0) * Mat3::Identity()) ? base(0, 0) : 1.0;
        std::vector<double> x(3 * rest_.size());
        for (std::size_t i = 0; i < rest_.size(); ++i) {
            const Vec3 deviation = positions[i] - scale * rest_[i] - frame.base.translation;
            for (int d = 0; d < 3; ++d) x[3 * i + d] = deviation[d];
        }
        system_.solve({}, x, 1, context);
        for (const Index u : system_.free_unknowns()) {
            const Index i = u / 3, d = u % 3;
            positions[i][d] = x[u] + scale * rest_[i][d] + frame.base.translation[d];
        }
        for (Index i = 0; i < rings_.size(); ++i) gradients[i] = transform_of(positions, i);
    }

    ComparisonCosts costs() const override {
        const FactorStats& s = system_.stats();
        return {s.factor_nonzeros, 0, s.factor_bytes, s.analyze_seconds + s.factor_seconds, 0.0};
    }

  private:
    // Three rows D(x)_i - T_i(x) delta_i = 0.
    void add_vertex(const Laplacian& laplacian, Index i) {
        const SimilarityFit fit(rings_, rest_, i);
        const Vec3 delta = laplacian.apply(rings_, rest_, i);
        const Mat3 turned = cross_matrix(delta);  // h x delta = -[delta] h
        const auto block = [&](Index k, double coefficient) -> Mat3 {
            return coefficient * Mat3::Identity() - delta * fit.scale_row(rest_[k]).transpose() +
                   turned * fit.turn_block(rest_[k]);
        };
        std::vector<Mat3> blocks{block(i, laplacian.self[i])};
        for (Index e = rings_.begin[i]; e < rings_.begin[i + 1]; ++e) {
            blocks.push_back(block(rings_.neighbor[e], laplacian.neighbor[e]));
        }
        for (int d = 0; d < 3; ++d) {
            for (std::size_t n = 0; n < blocks.size(); ++n) {
                const Index k = n == 0 ? i : rings_.ring(i)[n - 1];
                for (int c = 0; c < 3; ++c) system_.add(3 * k + c, blocks[n](d, c));
            }
            system_.end_row(laplacian.weight[i]);
        }
    }

    Mat3 transform_of(std::span<const Vec3> at, Index i) const {
        if (rings_.count(i) == 0) return Mat3::Identity();
        const SimilarityFit fit(rings_, rest_, i);
        double scale = fit.scale_row(rest_[i]).dot(at[i]);
        Vec3 turn = fit.turn_block(rest_[i]) * at[i];
        for (const Index j : rings_.ring(i)) {
            scale += fit.scale_row(rest_[j]).dot(at[j]);
            turn += fit.turn_block(rest_[j]) * at[j];
        }
        return scale * Mat3::Identity() + cross_matrix(turn);
    }

    Rings rings_;
    std::vector<Vec3> rest_;
    LeastSquares system_;
};

}  // namespace

std::unique_ptr<ComparisonMethod> make_similarity(const ComparisonProblem& problem,
                                                  const Context& context) {
    return std::make_unique<Similarity>(problem, context);
}

}  // namespace lissom
