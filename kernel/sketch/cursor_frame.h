/// CursorFrame: the points of an object as they lie around a pixel; private to kernel/sketch.
#pragma once

#include <Eigen/Core>

#include "kernel/core/geometry.h"
#include "kernel/sketch/pick_scene.h"
#include "kernel/sketch/view.h"

namespace lissom {

/// Camera coordinates of an object's points, sheared so that the ray through one pixel is the depth
/// axis: offsets from that pixel then need no other and lose nothing far from the origin.
class CursorFrame {
  public:
    CursorFrame(const View& view, const Vec2& pixel, const PickScene::Object& object);

    /// Returns a point of the object: to the right and upwards from the pixel's ray, and its depth.
    Vec3 from_ray(const Vec3& local) const { return axes_ * (local - origin_) - shift_; }
    /// Returns whether a point can be seen at all, by its depth.
    bool is_in_front(double depth) const { return ortho_ ? depth >= 0.0 : depth > 0.0; }
    /// Returns pixels from the pixel to the image of a point in front, to the right and down.
    Vec2 pixels(const Vec3& from_ray) const {
        const double scale = ortho_ ? scale_ : scale_ / from_ray.z();
        return {scale * from_ray.x(), -scale * from_ray.y()};
    }
    /// Returns a lower bound for pixels to any point of the box, across and up or down; infinite if
    /// all of it is behind the camera.
    Vec2 min_pixels(const Box& box) const;

    /// Returns the weights of corners of the given depths, all in front, for the point of the
    /// picture at which their weights are `seen`; both sum to 1.
    template <typename Vector>
    Vector weights(const Vector& seen, const Vector& depths) const {
        if (ortho_) return seen;
        const Vector counts = seen.cwiseQuotient(depths);
        return counts / counts.sum();
    }

    /// Returns the depth that segments are cut off at that end behind the camera, of one that
    /// reaches `depth`.
    double nearest_depth(double depth) const { return ortho_ ? 0.0 : 1e-6 * depth; }

    /// Returns the vector from a point to the eye, in the object's frame; its length is the
    /// distance to the eye, or for a camera without perspective to the plane that depths are
    /// measured from.
    Vec3 to_eye(const Vec3& local) const;

  private:
    Mat3 axes_;
    Vec3 origin_, shift_ = Vec3::Zero(), backwards_;
    double scale_;
    bool ortho_;
};

}  // namespace lissom
