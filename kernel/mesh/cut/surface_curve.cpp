#include "kernel/mesh/cut/surface_curve.h"
#include "kernel/core/geometry.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace lissom {
namespace {

// Samples of a curve: two an edge, within these.
constexpr Index kFewestSamples = 128, kMaxSamples = 8192;

// How far along the curve, as a fraction of its length, a vertex may be from its neighbour.
constexpr double kWindow = 0.08;

// The difference of two parameters of a closed curve, the short way.
double turn_between(double from, double to) {
    const double d = to - from;
    return d - std::round(d);
}

double winding(const ContourLine& line, const CurveDistances& distances) {
    double sum = 0.0;
    const std::size_t n = line.crossings.size();
    const auto parameter = [&](std::size_t i) {
        const Crossing& c = line.crossings[i % n];
        const double from = distances.parameter[c.positive];
        return from + c.t * turn_between(from, distances.parameter[c.negative]);
    };
    for (std::size_t i = 0; i < n; ++i) sum += turn_between(parameter(i), parameter(i + 1));
    return sum;
}

double length_of(const std::vector<Vec3>& points) {
    double length = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        length += (points[(i + 1) % points.size()] - points[i]).norm();
    }
    return length;
}

// Weights of a Gaussian over evenly spaced samples of a closed curve; `sigma` as a fraction of
// their number.
class Gaussian {
  public:
    Gaussian(double sigma, Index count) {
        const double samples = sigma * count;
        reach_ = std::min(static_cast<Index>(std::ceil(3.0 * samples)), (count - 1) / 2);
        double sum = 0.0;
        for (Index k = -reach_; k <= reach_; ++k) {
            weight_.push_back(std::exp(-0.5 * (k / samples) * (k / samples)));
            sum += weight_.back();
        }
        for (double& w : weight_) w /= sum;
    }

    std::vector<Vec3> smoothed(const std::vector<Vec3>& values) const {
        const auto n = count_of(values);
        std::vector<Vec3> result = values;
        for (Index i = 0; i < n; ++i) {
            // Differences keep their digits far from the origin.
            for (Index k = -reach_; k <= reach_; ++k) {
                result[i] += weight_[k + reach_] * (values[(i + k + n) % n] - values[i]);
            }
        }
        return result;
    }

  private:
    Index reach_;
    std::vector<double> weight_;
};

}  // namespace

SurfaceCurve::SurfaceCurve(const Mesh& mesh, std::span<const Index> vertices,
                           const std::vector<Vec3>& normals, double smoothing) {
    std::vector<Vec3> points, at_points;
    for (const Index v : vertices) {
        points.push_back(mesh.position(v));
        at_points.push_back(normals[v]);
    }
    length_ = length_of(points);
    if (!(length_ > 0.0)) {
        throw Error(ErrorCode::invalid_argument,
                    "all vertices of the loop lie at one place; choose a loop with a length");
    }
    sample(points, at_points);
    smooth(smoothing);
    find_left();
}

void SurfaceCurve::sample(std::span<const Vec3> points, std::span<const Vec3> normals) {
    const std::size_t n = points.size();
    const Index count = std::clamp(2 * index_of(n), kFewestSamples, kMaxSamples);
    const double step = length_ / count;
    double before = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 &a = points[i], &b = points[(i + 1) % n];
        const double segment = (b - a).norm();
        while (count_of(points_) < count && points_.size() * step <= before + segment) {
            const double s = points_.size() * step - before;
            const double t = segment > 0.0 ? s / segment : 0.0;
            points_.push_back(a + t * (b - a));
            normals_.push_back((1.0 - t) * normals[i] + t * normals[(i + 1) % n]);
        }
        before += segment;
    }
    while (count_of(points_) < count) {
        points_.push_back(points[0]);
        normals_.push_back(normals[0]);
    }
}

