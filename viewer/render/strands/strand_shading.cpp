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
// How much more of the light of other colours than its own is lost in hair.
constexpr float kColoring = 0.5f;

float cosine_of(float sine) {
    return std::sqrt(std::max(1.0f - sine * sine, 0.0f));
}

// How bright the reflection at the strand's surface is around it: most on the side of the light.
float facing(const Vector3f& tangent, const Vector3f& to_light, const Vector3f& to_viewer) {
    const Vector3f light = to_light - tangent.dot(to_light) * tangent;
    const Vector3f viewer = to_viewer - tangent.dot(to_viewer) * tangent;
    const float lengths = std::sqrt(light.squaredNorm() * viewer.squaredNorm());
    if (!(lengths > 1e-6f)) return 0.0f;
    const float cosine = std::clamp(light.dot(viewer) / lengths, -1.0f, 1.0f);
    return std::sqrt(0.5f * (1.0f + cosine));
}

Array3f lit(const StrandStyle& style, const StrandPoint& point, const StudioLight& light) {
    const Vector3f to_light = light.direction.normalized();
    const Vector3f& t = point.tangent;
    const float primary =
        static_cast<float>(style.primary.strength) * facing(t, to_light, point.to_viewer) *
        strand_reflection(style.primary, point.shift, t, to_light, point.to_viewer);
    const float secondary =
        static_cast<float>(style.secondary.strength) *
        strand_reflection(style.secondary, point.shift, t, to_light, point.to_viewer);
    const float diffuse = kDiffuse * strand_diffuse(t, to_light);
    return light.color * (point.color * (diffuse + secondary) + primary);
}

// Light that passed through strands has their colour: the most absorbed parts are lost first.
Array3f passed(float light, const Array3f& color) {
    const float mean = std::max(color.mean(), 1e-4f);
    const Array3f power = (1.0f + kColoring * (mean - color) / mean).max(0.3f);
    return Array3f::Constant(std::max(light, 0.0f)).pow(power);
}

}  // namespace

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

Array3f shade_strand(const StrandStyle& style, const StrandPoint& point) {
    if (!(point.tangent.squaredNorm() > 0.25f)) return Array3f::Zero();
    const StrandLight& light = point.light;
    const Array3f around = kScattered + (1.0f - kScattered) * passed(light.ambient, point.color);
    Array3f color = around * kAround * point.color;
    color += passed(light.key, point.color) * lit(style, point, kKeyLight);
    color += light.ambient * lit(style, point, kFillLight);
    color += passed(light.rim, point.color) * lit(style, point, kRimLight);
    return color;
}

}  // namespace lissom
