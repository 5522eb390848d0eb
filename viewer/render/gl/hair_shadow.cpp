#include "viewer/render/gl/hair_shadow.h"

#include <array>
#include <cstdint>

#include "viewer/render/strands/strand_shading.h"

namespace lissom {

void place_shade(GpuHairShade& shade, const ViewGrid& grid) {
    shade.step = grid.step;
    for (int axis = 0; axis < 3; ++axis) {
        const Index count = grid.counts[axis];
        shade.scale[axis] = 1.0 / (count * shade.step);
        shade.offset[axis] = 0.5 / count - grid.origin[axis] * shade.scale[axis];
    }
}

void color_shade(GpuHairShade& shade, const Eigen::Array3f& scalp_color) {
    shade.scalp_color = scalp_color.cast<double>();
    shade.loss = loss_on_skin(scalp_color).cast<double>();
}

GpuHairShade upload_shade(const StrandShadow* shadow) {
    GpuHairShade shade;
    if (!shadow) {
        const std::array<std::uint8_t, 4> no_hair{255, 255, 0, 255};
        shade.volume = std::make_shared<const gl::Texture>(gl::make_volume({1, 1, 1}, no_hair));
        return shade;
    }
    const ViewGrid& grid = shadow->grid();
    shade.volume =
        std::make_shared<const gl::Texture>(gl::make_volume(grid.counts, shadow->on_meshes()));
    place_shade(shade, grid);
    color_shade(shade, shadow->scalp_color());
    return shade;
}

}  // namespace lissom
