/// The matrices that a camera gives OpenGL.
#pragma once

#include "kernel/sketch/camera.h"

namespace lissom {

/// Depths in front of the camera between which everything is drawn; 0 < near < far.
struct DepthRange {
    double near = 0.1;
    double far = 10.0;
};

/// A rectangle of a picture's pixels, counted from the bottom left.
struct Tile {
    int x = 0, y = 0, width = 0, height = 0;
};

/// Returns the map of world points minus `origin` to view space: x right, y up, z towards the
/// viewer.
Mat4 view_matrix(const Camera& camera, const Vec3& origin);

/// View space to clip space for a whole picture.
Mat4 projection_matrix(const Camera& camera, double aspect, const DepthRange& range);

/// Clip space of a whole picture to that of one tile of it.
Mat4 tile_matrix(const Tile& tile, int picture_width, int picture_height);

/// Returns the range that holds depths from `nearest` to `farthest`, with room for marks drawn a
/// little nearer. Depths that are not in front of the camera are left out.
DepthRange fit_depth_range(double nearest, double farthest);

}  // namespace lissom
