/// FramedCurve: a smooth curve through points, with frames that do not twist about it.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

/// A place on a curve.
struct CurveFrame {
    Vec3 point = Vec3::Zero();
    /// Unit tangent.
    Vec3 direction = Vec3::UnitX();
    /// Rotation from the frame at the start: it carries the tangent there to the one here, with the
    /// least turn on the way, none of it about the curve.
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
};

/// An interpolating curve of centripetal Catmull-Rom segments (Yuksel et al. 2011), by arc length,
/// with rotation-minimizing frames (Wang et al. 2008). Beyond its ends it goes on straight. A
/// value.
class FramedCurve {
  public:
    /// Points that equal the one before are left out. Errors: not_finite, also beyond 1e100;
    /// invalid_argument if fewer than two points differ.
    explicit FramedCurve(std::span<const Vec3> points);

    double length() const { return places_.back().along; }
    /// Returns the place at an arc length from the start.
    CurveFrame at(double along) const;
    /// Returns the arc length of the place nearest to a point, from 0 to `length()`.
    double nearest(const Vec3& point) const;
    /// Returns the least arc length from `along` on at which the curve is so far from a point, with
    /// its straight continuation. Errors: invalid_argument if `distance` is not above 0.
    double leave(const Vec3& point, double distance, double along) const;

  private:
    struct Sample {
        Vec3 point;
        double along;
        Vec3 direction;
        Eigen::Quaterniond turn;
    };

    void sample(const std::vector<Vec3>& points);
    void find_frames();
    std::size_t sample_before(double along) const;

    std::vector<Sample> places_;
};

}  // namespace lissom
