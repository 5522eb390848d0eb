/// View: a camera and the picture that it is seen in.
#pragma once

#include "kernel/core/geometry.h"
#include "kernel/sketch/camera.h"

namespace lissom {

struct View {
    Camera camera;
    PictureSize size;

    /// Return the results of Camera::project and Camera::ray, for this picture.
    Vec3 project(const Vec3& world) const { return camera.project(world, size); }
    Ray ray(const Vec2& pixel) const { return camera.ray(pixel.x(), pixel.y(), size); }
    /// Returns the length in the world of one pixel at `depth`.
    double pixel_length(double depth) const {
        return 2.0 * camera.half_height(depth) / size.height;
    }
};

}  // namespace lissom
