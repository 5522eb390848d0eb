/// Light at each place in and around hair: the density of strands on a grid, and the
/// light that is left after passing through it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "viewer/render/strands/strand_shading.h"
#include "viewer/render/strands/view_grid.h"
#include "viewer/render/strands/view_strands.h"

namespace lissom {

/// The light in a drawing with strands.
class StrandShadow {
  public:
    /// Errors: memory_limit; cancelled.
    StrandShadow(std::span<const ViewStrands> strands, std::span<const ViewTriangle> triangles,
                 const Context& context = {});

    /// Returns the light at a place among the strands, which they and the meshes shade.
    StrandLight light(const Eigen::Vector3f& position) const;

    const ViewGrid& grid() const { return grid_; }
    /// Four bytes a grid point, for meshes, which shade themselves otherwise: the part of the key
    /// light and of the light from all around that the strands let through, and how much hair grows
    /// there, 0 to 255.
    const std::vector<std::uint8_t>& on_meshes() const { return on_meshes_; }
    /// Returns the linear colour of scalps with hair.
    const Eigen::Array3f& scalp_color() const { return scalp_color_; }

  private:
    using Corner = std::array<float, 4>;

    void compute(const std::vector<float>& hair, const std::vector<float>& everything,
                 const std::vector<float>& tint, const Context& context);

    ViewGrid grid_;
    /// Key, rim and ambient light for strands.
    std::vector<Corner> light_;
    std::vector<std::uint8_t> on_meshes_;
    Eigen::Array3f scalp_color_ = Eigen::Array3f::Zero();
    MemoryCharge charge_;
};

}  // namespace lissom
