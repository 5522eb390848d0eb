#include "viewer/render/scene_view.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "viewer/render/draw/projection.h"

namespace lissom {
namespace {

// Radius of occlusion: a share of the scene's RMS distance to its centre, and at most a share of
// the height that is seen.
constexpr double kOcclusionOfSize = 0.60;
constexpr double kOcclusionOfView = 0.20;

// Nearest and farthest depth.
std::pair<double, double> depths(const GpuScene& scene, const Camera& camera) {
    double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
    const Vec3 forward = camera.forward(), eye = camera.eye();
    const auto visit = [&](const Vec3& p) {
        const double depth = forward.dot(p - eye);
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    };
    for_each_point(scene.snapshot(), visit);
    for (const Vec3& p : scene.placement().strand_corners) visit(p);
    return {nearest, farthest};
}

// A camera without perspective sees the same from farther away: moves it to before everything.
Camera before_everything(const Camera& camera, const GpuScene& scene) {
    if (!camera.is_ortho()) return camera;
    const auto [nearest, farthest] = depths(scene, camera);
    if (nearest > farthest) return camera;
    CameraOptions options = camera.options();
    const double distance = farthest - nearest + *options.ortho;
    options.target = options.eye + nearest * camera.forward();
    options.eye = options.target - distance * camera.forward();
    return Camera(options);
}

ViewParameters parameters_of(const GpuScene& scene, const Camera& given, double aspect) {
    const Camera camera = before_everything(given, scene);
    const auto [nearest, farthest] = depths(scene, camera);
    const DepthRange range = fit_depth_range(nearest, farthest);
    const double half_height = camera.half_height(1.0);
    return {view_matrix(camera, scene.origin()), projection_matrix(camera, aspect, range),
            Vec2(aspect * half_height, half_height), !camera.is_ortho(), range.near};
}

}  // namespace

SceneView see(const GpuScene& scene, const Camera& camera, double aspect) {
    SceneView view{parameters_of(scene, camera, aspect), 0.0};
    const ScenePlacement& placement = scene.placement();
    const double depth = camera.forward().dot(placement.center - camera.eye());
    const double seen = 2.0 * camera.half_height(std::max(depth, view.parameters.near));
    view.occlusion_radius = std::min(kOcclusionOfSize * placement.size, kOcclusionOfView * seen);
    return view;
}

}  // namespace lissom
