#include "kernel/mesh/edit/align.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

using Vec7 = Eigen::Matrix<double, 7, 1>;
using Mat7 = Eigen::Matrix<double, 7, 7>;

// Weight of the distance between points beside that along the normal: surfaces without features do
// not drift along themselves.
constexpr double kPointWeight = 0.02;
constexpr double kDamping = 1e-9;
// Area of a line of size 1, from rounding.
constexpr double kLeastArea = 1e-12;
constexpr double kLargestTurn = 0.5, kLargestGrowth = 0.3;
constexpr double kStillMotion = 1e-6;
constexpr Index kTrialSamples = 300, kTrialSteps = 12;

struct Similarity {
    double scale = 1.0;
    Mat3 turn = Mat3::Identity();
    Vec3 shift = Vec3::Zero();

    Vec3 operator()(const Vec3& p) const { return scale * (turn * p) + shift; }
    Vec3 back(const Vec3& p) const { return turn.transpose() * (p - shift) / scale; }
    Affine affine() const { return {scale * turn, shift}; }
};

// A point of the moved mesh and its counterpart, with the normal there.
struct Match {
    Vec3 point, counterpart, normal;
    double distance = 0.0;
};

struct Fit {
    Similarity map;
    double residual = std::numeric_limits<double>::infinity(), greatest = 0.0;
    Index iterations = 0;
    bool converged = false;
};

std::vector<Vec3> samples_of(const Mesh& mesh, Index wanted) {
    std::vector<Vec3> used, samples;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.topology().is_isolated(v)) used.push_back(mesh.position(v));
    }
    const std::size_t count = std::min(at(wanted), used.size());
    for (std::size_t i = 0; i < count; ++i) samples.push_back(used[i * used.size() / count]);
    return samples;
}

class Alignment {
  public:
    Alignment(const Mesh& mesh, const Mesh& target, const AlignOptions& options,
              const Context& context)
        : mesh_(mesh),
          target_(target),
          options_(options),
          context_(context),
          mesh_tree_(mesh, context),
          target_tree_(target, context),
          size_(surface_radius(target)) {}

    Fit run(Progress& progress) {
        use_samples(options_.samples);
        Fit fit;
        fit.map = options_.start == AlignStart::axes ? by_axes() : Similarity{};
        use_samples(options_.samples);
        before_ = measured(options_.start == AlignStart::axes ? Similarity{} : fit.map).residual;
        return refined(fit.map, options_.iterations, &progress);
    }

    double residual_before() const { return before_; }

  private:
    void use_samples(Index count) {
        mesh_samples_ = samples_of(mesh_, count);
        target_samples_ = samples_of(target_, count);
    }

    std::vector<Match> matches(const Similarity& map) const {
        std::vector<Match> result;
        for (const Vec3& p : mesh_samples_) {
            const Vec3 moved = map(p);
            context_.checkpoint();
            const SurfacePoint hit = target_tree_.nearest(moved);
            result.push_back({moved, hit.position, hit.normal, hit.distance});
        }
        for (const Vec3& p : target_samples_) {
            context_.checkpoint();
            const SurfacePoint hit = mesh_tree_.nearest(map.back(p));
            result.push_back(
                {map(hit.position), p, map.turn * hit.normal, map.scale * hit.distance});
        }
        const auto kept = static_cast<std::size_t>(
            std::ceil(options_.overlap * static_cast<double>(result.size())));
        std::stable_sort(result.begin(), result.end(),
                         [](const Match& a, const Match& b) { return a.distance < b.distance; });
        result.resize(std::min(kept, result.size()));
        return result;
    }

    static double rms(const std::vector<Match>& matches) {
        double sum = 0.0;
        for (const Match& match : matches) sum += match.distance * match.distance;
        return std::sqrt(sum / static_cast<double>(matches.size()));
    }

    Fit measured(const Similarity& map) const {
        const std::vector<Match> found = matches(map);
        return {map, rms(found), found.back().distance};
    }

    // The best of all steps.
    Fit refined(Similarity map, Index steps, Progress* progress) const {
        Fit best;
        for (Index i = 0; i <= steps; ++i) {
            context_.checkpoint();
            if (progress) progress->update(i, steps + 1);
            const std::vector<Match> found = matches(map);
            const double residual = rms(found);
            if (residual < best.residual) {
                best.map = map;
                best.residual = residual;
                best.greatest = found.back().distance;
            }
            best.iterations = i;
            if (i == steps) break;
            if (!step(found, map)) {
                best.converged = true;
                break;
            }
        }
        return best;
    }

