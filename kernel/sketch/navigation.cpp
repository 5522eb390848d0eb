#include "kernel/sketch/navigation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// How near to its up a camera may look, in radians.
constexpr double kPole = 1e-3 * kDegree;
constexpr double kNearest = 1e-6, kFarthest = 1e6;
// Depth of the nearest corner of the framed box, in radii.
constexpr double kNearestCorner = 1e-3;

void require_finite_drag(const Vec2& drag) {
    require(drag.allFinite(), "a drag is NaN or infinite", ErrorCode::not_finite);
}

double target_depth(const Camera& camera) {
    return (camera.target() - camera.eye()).norm();
}

Camera moved(const Camera& camera, const Vec3& offset) {
    CameraOptions options = camera.options();
    options.eye += offset;
    options.target += offset;
    return Camera(options);
}

// The offset in the world that a drag of the picture is at the depth of the target.
Vec3 offset_of(const View& view, const Vec2& drag) {
    const Camera& camera = view.camera;
    const double pixel = view.pixel_length(target_depth(camera));
    return pixel * (drag.x() * camera.right() - drag.y() * camera.up());
}

}  // namespace

Camera orbited(const View& view, const Vec2& drag) {
    require_finite_drag(drag);
    const Camera& camera = view.camera;
    const Vec3 up = camera.options().up.normalized();
    const Vec2 turn = -kPi / view.size.height * drag;
    const double tilt = std::acos(std::clamp(camera.forward().dot(up), -1.0, 1.0));
    // Looking down less makes the angle to `up` less.
    const double wanted = std::clamp(tilt - turn.y(), kPole, kPi - kPole);
    const Vec3 right = Eigen::AngleAxisd(turn.x(), up) * camera.right();
    const Vec3 level = up.cross(right);
    CameraOptions options = camera.options();
    const Vec3 forward = std::sin(wanted) * level + std::cos(wanted) * up;
    options.eye = options.target - target_depth(camera) * forward;
    return Camera(options);
}

Camera panned(const View& view, const Vec2& drag) {
    require_finite_drag(drag);
    return moved(view.camera, -offset_of(view, drag));
}

Camera zoomed(const View& view, const Vec2& cursor, double factor, double size) {
    require(factor > 0.0 && std::isfinite(factor), "a zoom needs a factor above 0");
    require(size > 0.0 && std::isfinite(size), "the object looked at needs a size above 0");
    require_finite_drag(cursor);
    const Camera& camera = view.camera;
    CameraOptions options = camera.options();
    const double depth = target_depth(camera);
    const double seen = camera.is_ortho() ? *options.ortho : depth;
    const double wanted = std::clamp(seen / factor, kNearest * size, kFarthest * size);
    const Vec2 from_middle = cursor - 0.5 * Vec2(view.size.width, view.size.height);
    const Vec3 under_cursor = offset_of(view, from_middle);
    const Vec3 shift = (1.0 - wanted / seen) * under_cursor;
    options.target += shift;
    if (camera.is_ortho()) {
        options.ortho = wanted;
        options.eye += shift;
    } else {
        options.eye = options.target - wanted * camera.forward();
    }
    return Camera(options);
}

Camera with_perspective(const Camera& camera, double fov) {
    CameraOptions options = camera.options();
    if (!options.ortho) return camera;
    const double depth = 0.5 * *options.ortho / std::tan(0.5 * fov);
    options.ortho.reset();
    options.fov = fov;
    options.eye = options.target - depth * camera.forward();
    return Camera(options);
}

Camera without_perspective(const Camera& camera) {
    CameraOptions options = camera.options();
    if (options.ortho) return camera;
    options.ortho = 2.0 * camera.half_height(target_depth(camera));
    return Camera(options);
}

Camera framed(const View& view, const Box& box, double margin) {
    require(!box.empty(), "nothing is there to frame");
    const Camera& camera = view.camera;
    const Vec3 half = 0.5 * (box.max - box.min);
    // A point is framed as a small box.
    const double least = 1e-12 * (1.0 + box.center().norm());
    const double radius = std::max(half.norm(), least);
    // Room of a picture without perspective, and of one with it at depth 1.
    const double room = 1.0 - 2.0 * margin;
    const double tangent = room * (camera.is_ortho() ? 1.0 : std::tan(0.5 * camera.fov()));
    double height = least / room, distance = 2.0 * least;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 signs((corner & 1) ? 1.0 : -1.0, (corner & 2) ? 1.0 : -1.0,
                         (corner & 4) ? 1.0 : -1.0);
        const Vec3 p = half.cwiseProduct(signs);
        const double x = std::abs(p.dot(camera.right())), y = std::abs(p.dot(camera.up()));
        const double needed = std::max(x / view.size.aspect(), y) / tangent;
        height = std::max(height, needed);
        distance = std::max({distance, needed - p.dot(camera.forward()),
                             kNearestCorner * radius - p.dot(camera.forward())});
    }
    CameraOptions options = camera.options();
    options.target = box.center();
    if (camera.is_ortho()) options.ortho = 2.0 * height;
    const double away = camera.is_ortho() ? 2.0 * radius : distance;
    options.eye = options.target - away * camera.forward();
    return Camera(options);
}

}  // namespace lissom
