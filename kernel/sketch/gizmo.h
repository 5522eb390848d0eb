/// Gizmo: axes, planes and rings around a point, by which a hand moves, turns and scales. A value
/// that draws nothing: `shape` returns the lines to draw, `hit` the part under the cursor, and
/// GizmoDrag (gizmo_drag.h) interprets a drag of it.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/sketch/camera.h"
#include "kernel/sketch/view.h"

namespace lissom {

/// Action of the parts.
enum class GizmoMode { move, rotate, scale, all };

/// Directions of the axes: along those of the world, of the object, or of the picture (to the
/// right, upwards and to the viewer).
enum class GizmoAxes { world, local, view };

/// Parts that can be dragged. Planes are named by the axes that lie in them.
enum class GizmoPart {
    move_x,
    move_y,
    move_z,
    move_yz,
    move_zx,
    move_xy,
    /// Moves in the plane of the picture.
    move_view,
    rotate_x,
    rotate_y,
    rotate_z,
    /// About the direction to the viewer.
    rotate_view,
    scale_x,
    scale_y,
    scale_z,
    /// Scales in all directions alike.
    scale_all
};

/// Name of a part: "move-x", ..., "scale-all".
std::string_view part_name(GizmoPart part);
/// Returns the part called `name`, or nothing.
std::optional<GizmoPart> find_part(std::string_view name);

/// Group of a part, for its color: an axis, or the view.
enum class GizmoRole { x, y, z, view };

/// Returns the color of a role in sRGB, each part 0 to 1; one color for every highlighted role.
Vec3 role_color(GizmoRole role, bool highlighted);

/// A polyline to draw, in the world.
struct GizmoLine {
    GizmoPart part;
    GizmoRole role;
    std::vector<Vec3> points;
    /// Runs back to its first point; the area inside belongs to the part.
    bool closed = false;
    /// Pixels.
    double width = 2.0;
};

/// A disk to draw, at a point of the world.
struct GizmoPoint {
    GizmoPart part;
    GizmoRole role;
    Vec3 position;
    /// Pixels.
    double radius = 5.0;
};

/// All that a gizmo shows in a view. Empty if it lies behind the camera.
struct GizmoShape {
    std::vector<GizmoLine> lines;
    std::vector<GizmoPoint> points;
};

struct GizmoOptions {
    /// The point that it stands at, and that turns and scaling are about.
    Vec3 origin = Vec3::Zero();
    GizmoMode mode = GizmoMode::all;
    GizmoAxes axes = GizmoAxes::world;
    /// The object's axes as columns, orthogonal and of unit length, for GizmoAxes::local.
    Mat3 local = Mat3::Identity();
    /// Length of an axis in pixels, the same at every distance.
    double size = 90.0;
};

class Gizmo {
  public:
    Gizmo() : Gizmo(GizmoOptions{}) {}
    /// Errors: not_finite; invalid_argument if `size` is not positive or `local` is not
    /// orthonormal.
    explicit Gizmo(const GizmoOptions& options);

    const GizmoOptions& options() const { return options_; }
    const Vec3& origin() const { return options_.origin; }

    /// Returns the three axes in a view, as columns of unit length.
    Mat3 axes(const Camera& camera) const;
    /// Length of an axis in the world, as `size` asks for it at the origin.
    double length(const View& view) const;
    /// Returns whether the origin lies in front of the camera: nothing is shown or dragged
    /// otherwise.
    bool is_seen(const View& view) const;

    /// Returns the lines to draw. Axes that are seen end-on and planes that are seen from the side
    /// are left out; of rings the half in front is shown.
    GizmoShape shape(const View& view) const;

    /// Returns the part under the cursor, of those that `shape` shows: a point before a line, a
    /// line before the inside of a plane, and that before lines that are only near, up to `reach`
    /// pixels; of several the nearest in pixels, then in depth.
    std::optional<GizmoPart> hit(const View& view, const Vec2& cursor, double reach = 7.0) const;

  private:
    GizmoOptions options_;
};

}  // namespace lissom
