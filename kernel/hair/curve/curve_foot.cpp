#include "kernel/hair/curve/curve_foot.h"

#include <algorithm>

namespace lissom {
namespace {

// Squared sine of the angle below which segments are parallel.
constexpr double kParallel = 1e-12;

}  // namespace

CurveFoot foot_on_curve(std::span<const Vec3> curve, const Vec3& point) {
    CurveFoot best;
    best.distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
        const Vec3 edge = curve[i + 1] - curve[i];
        const double length = edge.norm();
        const double along = (point - curve[i]).dot(edge) / (length * length);
        const double t = std::clamp(along, 0.0, 1.0);
        const Vec3 foot = curve[i] + t * edge;
        const double distance = (point - foot).norm();
        if (!(distance < best.distance)) continue;
        best = {i, t, foot, distance, 0.0};
        if (i == 0 && along < 0.0) best.beyond = along * length;
        if (i + 2 == curve.size() && along > 1.0) best.beyond = (along - 1.0) * length;
    }
    return best;
}

// Ericson 2005, Real-Time Collision Detection, 5.1.9.
Vec2 nearest_shares(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = b - a, v = d - c, w = a - c;
    const double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm();
    const double uw = u.dot(w), vw = v.dot(w), area = uu * vv - uv * uv;
    double s = area > kParallel * uu * vv ? std::clamp((uv * vw - uw * vv) / area, 0.0, 1.0) : 0.0;
    const double t = (uv * s + vw) / vv;
    if ((t < 0.0 || t > 1.0) && uu > 0.0) {
        s = std::clamp((std::clamp(t, 0.0, 1.0) * uv - uw) / uu, 0.0, 1.0);
    }
    return {s, std::clamp(t, 0.0, 1.0)};
}

double segment_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec2 share = nearest_shares(a, b, c, d);
    return (a + share.x() * (b - a) - c - share.y() * (d - c)).norm();
}

std::vector<double> arc_lengths(std::span<const Vec3> curve) {
    std::vector<double> lengths;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        lengths.push_back(i == 0 ? 0.0 : lengths.back() + (curve[i] - curve[i - 1]).norm());
    }
    return lengths;
}

double arc_length_at(std::span<const double> lengths, const CurveFoot& foot) {
    const double from = lengths[foot.segment], to = lengths[foot.segment + 1];
    return from + foot.t * (to - from);
}

Vec3 point_at_arc_length(std::span<const Vec3> curve, std::span<const double> lengths, double at) {
    const auto behind = std::upper_bound(lengths.begin(), lengths.end(), at);
    if (behind == lengths.begin()) return curve.front();
    if (behind == lengths.end()) return curve.back();
    const std::size_t i = behind - lengths.begin();
    const double t = (at - lengths[i - 1]) / (lengths[i] - lengths[i - 1]);
    return (1.0 - t) * curve[i - 1] + t * curve[i];
}

std::vector<Vec3> curve_tangents(std::span<const Vec3> curve) {
    std::vector<Vec3> tangents(curve.size(), Vec3::Zero());
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
        const Vec3 along = (curve[i + 1] - curve[i]).normalized();
        tangents[i] += along;
        tangents[i + 1] += along;
    }
    for (std::size_t i = 0; i < curve.size(); ++i) {
        // At a reversal of the curve, the direction of the segment before.
        if (tangents[i].norm() < 1e-9) tangents[i] = curve[i] - curve[i > 0 ? i - 1 : 0];
        tangents[i].normalize();
    }
    return tangents;
}

std::vector<Vec3> without_repeated_points(std::span<const Vec3> points) {
    std::vector<Vec3> result;
    for (const Vec3& p : points) {
        if (result.empty() || p != result.back()) result.push_back(p);
    }
    return result;
}

}  // namespace lissom
