#include "viewer/render/strands/strand_shading.h"

#include <algorithm>
#include <cmath>

#include "viewer/render/draw/studio_light.h"

namespace lissom {
namespace {

using Eigen::Array3f;
using Eigen::Vector3f;

// Part of the light that leaves a strand on all sides.
constexpr float kDiffuse = 0.62f;
// Light from all around: between that of the sky and of the ground, as much as strands catch of it.
const Array3f kAround = 0.62f * kSkyLight + 0.38f * kGroundLight;
// Hair scatters light onwards: shade is not quite black.
constexpr float kScattered = 0.06f;
// Of light that meets a strand, a part goes on forward if nothing is absorbed. What is absorbed on
// the way through, pi / 2 radii in the mean, is this times the square of the colour's logarithm
// (Chiang et al. 2016, for a roughness of 0.3).
constexpr float kForward = 0.80f, kAbsorbed = 0.0462f;
// Loss of light at a strand of the usual brown, in the mean: -ln a_f of a colour of 0.16.
constexpr float kUsualLoss = 0.378f;
// Colour that is left of that of light through hair on skin; with all of it shadows are orange.
constexpr float kSkinTint = 0.35f;
// Hairs behind each other that light passes in what is drawn as one strand.
constexpr float kHairs = 3.0f;
// The light through a strand: leaning half as much as the reflection does, and to the other side;
// and how fast it fades around the strand, as fitted by Karis (Physically Based Hair Shading in
// Unreal, 2016).
constexpr HairLobe kThrough{1.0, 20.0, -0.05};
constexpr float kFading = 7.3f;

float cosine_of(float sine) {
    return std::sqrt(std::max(1.0f - sine * sine, 0.0f));
}

// Square of the cosine of half the angle around the strand between light and viewer: 1 on the side
// of the light, 0 behind the strand and for strands along either.
float facing(const Vector3f& tangent, const Vector3f& to_light, const Vector3f& to_viewer) {
    const Vector3f light = to_light - tangent.dot(to_light) * tangent;
    const Vector3f viewer = to_viewer - tangent.dot(to_viewer) * tangent;
    const float lengths = std::sqrt(light.squaredNorm() * viewer.squaredNorm());
    if (!(lengths > 1e-6f)) return 0.0f;
    return 0.5f + 0.5f * std::clamp(light.dot(viewer) / lengths, -1.0f, 1.0f);
}

// Light of a lamp at a strand: of all that arrives scattered and straight, the part that is left.
struct Arriving {
    Array3f all;
    float straight;
};

Array3f lit(const StrandStyle& style, const StrandPoint& point, const StudioLight& light,
            const Arriving& arriving) {
    const Vector3f to_light = light.direction.normalized();
    const Vector3f& t = point.tangent;
    const float primary =
        static_cast<float>(style.primary.strength) *
        std::sqrt(facing(t, to_light, point.to_viewer)) *
        strand_reflection(style.primary, point.shift, t, to_light, point.to_viewer);
    const float secondary =
        static_cast<float>(style.secondary.strength) *
        strand_reflection(style.secondary, point.shift, t, to_light, point.to_viewer);
    const float diffuse = kDiffuse * strand_diffuse(t, to_light);
    // A reflection is sharp in light that comes straight; what was scattered before is too blurred.
    return light.color *
           (arriving.all * point.color * (diffuse + secondary) + arriving.straight * primary);
}

// Light through a strand.
Array3f lit_through(const StrandPoint& point, const StudioLight& light, const Arriving& arriving) {
    const float through = strand_transmission(point.shift, point.tangent,
                                              light.direction.normalized(), point.to_viewer);
    return light.color * arriving.all * through * forward_scattering(point.color).pow(kHairs);
}

}  // namespace

Array3f forward_scattering(const Array3f& color) {
    return kForward * (-kAbsorbed * color.max(1e-3f).min(1.0f).log().square()).exp();
}

Array3f relative_loss(const Array3f& color) {
    return -forward_scattering(color).log() / kUsualLoss;
}

Array3f loss_on_skin(const Array3f& color) {
    const Array3f loss = relative_loss(color);
    return loss.mean() + kSkinTint * (loss - loss.mean());
}

Array3f light_through_hair(float light, const Array3f& color) {
    return Array3f::Constant(std::max(light, 0.0f)).pow(relative_loss(color));
}

float strand_diffuse(const Vector3f& tangent, const Vector3f& to_light) {
    return cosine_of(tangent.dot(to_light));
}

float strand_reflection(const HairLobe& lobe, float shift, const Vector3f& tangent,
                        const Vector3f& to_light, const Vector3f& to_viewer) {
    const float light_sine = tangent.dot(to_light), viewer_sine = tangent.dot(to_viewer);
    const float light_cosine = cosine_of(light_sine), viewer_cosine = cosine_of(viewer_sine);
    // Cosine and sine of the sum of both angles from the plane across the strand, 0 in a mirror.
    const float cosine = light_cosine * viewer_cosine - light_sine * viewer_sine;
    const float sine = light_sine * viewer_cosine + light_cosine * viewer_sine;
    const float lean = static_cast<float>(lobe.shift) + shift;
    const float off = cosine * std::cos(lean) + sine * std::sin(lean);
    return off > 0.0f ? std::pow(off, static_cast<float>(lobe.exponent)) : 0.0f;
}

float strand_transmission(float shift, const Vector3f& tangent, const Vector3f& to_light,
                          const Vector3f& to_viewer) {
    return std::exp(-kFading * facing(tangent, to_light, to_viewer)) *
           strand_reflection(kThrough, shift, tangent, to_light, to_viewer);
}

Array3f shade_strand(const StrandStyle& style, const StrandPoint& point) {
    if (!(point.tangent.squaredNorm() > 0.25f)) return Array3f::Zero();
    const StrandLight& light = point.light;
    const auto arriving = [&](float left) {
        return Arriving{light_through_hair(left, point.color), left};
    };
    const Arriving key = arriving(light.key), rim = arriving(light.rim),
                   ambient = arriving(light.ambient);
    const Array3f around = kScattered + (1.0f - kScattered) * ambient.all;
    // Of the lamps, the rim light alone is behind the hair: through strands of the front hardly any
    // of the others goes to the viewer.
    return around * kAround * point.color + lit(style, point, kKeyLight, key) +
           lit(style, point, kFillLight, ambient) + lit(style, point, kRimLight, rim) +
           lit_through(point, kRimLight, rim);
}

}  // namespace lissom
