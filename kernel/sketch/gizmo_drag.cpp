#include "kernel/sketch/gizmo_drag.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// At the origin a part moves no faster than if it were seen at this fraction of its length.
constexpr double kMinSeen = 0.15;
// Up to 1 / kMinDepth times the depth of the origin the part stays under the cursor, and a pixel
// is 1 / kMinDepth^2 times as long; beyond, towards the horizon, it lags behind.
constexpr double kMinDepth = 0.3;
// Rings that are turned to the viewer by less than this cosine are dragged along the tangent.
constexpr double kFromSide = 0.2;
// A scale handle counts as at least this fraction of an axis away.
constexpr double kMinReach = 0.3;
constexpr double kDeadPixels = 4.0;
constexpr double kPreciseGain = 0.1;
constexpr double kStepPixels = 10.0;

GizmoKind kind_of(GizmoPart part) {
    if (part >= GizmoPart::scale_x) return GizmoKind::scale;
    return part >= GizmoPart::rotate_x ? GizmoKind::rotate : GizmoKind::move;
}

// Returns the place of a part in its group: 0 to 2, or 3 for that of the view.
int axis_of(GizmoPart part, GizmoPart first) {
    return static_cast<int>(part) - static_cast<int>(first);
}

// The least 1, 2 or 5 times a power of ten that is not below `length`.
double round_step(double length) {
    const double power = std::pow(10.0, std::floor(std::log10(length)));
    for (const double times : {1.0, 2.0, 5.0}) {
        if (times * power >= length) return times * power;
    }
    return 10.0 * power;
}

// Moving a handle outwards by its own distance doubles, as far inwards halves: never 0.
double factor_of(double outwards) {
    return outwards >= 0.0 ? 1.0 + outwards : 1.0 / (1.0 - outwards);
}

// Returns the inverse of the matrix that maps lengths to pixels, but limits a pixel to 1 / `least`.
Eigen::Matrix2d bounded_inverse(const Eigen::Matrix2d& map, double least) {
    const Eigen::Matrix2d square = map.transpose() * map;
    const double angle = 0.5 * std::atan2(2.0 * square(0, 1), square(0, 0) - square(1, 1));
    Eigen::Matrix2d inverse = Eigen::Matrix2d::Zero();
    for (const Vec2& v :
         {Vec2(std::cos(angle), std::sin(angle)), Vec2(-std::sin(angle), std::cos(angle))}) {
        const Vec2 seen = map * v;
        inverse += v * seen.transpose() / std::max(seen.squaredNorm(), least * least);
    }
    return inverse;
}

void require_finite(const Vec2& cursor) {
    if (cursor.allFinite()) return;
    throw Error(ErrorCode::not_finite, "the cursor's position is NaN or infinite");
}

void require_steps(const GizmoSteps& steps) {
    for (const double step : {steps.length.value_or(1.0), steps.angle, steps.factor}) {
        require(std::isfinite(step) && step > 0.0, "the steps of a gizmo must be positive");
    }
}

}  // namespace

