/// Light on a point of a strand: Kajiya and Kay's model with two shifted reflections and the light
/// that goes through a strand, as Marschner et al. (2003) found in real hair; and multiple
/// scattering by the dual scattering approximation (Zinke, Yuksel, Weber and Keyser, Dual
/// Scattering Approximation for Fast Multiple Scattering in Hair, 2008). Its global part is the
/// light that is scattered forward through the hair in front of a strand, more by light hair. Its
/// local part, back from the hair around a strand, is in the diffuse light: a colour is that of
/// hair seen as a whole. View space: x right, y up, z towards the viewer.
#pragma once

#include <Eigen/Core>

#include "viewer/render/draw/strand_style.h"

namespace lissom {

/// Light that reaches a point through the hair, each 0 (none) to 1.
struct StrandLight {
    float key = 1.0f;
    float rim = 1.0f;
    /// Light from all around.
    float ambient = 1.0f;
};

/// A point of a strand. Directions have unit length; a tangent without length is not lit.
struct StrandPoint {
    /// Unit tangent towards the tip.
    Eigen::Vector3f tangent = Eigen::Vector3f::Zero();
    Eigen::Vector3f to_viewer = Eigen::Vector3f::UnitZ();
    /// Linear colour.
    Eigen::Array3f color = Eigen::Array3f::Zero();
    /// Added to the shift of both lobes, radians.
    float shift = 0.0f;
    StrandLight light = {};
};

/// Kajiya and Kay's diffuse term: the sine of the angle between the strand and the light.
float strand_diffuse(const Eigen::Vector3f& tangent, const Eigen::Vector3f& to_light);

/// Returns their reflection: light that arrives at an angle from the plane across the strand leaves
/// on the cone of the same angle on the other side, rotated by the lobe's shift and `shift`. 1 on
/// that cone, less beside it.
float strand_reflection(const HairLobe& lobe, float shift, const Eigen::Vector3f& tangent,
                        const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_viewer);

/// Returns the light that leaves a strand on the side away from the light (TT of Marschner et al.),
/// 1 on the mirror cone straight behind the strand, less beside it; `shift` as above.
float strand_transmission(float shift, const Eigen::Vector3f& tangent,
                          const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_viewer);

/// Returns the part of light that a strand scatters forward, a_f of Zinke et al. `color` is linear,
/// that of hair seen as a whole: a strand absorbs as much as gives it that colour (Chiang et al., A
/// Practical and Controllable Hair and Fur Model for Production Path Tracing, 2016). Below 1 for
/// every colour.
Eigen::Array3f forward_scattering(const Eigen::Array3f& color);

/// Returns the loss of light at such a strand by that of the usual brown: light that goes through
/// hair is what brown hair leaves, to this power.
Eigen::Array3f relative_loss(const Eigen::Array3f& color);

/// Returns the same for light that falls through hair on skin, of the same mean and nearer to grey:
/// most of it comes through the gaps between strands, which colour nothing.
Eigen::Array3f loss_on_skin(const Eigen::Array3f& color);

/// Returns the transmittance of hair of this colour in front of a strand, a_f to the number of
/// strands there; `light` is that of hair of the usual brown.
Eigen::Array3f light_through_hair(float light, const Eigen::Array3f& color);

/// Returns the colour that is seen at `point`, linear, of all lights of the studio.
Eigen::Array3f shade_strand(const StrandStyle& style, const StrandPoint& point);

}  // namespace lissom
