/// View of a scene by a camera: matrices and the range of depths.
#pragma once

#include "kernel/sketch/camera.h"
#include "viewer/render/draw/view_parameters.h"
#include "viewer/render/gl/gpu_scene.h"

namespace lissom {

struct SceneView {
    ViewParameters parameters;
    /// Within which surfaces darken each other, in world units.
    double occlusion_radius = 0.0;
};

/// Returns the view of `scene` by `camera` in a picture whose width is `aspect` times its height.
SceneView see(const GpuScene& scene, const Camera& camera, double aspect);

}  // namespace lissom
