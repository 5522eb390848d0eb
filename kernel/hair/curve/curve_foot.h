/// Nearest points of polylines, and places on them by arc length.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

struct CurveFoot {
    /// Lies on the segment from point `segment` to the next, at the fraction `t` of it, 0 to 1.
    std::size_t segment = 0;
    double t = 0.0;
    Vec3 point = Vec3::Zero();
    double distance = 0.0;
    /// Distance of the point beyond the curve's ends, along its first or last segment: negative
    /// before the first point, positive after the last one, else 0.
    double beyond = 0.0;
};

/// Returns the first of several nearest points. The curve has at least two points, and no two
/// successive ones are equal.
CurveFoot foot_on_curve(std::span<const Vec3> curve, const Vec3& point);

/// Shares, 0 to 1, of the segments a b and c d at which they are nearest to each other, and that
/// distance. c and d differ.
Vec2 nearest_shares(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
double segment_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Arc length from the first point up to each point.
std::vector<double> arc_lengths(std::span<const Vec3> curve);

/// Arc length from the first point up to a foot; `lengths` are arc_lengths of the curve.
double arc_length_at(std::span<const double> lengths, const CurveFoot& foot);

/// Returns the point at this arc length, clamped to the curve.
Vec3 point_at_arc_length(std::span<const Vec3> curve, std::span<const double> lengths, double at);

/// Unit tangents at the points: the mean of those of the segments beside them.
std::vector<Vec3> curve_tangents(std::span<const Vec3> curve);

/// Returns the curve without points equal to the one before.
std::vector<Vec3> without_repeated_points(std::span<const Vec3> points);

}  // namespace lissom
