#include "kernel/hair/curve/curve.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/solve/grid/constraint_weight.h"

namespace lissom {
namespace {

// More segments than this are a mistake, and would take memory and time without end.
constexpr double kMaxSegments = 1e6;

void require_step(std::span<const Vec3> points, double step) {
    if (!(step > 0.0) || !std::isfinite(step)) {
        throw Error(ErrorCode::invalid_argument, "the step along a curve must be above 0");
    }
    if (curve_length(points) <= kMaxSegments * step) return;
    throw Error(
        ErrorCode::out_of_range,
        "the curve is more than a million steps long; its points are far outside the volume "
        "of the hairstyle");
}

std::vector<Vec3> without_repeats(std::span<const Vec3> points) {
    std::vector<Vec3> result;
    for (const Vec3& p : points) {
        if (result.empty() || p != result.back()) result.push_back(p);
    }
    return result;
}

// The point between b and c at the share t of the way, by the pyramid of Barry and Goldman with
// knots that are apart as the square roots of distances.
Vec3 centripetal(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double t) {
    const double k0 = 0.0, k1 = k0 + std::sqrt((b - a).norm()), k2 = k1 + std::sqrt((c - b).norm()),
                 k3 = k2 + std::sqrt((d - c).norm());
    const double k = k1 + t * (k2 - k1);
    const auto between = [k](const Vec3& p, const Vec3& q, double from, double to) -> Vec3 {
        return ((to - k) * p + (k - from) * q) / (to - from);
    };
    const Vec3 ab = between(a, b, k0, k1), bc = between(b, c, k1, k2), cd = between(c, d, k2, k3);
    return between(between(ab, bc, k0, k2), between(bc, cd, k1, k3), k1, k2);
}

}  // namespace

void require_curve(std::span<const Vec3> points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].allFinite()) continue;
        throw Error(ErrorCode::not_finite,
                    "point " + std::to_string(i) + " of the curve is not finite");
    }
    const bool differ = std::any_of(points.begin(), points.end(),
                                    [&](const Vec3& p) { return p != points.front(); });
    if (!differ) {
        throw Error(ErrorCode::invalid_argument,
                    "a curve needs two points that differ; draw it longer");
    }
}

void require_curve_weight(double weight) {
    require(weight >= kMinConstraintWeight && weight <= kMaxConstraintWeight,
            "the weight of a curve must be from 1e-6 to 1e9");
}

double curve_length(std::span<const Vec3> points) {
    double length = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
    return length;
}

std::vector<Vec3> smooth_curve(std::span<const Vec3> points, double step) {
    require_curve(points);
    require_step(points, step);
    const std::vector<Vec3> p = without_repeats(points);
    const std::size_t last = p.size() - 1;
    std::vector<Vec3> result{p.front()};
    for (std::size_t i = 0; i < last; ++i) {
        // Beyond its ends the curve goes on mirrored.
        const Vec3 before = i > 0 ? p[i - 1] : Vec3(2.0 * p[i] - p[i + 1]);
        const Vec3 after = i + 1 < last ? p[i + 2] : Vec3(2.0 * p[i + 1] - p[i]);
        // A spline is seldom twice as long as its chord.
        const double parts = std::ceil(2.0 * (p[i + 1] - p[i]).norm() / step);
        for (double k = 1.0; k < parts; k += 1.0) {
            result.push_back(centripetal(before, p[i], p[i + 1], after, k / parts));
        }
        result.push_back(p[i + 1]);
    }
    return result;
}

std::vector<Vec3> resampled_curve(std::span<const Vec3> points, double step) {
    require_curve(points);
    require_step(points, step);
    const double length = curve_length(points);
    const double count = std::max(1.0, std::round(length / step));
    std::vector<Vec3> result{points.front()};
    double behind = 0.0;
    std::size_t i = 1;
    for (double k = 1.0; k < count; k += 1.0) {
        const double at = length * k / count;
        while (i + 1 < points.size() && behind + (points[i] - points[i - 1]).norm() < at) {
            behind += (points[i] - points[i - 1]).norm();
            ++i;
        }
        const double segment = (points[i] - points[i - 1]).norm();
        const double t = segment > 0.0 ? std::min(1.0, (at - behind) / segment) : 0.0;
        result.push_back((1.0 - t) * points[i - 1] + t * points[i]);
    }
    result.push_back(points.back());
    return result;
}

void push_out(std::span<Vec3> points, const DistanceGrid& distances, double clearance) {
    // Distances between grid points are interpolated, so that one step may fall a little short.
    constexpr int kSteps = 4;
    for (Vec3& p : points) {
        for (int k = 0; k < kSteps; ++k) {
            const DistanceGrid::Sample here = distances.sample(p);
            const double missing = clearance - here.value;
            if (!(missing > 0.0) || here.gradient.isZero()) break;
            p += missing * here.gradient.normalized();
        }
    }
}

}  // namespace lissom
