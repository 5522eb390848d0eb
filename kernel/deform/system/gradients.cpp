#include "kernel/deform/system/gradients.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "kernel/core/extended.h"

namespace lissom {
namespace {

// Distances that differ by less than this fraction of the greatest are the same.
constexpr double kSameDistance = 1e-9;

// A gradient exists up to this condition number at least: a lower threshold asks for displacements,
// but may be one that none of them reaches.
constexpr double kGoodCondition = 2e4;

class Displacer {
  public:
    Displacer(const Patch& patch, const Rings& rings, const RingGeometry& geometry,
              const KnownMask& known, const Vec3& start, const DeformOptions& options)
        : patch_(patch),
          rings_(rings),
          point_(patch.rest.size(), kNoIndex),
          geometry_(geometry),
          known_(known),
          start_(start),
          options_(options),
          greatest_(std::max(options.degenerate_threshold, kGoodCondition)) {
        for (std::size_t k = 0; k < patch.normal_points.size(); ++k) {
            point_[at(patch.normal_points[k])] = patch.first_normal_point() + index_of(k);
        }
        result_.displaced_rest = patch.rest;
        moved_.assign(patch.rest.size(), 0);
        sound_.assign(patch.rest.size(), 0);
    }

    GradientStencils run() {
        for (const std::vector<Index>& shell : shells(degenerate_vertices())) {
            std::vector<Index> still;
            std::copy_if(shell.begin(), shell.end(), std::back_inserter(still),
                         [&](Index i) { return is_degenerate(i); });
            for (const Index i : still) repair(i);
        }
        // Vertices that moved in unison, or were flattened by a neighbour that moved, are taken one
        // by one.
        threshold_ = greatest_;
        std::fill(moved_.begin(), moved_.end(), char{0});
        for (const Index i : degenerate_vertices()) {
            if (is_degenerate(i)) repair(i);
        }
        for (Index i = 0; i < patch_.first_normal_point(); ++i) {
            if (result_.displaced_rest[i] != patch_.rest[i]) result_.displaced.push_back(i);
        }
        fill_stencils();
        return std::move(result_);
    }

  private:
    std::vector<Index> degenerate_vertices() {
        std::vector<Index> found;
        for (Index i = 0; i < rings_.size(); ++i) {
            if (!known_.gradient_wanted[i] || known_.position[i] || is_sound(i)) continue;
            found.push_back(i);
        }
        return found;
    }

    // Not degenerate; asked once only for as long as nothing around has moved.
    bool is_sound(Index i) {
        if (!sound_[i]) sound_[i] = !is_degenerate(i);
        return sound_[i];
    }

    // Groups vertices at the same distance from the start, nearest first. This order does not
    // depend on the frame or on how vertices are numbered, and vertices that a symmetry exchanges
    // stay together.
    std::vector<std::vector<Index>> shells(const std::vector<Index>& vertices) const {
        std::vector<std::pair<double, Index>> order;
        for (const Index i : vertices) order.emplace_back((patch_.rest[i] - start_).norm(), i);
        std::sort(order.begin(), order.end());
        const double tolerance = order.empty() ? 0.0 : kSameDistance * order.back().first;
        std::vector<std::vector<Index>> groups;
        for (std::size_t n = 0; n < order.size(); ++n) {
            if (n == 0 || order[n].first - order[n - 1].first > tolerance) groups.emplace_back();
            groups.back().push_back(order[n].second);
        }
        return groups;
    }

    // Without the normal point, which is the last of its ring.
    std::span<const Index> ring(Index i) const {
        const std::span<const Index> all = rings_.ring(i);
        return point_[at(i)] == kNoIndex ? all : all.first(all.size() - 1);
    }

    Vec3 ring_center(Index i) const {
        Vec3 sum = Vec3::Zero();
        for (const Index j : ring(i)) sum += result_.displaced_rest[j];
        return sum / static_cast<double>(ring(i).size());
    }

    // Sum of (v_j - c)(v_j - c)^T over the ring alone.
    Mat3 ring_covariance(Index i, const Vec3& center) const {
        Mat3 covariance = Mat3::Zero();
        for (const Index j : ring(i)) {
            const Vec3 d = result_.displaced_rest[j] - center;
            covariance.noalias() += d * d.transpose();
        }
        return covariance;
    }

    // V_i V_i^T of Eq 2.5, with the offset of the normal point if there is one.
    Mat3 stencil_covariance(Index i, const Vec3& center) const {
        const Vec3 d = result_.displaced_rest[i] - center;
        const Mat3 covariance = ring_covariance(i, center) + d * d.transpose();
        if (point_[at(i)] == kNoIndex) return covariance;
        const Vec3 offset = result_.displaced_rest[at(point_[at(i)])] - result_.displaced_rest[i];
        return covariance + offset * offset.transpose();
    }

    bool is_degenerate(Index i) const {
        if (rings_.count(i) == 0) return true;
        const Eigen::Vector3d values = eigenvalues(stencil_covariance(i, ring_center(i)));
        return !(values[0] * threshold_ > values[2]);
    }

    bool has_collinear_ring(Index i) const {
        const Eigen::Vector3d values = eigenvalues(ring_covariance(i, ring_center(i)));
        return !(values[1] * greatest_ > values[2]);
    }