Mat3 GizmoMotion::linear() const {
    if (kind == GizmoKind::scale) {
        // Exactly the identity if nothing is scaled.
        const Vec3 more = factors - Vec3::Ones();
        return Mat3::Identity() + axes * more.asDiagonal() * axes.transpose();
    }
    if (kind == GizmoKind::move || angle == 0.0) return Mat3::Identity();
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

Affine GizmoMotion::affine() const {
    const Mat3 map = linear();
    return {map, translation + (Mat3::Identity() - map) * origin};
}

GizmoDrag::GizmoDrag(const Gizmo& gizmo, GizmoPart part, const View& view, const Vec2& cursor,
                     const GizmoSteps& steps)
    : gizmo_(gizmo),
      part_(part),
      view_(view),
      steps_(steps),
      origin_(view.project(gizmo.origin()).head<2>()),
      depth_(view.camera.to_camera(gizmo.origin()).z()),
      length_(gizmo.length(view)) {
    require(gizmo.is_seen(view), "the gizmo lies behind the camera");
    require_finite(cursor);
    require_steps(steps);
    motion_.kind = kind_of(part);
    motion_.axes = gizmo.axes(view.camera);
    motion_.origin = gizmo.origin();
    const auto axis = [&](int k) { return Vec3(motion_.axes.col(k % 3)); };
    if (part < GizmoPart::move_yz) {
        set_track(axis(axis_of(part, GizmoPart::move_x)), Vec3::Zero());
    } else if (part < GizmoPart::move_view) {
        const int k = axis_of(part, GizmoPart::move_yz);
        set_track(axis(k + 1), axis(k + 2));
    } else if (part == GizmoPart::move_view) {
        set_track(view.camera.right(), view.camera.up());
    } else if (part < GizmoPart::rotate_view) {
        set_ring(axis(axis_of(part, GizmoPart::rotate_x)));
    } else if (part == GizmoPart::rotate_view) {
        const Camera& camera = view.camera;
        set_ring(camera.is_ortho() ? Vec3(-camera.forward())
                                   : Vec3((camera.eye() - gizmo.origin()).normalized()));
    } else if (part < GizmoPart::scale_all) {
        set_track(axis(axis_of(part, GizmoPart::scale_x)), Vec3::Zero());
    }
    read_ = anchor_read_ = read(cursor);
    const bool holds_handle = part >= GizmoPart::scale_x && part < GizmoPart::scale_all;
    if (holds_handle) reach_ = std::max(std::abs(read_.x()), kMinReach * length_);
    show(motion_.kind == GizmoKind::scale ? Vec2(1.0, 0.0) : Vec2::Zero());
}

// A direction of the world as it moves the picture of the origin: pixels a length.
Vec2 GizmoDrag::seen(const Vec3& direction) const {
    const Camera& camera = view_.camera;
    const Vec3 at_eye(camera.right().dot(direction), camera.up().dot(direction),
                      camera.forward().dot(direction));
    const Vec3 origin = camera.to_camera(gizmo_.origin());
    Vec2 aside = at_eye.head<2>();
    if (!camera.is_ortho()) aside -= at_eye.z() / depth_ * origin.head<2>();
    return Vec2(aside.x(), -aside.y()) / view_.pixel_length(depth_);
}

void GizmoDrag::set_track(const Vec3& first, const Vec3& second) {
    track_.along << first, second;
    Eigen::Matrix2d pixels;
    pixels << seen(first), seen(second);
    track_.unproject = bounded_inverse(pixels, kMinSeen / view_.pixel_length(depth_));
    if (view_.camera.is_ortho()) return;
    track_.recede = track_.along.transpose() * view_.camera.forward() / depth_;
}

void GizmoDrag::set_ring(const Vec3& axis) {
    motion_.axis = axis;
    const Camera& camera = view_.camera;
    const Vec3 to_eye = camera.is_ortho() ? Vec3(-camera.forward())
                                          : Vec3((camera.eye() - gizmo_.origin()).normalized());
    const Vec3 front = to_eye - axis.dot(to_eye) * axis;
    if (std::abs(axis.dot(to_eye)) < kFromSide) {
        const Vec2 pixels = seen(axis.cross(front.normalized()));
        tangent_ = pixels / (pixels.squaredNorm() * length_);
        return;
    }
    const Vec3 first = axis.unitOrthogonal();
    set_track(first, axis.cross(first));
}

// Returns the reading of the cursor: lengths along the track, an angle, or the distance of a handle
// outwards, in its own distance. From the same place of the cursor always the same, but for full
// turns.
Vec2 GizmoDrag::read(const Vec2& cursor) {
    const Vec2 from_origin = cursor - origin_;
    if (motion_.kind == GizmoKind::rotate) return {read_angle(from_origin), 0.0};
    if (part_ == GizmoPart::scale_all) {
        return {(from_origin.x() - from_origin.y()) / gizmo_.options().size, 0.0};
    }
    const Vec2 flat = track_.unproject * from_origin;
    return flat / std::max(1.0 - track_.recede.dot(flat), kMinDepth);
}

double GizmoDrag::read_angle(const Vec2& from_origin) {
    if (tangent_) return from_origin.dot(*tangent_);
    if (from_origin.norm() < kDeadPixels) return read_.x();
    const Vec2 flat = track_.unproject * from_origin;
    const double angle = std::atan2(flat.y(), flat.x());
    if (has_angle_) return angle + 2.0 * kPi * std::round((read_.x() - angle) / (2.0 * kPi));
    // The turn starts at the first place that has an angle.
    has_angle_ = true;
    anchor_read_.x() = angle;
    return angle;
}

const GizmoMotion& GizmoDrag::drag(const Vec2& cursor, const GizmoModifiers& modifiers) {
    require_finite(cursor);
    if (modifiers.precise != precise_) {
        anchor_read_ = read_;
        anchor_value_ = value_;
        precise_ = modifiers.precise;
    }
    read_ = read(cursor);
    value_ = anchor_value_ + (precise_ ? kPreciseGain : 1.0) * (read_ - anchor_read_);
    Vec2 amount = value_;
    if (motion_.kind == GizmoKind::scale) amount.x() = factor_of(value_.x() / reach_);
    show(modifiers.snap ? snapped(amount) : amount);
    return motion_;
}

Vec2 GizmoDrag::snapped(const Vec2& amount) const {
    double step = steps_.angle;
    if (motion_.kind == GizmoKind::scale) step = steps_.factor;
    if (motion_.kind == GizmoKind::move) {
        step = steps_.length.value_or(round_step(kStepPixels * view_.pixel_length(depth_)));
    }
    Vec2 rounded = step * (amount / step).array().round().matrix();
    if (motion_.kind == GizmoKind::scale) rounded.x() = std::max(rounded.x(), step);
    return rounded;
}

const GizmoMotion& GizmoDrag::set_amount(const Vec2& amounts) {
    if (!amounts.allFinite()) {
        throw Error(ErrorCode::not_finite, "the amount of a gizmo's motion is NaN or infinite");
    }
    require(motion_.kind != GizmoKind::scale || amounts.x() != 0.0,
            "a factor of 0 would flatten everything; give another");
    show(amounts);
    return motion_;
}

void GizmoDrag::show(const Vec2& amount) {
    motion_.amount = amount;
    if (motion_.kind == GizmoKind::move) {
        motion_.translation = track_.along * amount;
    } else if (motion_.kind == GizmoKind::rotate) {
        motion_.angle = amount.x();
    } else if (part_ == GizmoPart::scale_all) {
        motion_.factors = Vec3::Constant(amount.x());
    } else {
        motion_.factors[axis_of(part_, GizmoPart::scale_x)] = amount.x();
    }
}

Gizmo GizmoDrag::moved() const {
    GizmoOptions options = gizmo_.options();
    options.origin += motion_.translation;
    if (motion_.kind == GizmoKind::rotate) options.local = motion_.linear() * options.local;
    return Gizmo(options);
}

}  // namespace lissom
