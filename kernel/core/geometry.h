/// Small geometry types shared by every module. Lengths are in the mesh's own unit, angles in
/// radians.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "kernel/core/index.h"

namespace lissom {

inline constexpr double kPi = 3.14159265358979323846;
/// One degree in radians.
inline constexpr double kDegree = kPi / 180.0;
/// No number: not given, or not known.
inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;
using Mat3 = Eigen::Matrix3d;
using Mat4 = Eigen::Matrix4d;

/// Axis-aligned bounding box. A default box is empty: min > max.
struct Box {
    Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());

    bool empty() const { return (min.array() > max.array()).any(); }
    Vec3 center() const { return 0.5 * (min + max); }
    double diagonal() const { return empty() ? 0.0 : (max - min).norm(); }
    bool contains(const Vec3& p) const {
        return (p.array() >= min.array()).all() && (p.array() <= max.array()).all();
    }
    void extend(const Vec3& p) {
        min = min.cwiseMin(p);
        max = max.cwiseMax(p);
    }
};

/// Affine map p -> linear * p + translation. The default is the identity.
struct Affine {
    Mat3 linear = Mat3::Identity();
    Vec3 translation = Vec3::Zero();

    Vec3 operator()(const Vec3& p) const { return linear * p + translation; }
    /// (a * b)(p) = a(b(p)).
    Affine operator*(const Affine& b) const {
        return {linear * b.linear, linear * b.translation + translation};
    }
    bool operator==(const Affine& b) const {
        return linear == b.linear && translation == b.translation;
    }
    bool is_identity() const { return linear == Mat3::Identity() && translation == Vec3::Zero(); }
    bool is_finite() const { return linear.allFinite() && translation.allFinite(); }
};

/// Returns whether `x` can be a length: finite and not negative.
inline bool is_length(double x) {
    return x >= 0.0 && std::isfinite(x);
}

/// Translation by `offset`.
Affine translation(const Vec3& offset);

/// Rotation by `angle` radians about the axis through `about`; `axis` need not have unit length.
/// Errors: invalid_argument when the axis has no length or is not finite.
Affine rotation(const Vec3& axis, double angle, const Vec3& about);

/// Scaling by `factors` along x, y and z about the point `about`.
Affine scaling(const Vec3& factors, const Vec3& about);

}  // namespace lissom
