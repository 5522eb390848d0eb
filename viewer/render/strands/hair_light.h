/// The light in hair for any camera. The lights are those of the camera, so that they go around the
/// hair when it turns: stored is the light that reaches each place from all around.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viewer/render/draw/snapshot.h"
#include "viewer/render/strands/strand_extinction.h"

namespace lissom {

/// Light from all around that is left at each grid point, as a linear function of the direction
/// that it comes from: m + d . g, as four bytes (m and (g + 1) / 2, each times 255). The mean of
/// directions with any weights that are linear in them is exact; one direction alone is softened.
using LightMoments = std::vector<std::uint8_t>;

class HairLight {
  public:
    /// Computes the light of the strands and meshes of `snapshot`, in its world about `origin`.
    /// Errors: those of view_strands; memory_limit; cancelled.
    HairLight(const Snapshot& snapshot, const Vec3& origin, const LightDetail& detail = {},
              const Context& context = {});

    /// Returns the grid, along the axes of the world, about `origin`.
    const ViewGrid& grid() const { return grid_; }
    const Vec3& origin() const { return origin_; }
    /// Return the transmittance of strands and meshes, for strands; and of strands alone, for
    /// meshes.
    const LightMoments& for_strands() const { return for_strands_; }
    const LightMoments& for_meshes() const { return for_meshes_; }
    /// Returns the linear colour of scalps with hair.
    const Eigen::Array3f& scalp_color() const { return scalp_color_; }

    /// Returns four bytes a grid point for a camera that turns the world by `to_view`: the roots of
    /// key and rim light for strands, which light hair still sees where hardly any is left; key
    /// light for meshes; and the density of hair, as in StrandShadow.
    std::vector<std::uint8_t> directed(const Mat3& to_view, const Context& context = {}) const;
    /// Returns the last of these four bytes, the others 0.
    std::vector<std::uint8_t> undirected() const;

  private:
    LightMoments moments(const std::vector<float>& extinction) const;

    ViewGrid grid_;
    Vec3 origin_;
    std::vector<float> hair_, everything_;
    std::vector<std::uint8_t> tint_;
    LightMoments for_strands_, for_meshes_;
    Eigen::Array3f scalp_color_;
    MemoryCharge charge_;
};

/// Returns the part of the light that comes from `direction`, of unit length, by its moments.
float light_from(const std::uint8_t* moments, const Eigen::Vector3f& direction);
/// Returns the remaining part of the light from all around; `up` points up.
float ambient_light(const std::uint8_t* moments, const Eigen::Vector3f& up);
/// Returns the weight of the directed part in that: the sky is so much brighter than the middle.
float ambient_slope();

}  // namespace lissom
