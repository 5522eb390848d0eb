/// The camera as the drawing passes see it.
#pragma once

#include "kernel/core/geometry.h"

namespace lissom {

/// Camera parameters of the passes.
struct ViewParameters {
    /// Maps of picture space to view space, and of that to clip space for the whole picture.
    Mat4 view = Mat4::Identity();
    Mat4 projection = Mat4::Identity();
    /// Half the width and height of the view, in world units; at depth 1 with perspective.
    Vec2 half_extent = Vec2::Ones();
    bool perspective = true;
    double near = 0.1;
};

}  // namespace lissom
