#include "viewer/render/draw/projection.h"

#include <algorithm>

namespace lissom {
namespace {

// Least distance of the near plane, as a fraction of the farthest depth, so that depths stay apart.
constexpr double kMinimumNearShare = 1e-4;
// Room in front and behind, as a fraction of the extent in depth.
constexpr double kRoom = 0.05;

}  // namespace

Mat4 view_matrix(const Camera& camera, const Vec3& origin) {
    Mat3 axes;
    axes << camera.right().transpose(), camera.up().transpose(), -camera.forward().transpose();
    Mat4 matrix = Mat4::Identity();
    matrix.topLeftCorner<3, 3>() = axes;
    matrix.topRightCorner<3, 1>() = axes * (origin - camera.eye());
    return matrix;
}

Mat4 projection_matrix(const Camera& camera, double aspect, const DepthRange& range) {
    const double half = camera.half_height(1.0);
    const double extent = range.far - range.near;
    Mat4 matrix = Mat4::Zero();
    matrix(0, 0) = 1.0 / (half * aspect);
    matrix(1, 1) = 1.0 / half;
    if (camera.is_ortho()) {
        matrix(2, 2) = -2.0 / extent;
        matrix(2, 3) = -(range.far + range.near) / extent;
        matrix(3, 3) = 1.0;
    } else {
        matrix(2, 2) = -(range.far + range.near) / extent;
        matrix(2, 3) = -2.0 * range.far * range.near / extent;
        matrix(3, 2) = -1.0;
    }
    return matrix;
}

Mat4 tile_matrix(const Tile& tile, int picture_width, int picture_height) {
    Mat4 matrix = Mat4::Identity();
    matrix(0, 0) = 1.0 * picture_width / tile.width;
    matrix(1, 1) = 1.0 * picture_height / tile.height;
    matrix(0, 3) = (picture_width - 2.0 * tile.x) / tile.width - 1.0;
    matrix(1, 3) = (picture_height - 2.0 * tile.y) / tile.height - 1.0;
    return matrix;
}

DepthRange fit_depth_range(double nearest, double farthest) {
    if (nearest > farthest || farthest <= 0.0) return {};
    const double room = kRoom * (farthest - nearest) + kMinimumNearShare * farthest;
    const double far = farthest + room;
    return {std::max(nearest - room, kMinimumNearShare * far), far};
}

}  // namespace lissom