    // The motion w x (p - c) + s (p - c) + t that brings the matches together; false if it is
    // still.
    bool step(const std::vector<Match>& found, Similarity& map) const {
        Vec3 center = Vec3::Zero();
        for (const Match& match : found) center += match.point;
        center /= static_cast<double>(found.size());
        Mat7 matrix = Mat7::Zero();
        Vec7 right = Vec7::Zero();
        for (const Match& match : found) add(match, center, matrix, right);
        if (!options_.scale) {
            matrix.row(6).setZero();
            matrix.col(6).setZero();
            matrix(6, 6) = 1.0;
            right[6] = 0.0;
        }
        for (Eigen::Index k = 0; k < 7; ++k) matrix(k, k) *= 1.0 + kDamping;
        Vec7 motion = matrix.ldlt().solve(right);
        if (!motion.allFinite()) return false;
        // Turns and growth were measured in sizes.
        Vec3 turn = motion.head<3>() / size_;
        const double angle = turn.norm();
        if (angle > kLargestTurn) turn *= kLargestTurn / angle;
        const double growth = std::clamp(motion[6] / size_, -kLargestGrowth, kLargestGrowth);
        const Mat3 rotation =
            angle > 0.0 ? Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()
                        : Mat3::Identity();
        const double factor = std::exp(growth);
        map.shift =
            center + factor * (rotation * (map.shift - center)) + Vec3(motion.segment<3>(3));
        map.turn = Eigen::Quaterniond(rotation * map.turn).normalized().toRotationMatrix();
        map.scale *= factor;
        return motion.cwiseAbs().maxCoeff() > kStillMotion * size_;
    }

    void add(const Match& match, const Vec3& center, Mat7& matrix, Vec7& right) const {
        const Vec3 arm = (match.point - center) / size_;
        const Vec3 gap = match.counterpart - match.point;
        const auto add_row = [&](const Vec3& n, double weight) {
            Vec7 row;
            row << arm.cross(n), n, arm.dot(n);
            matrix += weight * row * row.transpose();
            right += weight * n.dot(gap) * row;
        };
        add_row(match.normal, 1.0);
        for (int k = 0; k < 3; ++k) add_row(Vec3::Unit(k), kPointWeight);
    }

    struct Axes {
        Vec3 center = Vec3::Zero();
        Mat3 axes = Mat3::Identity();
        double radius = 0.0;
    };

    static Axes axes_of(const std::vector<Vec3>& points) {
        Axes result;
        for (const Vec3& p : points) result.center += p;
        result.center /= static_cast<double>(points.size());
        Mat3 covariance = Mat3::Zero();
        for (const Vec3& p : points) {
            const Vec3 d = p - result.center;
            covariance += d * d.transpose();
        }
        result.radius = std::sqrt(covariance.trace() / static_cast<double>(points.size()));
        result.axes = Eigen::SelfAdjointEigenSolver<Mat3>(covariance).eigenvectors();
        return result;
    }

    Similarity by_axes() {
        const Axes from = axes_of(mesh_samples_), to = axes_of(target_samples_);
        use_samples(std::min(options_.samples, kTrialSamples));
        Fit best;
        std::array<int, 3> order{0, 1, 2};
        do {
            for (int signs = 0; signs < 8; ++signs) {
                Mat3 axes;
                for (int k = 0; k < 3; ++k) {
                    const double sign = (signs >> k & 1) != 0 ? -1.0 : 1.0;
                    axes.col(k) = sign * to.axes.col(order[static_cast<std::size_t>(k)]);
                }
                Similarity map;
                map.turn = axes * from.axes.transpose();
                if (map.turn.determinant() < 0.0) continue;
                if (options_.scale && from.radius > 0.0) map.scale = to.radius / from.radius;
                map.shift = to.center - map.scale * (map.turn * from.center);
                Fit fit = refined(map, kTrialSteps, nullptr);
                if (fit.residual < best.residual) best = fit;
            }
        } while (std::next_permutation(order.begin(), order.end()));
        return best.map;
    }

    const Mesh& mesh_;
    const Mesh& target_;
    const AlignOptions& options_;
    const Context& context_;
    SpatialTree mesh_tree_, target_tree_;
    double size_, before_ = 0.0;
    std::vector<Vec3> mesh_samples_, target_samples_;
};

bool has_area(const Mesh& mesh) {
    const double size = surface_radius(mesh);
    return size > 0.0 && area(mesh) > kLeastArea * size * size;
}

}  // namespace

AlignReport align(const Mesh& mesh, const Mesh& target, const AlignOptions& options,
                  const Context& context) {
    require(mesh.face_count() > 0 && target.face_count() > 0, "a surface to align has no faces",
            ErrorCode::mesh_empty);
    require(options.overlap > 0.0 && options.overlap <= 1.0,
            "the overlap must be above 0 and at most 1");
    require(options.samples >= 10, "alignment needs at least 10 samples");
    require(options.iterations >= 0, "the number of steps is negative");
    require(has_area(mesh) && has_area(target),
            "a surface to align has no area: all of it is on a point or a line");
    Progress progress(context, "align");
    Alignment alignment(mesh, target, options, context);
    const Fit fit = alignment.run(progress);
    AlignReport report;
    report.transform = fit.map.affine();
    report.scale = fit.map.scale;
    report.residual_before = alignment.residual_before();
    report.residual = fit.residual;
    report.greatest = fit.greatest;
    report.iterations = fit.iterations;
    report.converged = fit.converged;
    return report;
}

}  // namespace lissom
