#include "viewer/render/draw/projection.h"

#include <Eigen/Geometry>

#include "tests/unit/support.h"

using namespace lissom;

namespace {

constexpr PictureSize kSize{640.0, 480.0};
const Vec3 kOrigin(0.3, -0.2, 0.1);

// Pixel position from the matrices.
Vec2 to_pixel(const Mat4& matrix, const Vec3& world) {
    const Vec4 clip = matrix * (world - kOrigin).homogeneous();
    const Vec2 ndc = clip.head<2>() / clip.w();
    return {(0.5 + 0.5 * ndc.x()) * kSize.width, (0.5 - 0.5 * ndc.y()) * kSize.height};
}

}  // namespace

TEST_CASE("the matrices put points where the camera does, with depths in range") {
    const Vec3 eye(2, 3, 4), target(0.2, 0.1, -0.3);
    for (const Camera& camera : {Camera({.eye = eye, .target = target, .fov = 0.9}),
                                 Camera({.eye = eye, .target = target, .ortho = 3.0})}) {
        const Mat4 matrix =
            projection_matrix(camera, kSize.aspect(), {1.0, 9.0}) * view_matrix(camera, kOrigin);
        for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, -1, 0.5), Vec3(-0.7, 0.6, -1)}) {
            const Vec3 seen = camera.project(p, kSize);
            CHECK((to_pixel(matrix, p) - seen.head<2>()).norm() < 1e-9);
            const Vec4 clip = matrix * (p - kOrigin).homogeneous();
            CHECK(std::abs(clip.z() / clip.w()) < 1.0);
        }
    }
}

TEST_CASE("a tile fills its target with its part of the picture") {
    const Mat4 matrix = tile_matrix({160, 120, 320, 240}, 640, 480);
    const auto place = [&](double x, double y) {
        return Vec2((matrix * Vec4(2 * x / 640 - 1, 2 * y / 480 - 1, 0, 1)).head<2>());
    };
    CHECK(place(160, 120).isApprox(Vec2(-1, -1)));
    CHECK(place(480, 360).isApprox(Vec2(1, 1)));
    CHECK(place(320, 240).norm() < 1e-12);
}

TEST_CASE("the depth range holds what is drawn, and its near plane stays in front of the eye") {
    const DepthRange range = fit_depth_range(2.0, 5.0);
    CHECK(range.near < 2.0);
    CHECK(range.near > 0.0);
    CHECK(range.far > 5.0);
    const DepthRange around = fit_depth_range(-3.0, 10.0);
    CHECK(around.near > 0.0);
    CHECK(around.far > 10.0);
    const DepthRange flat = fit_depth_range(4.0, 4.0);
    CHECK(flat.near < 4.0);
    CHECK(flat.far > 4.0);
    CHECK(fit_depth_range(-5.0, -2.0).near > 0.0);
}
