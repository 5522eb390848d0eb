#include "kernel/deform/bones/framed_curve.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/core/error.h"
#include "kernel/core/rotation.h"

namespace lissom {
namespace {

constexpr double kFarthestPoint = 1e100;
// Samples of a segment between two points.
constexpr int kSegmentSamples = 16;

std::vector<Vec3> distinct_points(std::span<const Vec3> points) {
    std::vector<Vec3> distinct;
    for (const Vec3& p : points) {
        require(p.allFinite() && p.cwiseAbs().maxCoeff() <= kFarthestPoint,
                "a point of the curve is not finite, or beyond 1e100", ErrorCode::not_finite);
        if (distinct.empty() || (p - distinct.back()).norm() > 0.0) distinct.push_back(p);
    }
    require(distinct.size() >= 2, "a curve has two points at least that differ");
    return distinct;
}

// The point at t, 0 to 1, between b and c, by the pyramid of Barry and Goldman.
Vec3 catmull_rom(const std::array<Vec3, 4>& p, double t) {
    std::array<double, 4> knot{};
    for (std::size_t i = 1; i < 4; ++i) knot[i] = knot[i - 1] + std::sqrt((p[i] - p[i - 1]).norm());
    const double at = knot[1] + t * (knot[2] - knot[1]);
    const auto blend = [&](const Vec3& a, const Vec3& b, std::size_t from, std::size_t to) -> Vec3 {
        return ((knot[to] - at) * a + (at - knot[from]) * b) / (knot[to] - knot[from]);
    };
    const Vec3 a = blend(p[0], p[1], 0, 1), b = blend(p[1], p[2], 1, 2),
               c = blend(p[2], p[3], 2, 3);
    return blend(blend(a, b, 0, 2), blend(b, c, 1, 3), 1, 2);
}

}  // namespace

FramedCurve::FramedCurve(std::span<const Vec3> points) {
    sample(distinct_points(points));
    find_frames();
}

// The ends have neighbours mirrored at them.
void FramedCurve::sample(const std::vector<Vec3>& points) {
    const std::size_t last = points.size() - 1;
    const auto point = [&](std::size_t i, int step) -> Vec3 {
        if (step < 0 && i == 0) return 2.0 * points[0] - points[1];
        if (step > 0 && i == last) return 2.0 * points[last] - points[last - 1];
        return points[step < 0 ? i - 1 : i + 1];
    };
    places_.push_back({points[0], 0.0, Vec3::UnitX(), Eigen::Quaterniond::Identity()});
    for (std::size_t i = 0; i < last; ++i) {
        const std::array<Vec3, 4> around{point(i, -1), points[i], points[i + 1], point(i + 1, 1)};
        for (int k = 1; k <= kSegmentSamples; ++k) {
            const Vec3 next = k == kSegmentSamples
                                  ? points[i + 1]
                                  : catmull_rom(around, static_cast<double>(k) / kSegmentSamples);
            const double step = (next - places_.back().point).norm();
            if (step == 0.0) continue;
            places_.push_back(
                {next, places_.back().along + step, Vec3::UnitX(), Eigen::Quaterniond::Identity()});
        }
    }
}

void FramedCurve::find_frames() {
    const std::size_t last = places_.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
        const Vec3 before =
            i > 0 ? (places_[i].point - places_[i - 1].point).normalized() : Vec3(Vec3::Zero());
        const Vec3 after =
            i < last ? (places_[i + 1].point - places_[i].point).normalized() : Vec3(Vec3::Zero());
        const Vec3 mean = before + after;
        places_[i].direction = mean.norm() > 1e-9 ? mean.normalized() : before;
        if (i == 0) continue;
        const Eigen::Quaterniond bend =
            min_rotation(places_[i - 1].direction, places_[i].direction);
        places_[i].turn = (bend * places_[i - 1].turn).normalized();
    }
}

std::size_t FramedCurve::sample_before(double along) const {
    const auto after = std::upper_bound(places_.begin() + 1, places_.end() - 1, along,
                                        [](double s, const Sample& p) { return s < p.along; });
    return static_cast<std::size_t>(after - places_.begin()) - 1;
}

CurveFrame FramedCurve::at(double along) const {
    if (along <= 0.0) {
        const Sample& first = places_.front();
        return {first.point + along * first.direction, first.direction, first.turn};
    }
    if (along >= length()) {
        const Sample& end = places_.back();
        return {end.point + (along - end.along) * end.direction, end.direction, end.turn};
    }
    const Sample &a = places_[sample_before(along)], &b = (&a)[1];
    const double t = (along - a.along) / (b.along - a.along);
    const Eigen::Quaterniond bend = min_rotation(a.direction, b.direction);
    const Eigen::Quaterniond part = Eigen::Quaterniond::Identity().slerp(t, bend);
    return {a.point + t * (b.point - a.point), part * a.direction, (part * a.turn).normalized()};
}

double FramedCurve::nearest(const Vec3& point) const {
    double best = 0.0, least = (point - places_.front().point).squaredNorm();
    for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
        const Vec3 way = places_[i + 1].point - places_[i].point;
        const double t =
            std::clamp((point - places_[i].point).dot(way) / way.squaredNorm(), 0.0, 1.0);
        const double distance = (places_[i].point + t * way - point).squaredNorm();
        if (distance >= least) continue;
        least = distance;
        best = places_[i].along + t * (places_[i + 1].along - places_[i].along);
    }
    return best;
}

double FramedCurve::leave(const Vec3& point, double distance, double along) const {
    require(distance > 0.0 && std::isfinite(distance), "the distance is above 0");
    double inside = along, outside = along;
    // The first sample beyond; then the straight continuation, which leaves any ball.
    for (std::size_t i = sample_before(along) + 1; i < places_.size(); ++i) {
        outside = std::max(along, places_[i].along);
        if ((places_[i].point - point).norm() >= distance) break;
        inside = outside;
    }
    for (double step = distance; (at(outside).point - point).norm() < distance; step *= 2.0) {
        inside = outside;
        outside += step;
    }
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (inside + outside);
        ((at(middle).point - point).norm() < distance ? inside : outside) = middle;
    }
    return outside;
}

}  // namespace lissom
