#include "kernel/thesis/comparison/laplacian.h"

#include <Eigen/Geometry>

#include "kernel/deform/patch/operators.h"
#include "kernel/thesis/comparison/system.h"

namespace lissom {
namespace {

// A projected edge shorter than this fraction of the edge gives no direction.
constexpr double kShortest = 1e-6;

class LaplacianMethod : public ComparisonMethod {
  public:
    LaplacianMethod(const ComparisonProblem& problem, const Context& context)
        : rings_(build_rings(problem.patch.real_count, problem.patch.triangles)),
          rest_(problem.patch.rest.begin(), problem.patch.rest.begin() + rings_.size()),
          system_(rings_.size()) {
        const RingGeometry geometry = ring_geometry(rings_, problem.patch.triangles, rest_);
        laplacian_ =
            make_laplacian(rings_, geometry, problem.options.weights, problem.options.scale_free);
        for (Index i = 0; i < rings_.size(); ++i) {
            system_.add(i, laplacian_.self[i]);
            for (Index e = rings_.begin[i]; e < rings_.begin[i + 1]; ++e) {
                system_.add(rings_.neighbor[e], laplacian_.neighbor[e]);
            }
            system_.end_row(laplacian_.weight[i]);
        }
        const std::span<const char> known = problem.known.position;
        system_.factor(known.first(rest_.size()), context);
    }

    void solve(const ComparisonFrame& frame, std::span<Vec3> positions, std::span<Mat3> gradients,
               const Context& context) const override {
        reconstruct(frame.base.translation, {}, positions, context);
        for (Mat3& m : gradients) m.setIdentity();
    }

    ComparisonCosts costs() const override {
        const FactorStats& s = system_.stats();
        return {s.factor_nonzeros, 0, s.factor_bytes, s.analyze_seconds + s.factor_seconds, 0.0};
    }

  protected:
    // Positions for D(x)_i = M_i delta_i, solved for deviations from the rest shape moved by
    // `shift`. No transforms are identities.
    void reconstruct(const Vec3& shift, std::span<const Mat3> transforms, std::span<Vec3> positions,
                     const Context& context) const {
        const std::size_t n = rest_.size();
        std::vector<double> b, x(3 * n);
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 deviation = positions[i] - rest_[i] - shift;
            for (int d = 0; d < 3; ++d) x[d * n + i] = deviation[d];
        }
        if (!transforms.empty()) {
            b.resize(3 * n);
            for (Index i = 0; i < rings_.size(); ++i) {
                const Vec3 delta = laplacian_.apply(rings_, rest_, i);
                const Vec3 change = transforms[i] * delta - delta;
                for (int d = 0; d < 3; ++d) b[d * n + i] = change[d];
            }
        }
        system_.solve(b, x, 3, context);
        for (const Index i : system_.free_unknowns()) {
            positions[i] = rest_[i] + shift + Vec3(x[i], x[n + i], x[2 * n + i]);
        }
    }

    Rings rings_;
    std::vector<Vec3> rest_;

  private:
    Laplacian laplacian_;
    LeastSquares system_;
};

class RotationEstimate : public LaplacianMethod {
  public:
    RotationEstimate(const ComparisonProblem& problem, const Context& context)
        : LaplacianMethod(problem, context), triangles_(problem.patch.triangles) {
        rest_normal_ = normals(rest_);
        for (Index i = 0; i < rings_.size(); ++i) edge_.push_back(longest_projection(i));
    }

    void solve(const ComparisonFrame& frame, std::span<Vec3> positions, std::span<Mat3> gradients,
               const Context& context) const override {
        reconstruct(frame.base.translation, {}, positions, context);
        const std::vector<Vec3> normal = normals(positions);
        for (Index i = 0; i < rings_.size(); ++i) {
            const Mat3 before = local_frame(rest_, rest_normal_[i], i);
            const Mat3 after = local_frame(positions, normal[i], i);
            const bool both = !before.isZero() && !after.isZero();
            gradients[i] = both ? Mat3(after * before.transpose()) : Mat3(Mat3::Identity());
        }
        reconstruct(frame.base.translation, gradients, positions, context);
    }

  private:
    // Normals averaged over each vertex and its ring.
    std::vector<Vec3> normals(std::span<const Vec3> positions) const {
        const RingGeometry geometry = ring_geometry(rings_, triangles_, positions);
        std::vector<Vec3> result;
        for (Index i = 0; i < rings_.size(); ++i) {
            Vec3 sum = geometry.normal[i];
            for (const Index j : rings_.ring(i)) sum += geometry.normal[j];
            const double length = sum.norm();
            result.push_back(length > 0.0 ? Vec3(sum / length) : Vec3(Vec3::Zero()));
        }
        return result;
    }

    // The neighbour whose edge has the longest projection to the tangent plane at rest.
    Index longest_projection(Index i) const {
        Index best = kNoIndex;
        double longest = 0.0;
        for (const Index j : rings_.ring(i)) {
            const double length = rest_normal_[i].cross(rest_[j] - rest_[i]).norm();
            if (length <= longest * (1.0 + 1e-9)) continue;
            longest = length;
            best = j;
        }
        return best;
    }

    // Normal, projected edge and their cross product as columns; zero if they are degenerate.
    Mat3 local_frame(std::span<const Vec3> at, const Vec3& normal, Index i) const {
        Mat3 frame = Mat3::Zero();
        if (edge_[i] == kNoIndex || normal.isZero()) return frame;
        const Vec3 edge = at[edge_[i]] - at[i];
        const Vec3 projected = edge - normal.dot(edge) * normal;
        const double length = projected.norm();
        if (!(length > kShortest * edge.norm())) return frame;
        frame.col(0) = normal;
        frame.col(1) = projected / length;
        frame.col(2) = normal.cross(frame.col(1));
        return frame;
    }

    const WeightedTriangles& triangles_;
    std::vector<Vec3> rest_normal_;
    std::vector<Index> edge_;
};

}  // namespace

std::unique_ptr<ComparisonMethod> make_naive(const ComparisonProblem& problem,
                                             const Context& context) {
    return std::make_unique<LaplacianMethod>(problem, context);
}

std::unique_ptr<ComparisonMethod> make_rotation_estimate(const ComparisonProblem& problem,
                                                         const Context& context) {
    return std::make_unique<RotationEstimate>(problem, context);
}

}  // namespace lissom
