#include "viewer/render/strands/view_grid.h"

#include <algorithm>
#include <cmath>

namespace lissom {

GridCell cell_at(const ViewGrid& grid, const Eigen::Vector3f& position) {
    GridCell cell{};
    const Eigen::Vector3f at = (position - grid.origin) / grid.step;
    for (int axis = 0; axis < 3; ++axis) {
        const Index last = grid.counts[axis] - 1;
        const float x = std::clamp(at[axis], 0.0f, static_cast<float>(last));
        const Index corner = std::min(static_cast<Index>(x), std::max(last - 1, Index{0}));
        cell.corner[axis] = corner;
        cell.share[axis] = x - corner;
    }
    return cell;
}

void splat(const ViewGrid& grid, std::vector<float>& values, const Eigen::Vector3f& position,
           float amount) {
    const Eigen::Vector3f at = (position - grid.origin) / grid.step;
    for (int axis = 0; axis < 3; ++axis) {
        const float last = grid.counts[axis] - 1;
        if (!(at[axis] >= 0.0f && at[axis] <= last)) return;
    }
    for_each_corner(grid, position,
                    [&](std::size_t i, float weight) { values[i] += weight * amount; });
}

std::vector<float> light_through(const ViewGrid& grid, const std::vector<float>& extinction,
                                 const Eigen::Vector3f& to_light) {
    const Eigen::Vector3f d = to_light.normalized();
    int major = 0;
    d.cwiseAbs().maxCoeff(&major);
    const std::array<std::size_t, 3> axis{at(major), at((major + 1) % 3), at((major + 2) % 3)};
    const std::array<std::ptrdiff_t, 3> strides{
        1, grid.counts[0], static_cast<std::ptrdiff_t>(grid.counts[0]) * grid.counts[1]};
    const auto stride = [&](std::size_t i) { return strides[axis[i]]; };
    const auto count = [&](std::size_t i) { return grid.counts[axis[i]]; };
    const Index towards = d[major] > 0.0f ? 1 : -1;
    // One plane nearer to the light, the ray to it is so many cells aside.
    const float aside_u = d[index_of(axis[1])] / std::abs(d[major]);
    const float aside_v = d[index_of(axis[2])] / std::abs(d[major]);
    const auto cell_u = static_cast<Index>(std::floor(aside_u));
    const auto cell_v = static_cast<Index>(std::floor(aside_v));
    const float share_u = aside_u - cell_u;
    const float share_v = aside_v - cell_v;
    const std::array<float, 4> weights{(1 - share_u) * (1 - share_v), share_u * (1 - share_v),
                                       (1 - share_u) * share_v, share_u * share_v};
    const float half_way = 0.5f * grid.step / std::abs(d[major]);

    std::vector<float> light(grid.size(), 1.0f);
    const Index planes = count(0);
    for (Index n = 0; n < planes; ++n) {
        const Index plane = towards > 0 ? planes - 1 - n : n;
        for (Index v = 0; v < count(2); ++v) {
            for (Index u = 0; u < count(1); ++u) {
                const std::ptrdiff_t here = plane * stride(0) + u * stride(1) + v * stride(2);
                float arriving = n == 0 ? 1.0f : 0.0f;
                float passed = extinction[here];
                for (int corner = 0; n > 0 && corner < 4; ++corner) {
                    const Index cu = u + cell_u + (corner & 1), cv = v + cell_v + (corner >> 1);
                    const float weight = weights[corner];
                    if (cu < 0 || cv < 0 || cu >= count(1) || cv >= count(2)) {
                        arriving += weight;
                        continue;
                    }
                    const std::size_t there =
                        (plane + towards) * stride(0) + cu * stride(1) + cv * stride(2);
                    arriving += weight * light[there];
                    passed += weight * extinction[there];
                }
                if (passed > 0.0f) arriving *= std::exp(-half_way * passed);
                light[here] = arriving;
            }
        }
    }
    return light;
}

}  // namespace lissom