    static Eigen::Vector3d eigenvalues(const Mat3& covariance) {
        Eigen::SelfAdjointEigenSolver<Mat3> solver;
        solver.computeDirect(covariance, Eigen::EigenvaluesOnly);
        return solver.eigenvalues();
    }

    // Eq 2.9, applied to `target`.
    bool displace(Index target) {
        if (moved_[target] || known_.position[target] || geometry_.normal[target].isZero())
            return false;
        double length = 0.0;
        for (const Index j : ring(target)) length += (patch_.rest[target] - patch_.rest[j]).norm();
        const Vec3 step = options_.displacement * length /
                          static_cast<double>(ring(target).size()) * geometry_.normal[target];
        result_.displaced_rest[target] += step;
        if (point_[at(target)] != kNoIndex) result_.displaced_rest[at(point_[at(target)])] += step;
        moved_[target] = 1;
        sound_[target] = 0;
        for (const Index j : rings_.ring(target)) sound_[j] = 0;
        return true;
    }

    // In a collinear ring, moving i itself leaves it degenerate: a neighbour moves, inner ones
    // first.
    void repair(Index i) {
        if (rings_.count(i) == 0) return;
        if (!has_collinear_ring(i)) {
            displace(i);
            return;
        }
        for (const bool boundary : {false, true}) {
            for (const Index j : ring(i)) {
                if (static_cast<bool>(patch_.on_boundary[j]) != boundary || !displace(j)) continue;
                if (is_degenerate(i)) displace(i);
                if (!is_degenerate(i)) return;
            }
        }
    }

    // p_k = (V V^T)^-1 (v_k - c); the mean over the ring is subtracted as c depends on the ring. In
    // extended precision, as M_i must be the identity at rest however flat the ring is.
    void fill_stencil(Index i) {
        using Vector = Eigen::Matrix<Extended, 3, 1>;
        using Matrix = Eigen::Matrix<Extended, 3, 3>;
        const auto at = [&](Index k) -> Vector {
            return result_.displaced_rest[k].cast<Extended>();
        };
        const std::span<const Index> around = ring(i);
        const auto count = count_of(around);
        Vector center = Vector::Zero();
        for (const Index j : around) center += at(j) / count;
        Matrix covariance = (at(i) - center) * (at(i) - center).transpose();
        for (const Index j : around) {
            covariance += (at(j) - center) * (at(j) - center).transpose();
        }
        const Index point = point_[lissom::at(i)];
        const Vector offset = point == kNoIndex ? Vector(Vector::Zero()) : at(point) - at(i);
        if (point != kNoIndex) covariance += offset * offset.transpose();
        const Matrix inverse = covariance.inverse();
        const Vector own = inverse * (at(i) - center);
        for (Index k = 0; k < count; ++k) {
            const Vector p = inverse * (at(around[lissom::at(k)]) - center);
            result_.neighbor[rings_.begin[i] + k] = (p - own / count).cast<double>();
        }
        result_.self[i] = own.cast<double>();
        if (point == kNoIndex) return;
        const Vector across = inverse * offset;
        result_.self[i] = (own - across).cast<double>();
        result_.neighbor[rings_.begin[i] + count] = across.cast<double>();
    }

    void fill_stencils() {
        result_.defined.assign(rings_.size(), 0);
        result_.self.assign(rings_.size(), Vec3::Zero());
        result_.neighbor.assign(rings_.neighbor.size(), Vec3::Zero());
        for (Index i = 0; i < rings_.size(); ++i) {
            if (!known_.gradient_wanted[i] || !is_sound(i)) continue;
            result_.defined[i] = 1;
            fill_stencil(i);
        }
        for (const Index v : patch_.normal_points) {
            if (!has_turning_neighbor(v)) result_.defined[at(v)] = 0;
        }
    }

    // Whether a gradient around i says how its normal point moves.
    bool has_turning_neighbor(Index i) const {
        const std::span<const Index> around = ring(i);
        return std::any_of(around.begin(), around.end(), [&](Index j) {
            return known_.gradient[at(j)] || result_.defined[at(j)];
        });
    }

    const Patch& patch_;
    const Rings& rings_;
    /// The normal point of each local vertex, or kNoIndex.
    std::vector<Index> point_;
    const RingGeometry& geometry_;
    const KnownMask& known_;
    const Vec3& start_;
    const DeformOptions& options_;
    /// Condition number above which a gradient does not exist, and above which a vertex counts as
    /// degenerate: at first as the options say, then for vertices without a gradient yet.
    double greatest_, threshold_ = options_.degenerate_threshold;
    GradientStencils result_;
    /// Displaced vertices, and vertices known not to be degenerate: the threshold only grows.
    std::vector<char> moved_, sound_;
};

}  // namespace

Mat3 GradientStencils::gather(const Rings& rings, std::span<const Vec3> x, Index i) const {
    Mat3 m = x[i] * self[i].transpose();
    for (Index e = rings.begin[i]; e < rings.begin[i + 1]; ++e) {
        m.noalias() += x[rings.neighbor[e]] * neighbor[e].transpose();
    }
    return m;
}

GradientStencils make_gradients(const Patch& patch, const Rings& rings,
                                const RingGeometry& geometry, const KnownMask& known,
                                const Vec3& start, const DeformOptions& options) {
    return Displacer(patch, rings, geometry, known, start, options).run();
}

}  // namespace lissom
