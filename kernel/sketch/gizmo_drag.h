/// GizmoDrag: converts cursor drags of a gizmo's part to transforms.
#pragma once

#include <optional>

#include "kernel/core/geometry.h"
#include "kernel/sketch/gizmo.h"
#include "kernel/sketch/view.h"

namespace lissom {

enum class GizmoKind { move, rotate, scale };

/// Motion since the press.
struct GizmoMotion {
    GizmoKind kind = GizmoKind::move;
    /// Translation of a move.
    Vec3 translation = Vec3::Zero();
    /// Turn: unit vector, and angle in radians, which counts full turns.
    Vec3 axis = Vec3::Zero();
    double angle = 0.0;
    /// Factors of scaling: along the gizmo's axes, the columns of `axes`.
    Vec3 factors = Vec3::Ones();
    Mat3 axes = Mat3::Identity();
    /// The point that it is about: the gizmo's origin.
    Vec3 origin = Vec3::Zero();
    /// Amount of the motion, as `set_amount` takes it: a length along the axis or two in the plane,
    /// an angle, a factor.
    Vec2 amount = Vec2::Zero();

    /// Returns the turn or scaling alone, without the place that it is about.
    Mat3 linear() const;
    /// Returns all of it as a map of the world.
    Affine affine() const;
};

/// Modifiers set by keys during a drag.
struct GizmoModifiers {
    /// Whole steps only.
    bool snap = false;
    /// The cursor moves a tenth as far.
    bool precise = false;
};

/// The steps of snapping, counted from the press.
struct GizmoSteps {
    /// Step in the world; by default the power of ten, or twice or five times one, that is seen as
    /// at least 10 pixels.
    std::optional<double> length = std::nullopt;
    /// Radians.
    double angle = 15.0 * kDegree;
    double factor = 0.1;
};

/// The part follows the cursor as exactly as perspective allows. If that would run away - an axis
/// seen end-on, a plane seen from the side, the cursor near or beyond the horizon - it moves at
/// most ten times as fast as at the gizmo's origin. Without snapping the motion depends on the
/// cursor continuously and, full turns apart, on nothing else: it is the identity again if the
/// cursor is back. Only a turn changes fast if the cursor passes by the origin; within 4 pixels of
/// it the angle stays.
class GizmoDrag {
  public:
    /// The cursor presses `part`, which need not be under it. The view is that of the whole drag.
    /// Errors: invalid_argument if the gizmo lies behind the camera or a step is not positive;
    /// not_finite for the cursor.
    GizmoDrag(const Gizmo& gizmo, GizmoPart part, const View& view, const Vec2& cursor,
              const GizmoSteps& steps = {});

    /// Moves the cursor and returns the motion. When `precise` changes, the motion continues from
    /// its present value. Errors: not_finite.
    const GizmoMotion& drag(const Vec2& cursor, const GizmoModifiers& modifiers = {});

    /// Returns a typed number in place of the cursor: the length of a move along the axis, the
    /// angle in radians, the factor; in a plane the lengths along its two axes (to the right and
    /// upwards in that of the view). Not snapped. A later `drag` continues as if nothing had been
    /// typed. Errors: not_finite; invalid_argument for a factor of 0.
    const GizmoMotion& set_amount(double amount) { return set_amount(Vec2(amount, 0.0)); }
    const GizmoMotion& set_amount(const Vec2& amounts);

    const GizmoMotion& motion() const { return motion_; }
    GizmoPart part() const { return part_; }

    /// Returns the gizmo at the end of the motion: moved along, its local axes turned.
    Gizmo moved() const;

  private:
    /// Conversion of cursor positions. `along` has one or two directions of the world; a point o +
    /// along * m is seen at pixel origin + J m / (1 + recede . m).
    struct Track {
        Eigen::Matrix<double, 3, 2> along = Eigen::Matrix<double, 3, 2>::Zero();
        /// Pixels to the plane or axis at the origin: J inverted, but no faster than is good.
        Eigen::Matrix2d unproject = Eigen::Matrix2d::Zero();
        Vec2 recede = Vec2::Zero();
    };

    Vec2 seen(const Vec3& direction) const;
    void set_track(const Vec3& first, const Vec3& second);
    void set_ring(const Vec3& axis);
    Vec2 read(const Vec2& cursor);
    double read_angle(const Vec2& from_origin);
    Vec2 snapped(const Vec2& value) const;
    void show(const Vec2& amount);

    Gizmo gizmo_;
    GizmoPart part_;
    View view_;
    GizmoSteps steps_;
    /// The picture of the origin, its depth, and the length of an axis.
    Vec2 origin_;
    double depth_, length_;
    Track track_;
    /// Distance of a scale handle that the cursor holds.
    double reach_ = 1.0;
    /// Radians a pixel, for a ring seen from the side.
    std::optional<Vec2> tangent_;
    /// The last reading, and its value; the same at the last change of `precise`.
    Vec2 read_ = Vec2::Zero(), value_ = Vec2::Zero();
    Vec2 anchor_read_ = Vec2::Zero(), anchor_value_ = Vec2::Zero();
    bool has_angle_ = false;
    bool precise_ = false;
    GizmoMotion motion_;
};

}  // namespace lissom
