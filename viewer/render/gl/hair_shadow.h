/// The shade of hair on surfaces, for their shader: that of one picture, which lies along the axes
/// of its view, or that of a window (see gpu_hair.h), for any camera. Needs a current context, also
/// to end.
#pragma once

#include <memory>

#include "kernel/core/geometry.h"
#include "viewer/render/gl/gl_objects.h"
#include "viewer/render/strands/strand_shadow.h"

namespace lissom {

/// Effect of strands on the light on surfaces, and on the colour of a scalp.
struct GpuHairShade {
    /// Remaining key light and light from all around, and density of hair; see
    /// StrandShadow::on_meshes. One texel of no hair if there are no strands.
    std::shared_ptr<const gl::Texture> volume;
    enum class Kind {
        /// Light of a picture, as described above.
        picture,
        /// Light of HairLight: its moments, and the last byte of the volume.
        moments,
        /// The same with the volume's key light.
        directed,
    };
    Kind kind = Kind::picture;
    /// HairLight::for_meshes; null for pictures.
    std::shared_ptr<const gl::Texture> moments;
    /// Map from view space to the volume's texture coordinates: rotated, scaled, then offset.
    Mat3 turn = Mat3::Identity();
    Vec3 scale = Vec3::Zero();
    Vec3 offset = Vec3::Zero();
    /// Distance between grid points in view units; 0 if there are no strands.
    double step = 0.0;
    /// Linear colour of the scalp, and the loss_on_skin of light in hair of that colour.
    Vec3 scalp_color = Vec3::Zero(), loss = Vec3::Ones();
};

/// Sets the colour and the loss.
void color_shade(GpuHairShade& shade, const Eigen::Array3f& scalp_color);

/// Sets scale, offset and step: texels are the points of `grid`.
void place_shade(GpuHairShade& shade, const ViewGrid& grid);

/// Returns the shade of hair; without strands if `shadow` is null.
GpuHairShade upload_shade(const StrandShadow* shadow);

}  // namespace lissom