void SurfaceCurve::smooth(double sigma) {
    const Gaussian gaussian(sigma, count_of(points_));
    // The remainder of a first pass is smoothed and added again, 2 S - S S: bends keep their place,
    // whereas a Gaussian alone would draw them inwards.
    const std::vector<Vec3> once = gaussian.smoothed(points_);
    const std::vector<Vec3> twice = gaussian.smoothed(once);
    for (std::size_t i = 0; i < points_.size(); ++i) points_[i] = once[i] + (once[i] - twice[i]);
    normals_ = gaussian.smoothed(normals_);
}

void SurfaceCurve::find_left() {
    const std::size_t n = points_.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 along = points_[(i + 1) % n] - points_[(i + n - 1) % n];
        left_.push_back(normals_[i].cross(along).stableNormalized());
    }
}

CurvePlace SurfaceCurve::nearest_among(const Vec3& p, Index first, Index count) const {
    const auto n = count_of(points_);
    CurvePlace best;
    double least = std::numeric_limits<double>::infinity();
    for (Index k = 0; k < count; ++k) {
        const Index i = ((first + k) % n + n) % n, j = (i + 1) % n;
        const Vec3 along = points_[j] - points_[i], to = p - points_[i];
        const double square = along.squaredNorm();
        const double t = square > 0.0 ? std::clamp(to.dot(along) / square, 0.0, 1.0) : 0.0;
        const Vec3 offset = to - t * along;
        if (offset.squaredNorm() >= least) continue;
        least = offset.squaredNorm();
        const Vec3 left = (1.0 - t) * left_[i] + t * left_[j];
        best = {(i + t) / n, 0.0, offset.dot(left.stableNormalized())};
    }
    best.distance = std::sqrt(least);
    return best;
}

CurvePlace SurfaceCurve::nearest(const Vec3& p) const {
    return nearest_among(p, 0, count_of(points_));
}

CurvePlace SurfaceCurve::nearest(const Vec3& p, double around, double window) const {
    const double n = points_.size();
    const auto reach = static_cast<Index>(std::ceil(window * n));
    return nearest_among(p, static_cast<Index>(std::floor(around * n)) - reach, 2 * reach + 1);
}

CurveDistances distances_to_curve(const Mesh& mesh, const SurfaceCurve& curve,
                                  std::span<const Index> seeds, double width,
                                  const Context& context) {
    const std::size_t count = mesh.vertex_count();
    CurveDistances found{std::vector<double>(count, kNone), std::vector<double>(count, kNone)};
    std::vector<Index> queue;
    const auto reach = [&](Index v, const CurvePlace& place) {
        found.left[v] = place.left;
        found.parameter[v] = place.parameter;
        if (place.distance <= width) queue.push_back(v);
    };
    for (const Index v : seeds) {
        if (std::isnan(found.left[v])) reach(v, curve.nearest(mesh.position(v)));
    }
    for (std::size_t i = 0; i < queue.size(); ++i) {
        if (i % 1024 == 0) context.checkpoint();
        const double around = found.parameter[queue[i]];
        for (const Index n : mesh.topology().neighbors(queue[i])) {
            if (!std::isnan(found.left[n])) continue;
            reach(n, curve.nearest(mesh.position(n), around, kWindow));
        }
    }
    return found;
}

std::vector<ContourLine> contour_along(const Mesh& mesh, const LevelSet& levels,
                                       const CurveDistances& distances, const Context& context) {
    std::vector<ContourLine> lines = trace_contours(mesh, levels, context);
    std::erase_if(lines, [&](const ContourLine& line) {
        return !line.closed || std::abs(winding(line, distances) - 1.0) > 0.5;
    });
    if (lines.size() < 2) return lines;
    std::vector<double> lengths;
    for (const ContourLine& line : lines) lengths.push_back(length_of(line.points(mesh)));
    const auto shortest = std::min_element(lengths.begin(), lengths.end()) - lengths.begin();
    return {std::move(lines[shortest])};
}

double edge_length_at(const Mesh& mesh, std::span<const Index> vertices) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const Index v : vertices) {
        for (const Index n : mesh.topology().neighbors(v)) {
            sum += (mesh.position(n) - mesh.position(v)).norm();
            ++count;
        }
    }
    return count > 0 ? sum / count : 0.0;
}

}  // namespace lissom
