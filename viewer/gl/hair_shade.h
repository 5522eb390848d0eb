/// The shade of hair on surfaces, for their shader. It lies along the axes of the view, so that it
/// is made anew where the camera moves. Needs a current context, also to end.
#pragma once

#include "kernel/core/geometry.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/strands/strand_shadow.h"

namespace lissom {

/// What strands do to the light on surfaces, and to the colour of a scalp.
struct GpuHairShade {
    /// Key light and light from all around that is left, and how much hair grows; see
    /// StrandShadow::on_meshes. One texel of no hair where there are no strands.
    gl::Texture volume;
    /// From view space to the volume's texture coordinates: scale, then offset.
    Vec3 scale = Vec3::Zero();
    Vec3 offset = Vec3::Zero();
    /// In view units: between grid points; 0 where there are no strands.
    double step = 0.0;
    /// Linear.
    Vec3 scalp_color = Vec3::Zero();
};

/// The shade of hair; without strands where `shadow` is null.
GpuHairShade upload_shade(const StrandShadow* shadow);

}  // namespace lissom
