/// Camera: how a world is seen on a rectangle of pixels. Plain geometry without a window, so that
/// picking, strokes and framing work the same headless.
///
/// Camera coordinates are right, up and the depth along the viewing direction. Pixels count from
/// the top left corner, x to the right, y down; the centre of the first pixel is (0.5, 0.5).
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "kernel/core/geometry.h"

namespace lissom {

/// Parameters of a camera.
struct CameraOptions {
    /// Position of the camera; without perspective, the plane that depths are measured from.
    Vec3 eye = Vec3(0.0, 0.0, 5.0);
    /// The point in the middle of the picture.
    Vec3 target = Vec3::Zero();
    /// The direction that is up in the picture; need not be orthogonal to the view nor have unit
    /// length.
    Vec3 up = Vec3::UnitY();
    /// Vertical opening angle in radians, between 0 and pi.
    double fov = kPi / 6.0;
    /// Height of the picture in world units for a camera without perspective, which ignores `fov`.
    std::optional<double> ortho = std::nullopt;
};

/// Size in pixels of the rectangle that a camera looks through.
struct PictureSize {
    double width = 1.0;
    double height = 1.0;

    double aspect() const { return width / height; }
};

/// A half-line; `direction` has unit length.
struct Ray {
    Vec3 origin;
    Vec3 direction;
};

class Camera {
  public:
    Camera() : Camera(CameraOptions{}) {}
    /// Errors: not_finite; invalid_argument if eye and target coincide, `up` runs along the view,
    /// `fov` is not inside (0, pi), or `ortho` is not positive.
    explicit Camera(const CameraOptions& options);

    const Vec3& eye() const { return options_.eye; }
    const Vec3& target() const { return options_.target; }
    double fov() const { return options_.fov; }
    bool is_ortho() const { return options_.ortho.has_value(); }
    const CameraOptions& options() const { return options_; }

    /// Unit axes of the picture: to the right, upwards, and into the scene.
    Vec3 right() const { return axes_.row(0); }
    Vec3 up() const { return axes_.row(1); }
    Vec3 forward() const { return axes_.row(2); }

    /// World point to camera coordinates: right, up, depth.
    Vec3 to_camera(const Vec3& world) const { return axes_ * (world - options_.eye); }
    Vec3 to_world(const Vec3& camera) const { return axes_.transpose() * camera + options_.eye; }

    /// Returns half the height, in world units, of the picture at `depth`.
    double half_height(double depth) const;

    /// World point to (x, y, depth), x and y in pixels. With perspective, x and y of a point that
    /// is not in front of the camera (depth <= 0) are NaN.
    Vec3 project(const Vec3& world, const PictureSize& size) const;
    /// Returns the inverse: pixel position and depth to the world point.
    Vec3 unproject(const Vec3& pixel_and_depth, const PictureSize& size) const;
    /// Returns the ray of points seen at a pixel position; it starts at depth 0.
    Ray ray(double x, double y, const PictureSize& size) const;

  private:
    CameraOptions options_;
    Mat3 axes_;
};

/// Sides that an object is looked at from. With y upwards, `front` looks along -z and `right` along
/// -x; with z upwards, `front` looks along +y and `right` along -x. `top` and `bottom` keep
/// `right()` of the front view; `three_quarter` stands to the right of the front and above.
enum class StandardView { front, back, left, right, top, bottom, three_quarter };

/// Name of a view: "front", ..., "three-quarter".
std::string_view view_name(StandardView view);
/// Returns the view called `name`, or nothing.
std::optional<StandardView> find_view(std::string_view name);

/// The axis of the world that points up in a standard view.
enum class ViewUp { y, z };

/// Fit of an object to the picture.
struct FramingOptions {
    ViewUp up = ViewUp::y;
    /// Width of the picture divided by its height.
    double aspect = 4.0 / 3.0;
    /// Vertical opening angle in radians; unused with `ortho`.
    double fov = kPi / 6.0;
    bool ortho = false;
    /// Share of the picture left free on every side, 0 to less than 0.5.
    double margin = 0.06;
};

/// Returns the camera that sees `points` from a side, as large as the margin allows and centred. A
/// single point is framed as if it had extent 1. Errors: invalid_argument for no points or options
/// out of range; not_finite.
Camera frame_points(StandardView view, std::span<const Vec3> points, const FramingOptions& = {});
/// Returns the same for all of a bounding box. Errors: also invalid_argument for an empty box.
Camera frame_box(StandardView view, const Box& box, const FramingOptions& = {});

}  // namespace lissom
