#include "viewer/render/strands/hair_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/render/draw/studio_light.h"

namespace lissom {
namespace {

using Eigen::Vector3f;

// Working memory of a grid point while the light is found, and its results.
constexpr std::size_t kWorkingBytes = (kExtinctionParts + 12) * sizeof(float);
constexpr std::size_t kKeptBytes = 2 * sizeof(float) + 9;

std::uint8_t share_byte(float share) {
    return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(share, 0.0f, 1.0f)));
}

float share_of(std::uint8_t byte) {
    return byte / 255.0f;
}

Vector3f slope_of(const std::uint8_t* moments) {
    return 2.0f * Vector3f(share_of(moments[1]), share_of(moments[2]), share_of(moments[3])) -
           Vector3f::Ones();
}

}  // namespace

HairLight::HairLight(const Snapshot& snapshot, const Vec3& origin, const LightDetail& detail,
                     const Context& context)
    : origin_(origin) {
    const std::vector<ViewStrands> strands = view_strands(snapshot, Mat4::Identity(), origin);
    const std::vector<ViewTriangle> triangles = view_triangles(snapshot, Mat4::Identity(), origin);
    grid_ = fit_grid(strands, triangles, detail);
    const MemoryCharge working = context.charge(grid_.size() * kWorkingBytes, "the light in hair");
    charge_ = context.charge(grid_.size() * kKeptBytes, "the light in hair");
    hair_ = hair_extinction(grid_, strands, detail, context);
    everything_ = hair_;
    add_mesh_extinction(grid_, everything_, triangles);
    scalp_color_ = mean_root_color(strands);
    for (const float tint : scalp_tint(grid_, strands)) tint_.push_back(share_byte(tint));
    context.parallel_for(0, 2, 1, [&](Index which, Index) {
        (which == 0 ? for_strands_ : for_meshes_) = moments(which == 0 ? everything_ : hair_);
    });
    context.checkpoint();
}

// The corners of an icosahedron are spread so evenly that sums over them are integrals, for
// polynomials of up to degree five: the fit by least squares is mean(T) + 3 mean(T d) . d.
LightMoments HairLight::moments(const std::vector<float>& extinction) const {
    std::vector<float> mean(grid_.size(), 0.0f);
    std::vector<Vector3f> slope(grid_.size(), Vector3f::Zero());
    const std::vector<AmbientDirection> directions = ambient_directions();
    const float part = 1.0f / static_cast<float>(directions.size());
    for (const AmbientDirection& from : directions) {
        const Vector3f d = 3.0f * part * from.direction.normalized();
        const std::vector<float> light = light_through(grid_, extinction, from.direction);
        for (std::size_t i = 0; i < light.size(); ++i) {
            mean[i] += part * light[i];
            slope[i] += light[i] * d;
        }
    }
    LightMoments result;
    result.reserve(4 * grid_.size());
    for (std::size_t i = 0; i < mean.size(); ++i) {
        result.push_back(share_byte(mean[i]));
        for (const float x : slope[i]) result.push_back(share_byte(0.5f + 0.5f * x));
    }
    return result;
}

std::vector<std::uint8_t> HairLight::directed(const Mat3& to_view, const Context& context) const {
    const Eigen::Matrix3f from_view = to_view.transpose().cast<float>();
    const MemoryCharge working = context.charge(grid_.size() * 16, "the light in hair");
    std::array<std::vector<float>, 3> lights;
    context.parallel_for(0, 3, 1, [&](Index which, Index) {
        const Vector3f to_light = which == 1 ? kRimLight.direction : kKeyLight.direction;
        lights[which] =
            light_through(grid_, which == 2 ? hair_ : everything_, from_view * to_light);
    });
    std::vector<std::uint8_t> result(4 * grid_.size());
    for (std::size_t i = 0; i < grid_.size(); ++i) {
        result[4 * i] = share_byte(std::sqrt(lights[0][i]));
        result[4 * i + 1] = share_byte(std::sqrt(lights[1][i]));
        result[4 * i + 2] = share_byte(lights[2][i]);
        result[4 * i + 3] = tint_[i];
    }
    return result;
}

std::vector<std::uint8_t> HairLight::undirected() const {
    std::vector<std::uint8_t> result(4 * grid_.size(), 0);
    for (std::size_t i = 0; i < grid_.size(); ++i) result[4 * i + 3] = tint_[i];
    return result;
}

float light_from(const std::uint8_t* moments, const Vector3f& direction) {
    return std::clamp(share_of(moments[0]) + slope_of(moments).dot(direction), 0.0f, 1.0f);
}

// The weights of StrandShadow's directions are linear in them.
float ambient_slope() {
    const float sky = kSkyLight.mean(), ground = kGroundLight.mean();
    return (sky - ground) / (3.0f * (sky + ground));
}

float ambient_light(const std::uint8_t* moments, const Vector3f& up) {
    return share_of(moments[0]) + ambient_slope() * slope_of(moments).dot(up);
}

}  // namespace lissom
