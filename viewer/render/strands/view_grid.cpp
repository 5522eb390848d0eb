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

namespace {

// Passes light from plane to plane of a grid, each plane from the one that is nearer to the light.
class LightSweep {
  public:
    LightSweep(const ViewGrid& grid, const std::vector<float>& extinction, const Eigen::Vector3f& d)
        : extinction_(extinction), light_(grid.size(), 1.0f) {
        int major = 0;
        d.cwiseAbs().maxCoeff(&major);
        const std::array<std::ptrdiff_t, 3> strides{
            1, grid.counts[0], static_cast<std::ptrdiff_t>(grid.counts[0]) * grid.counts[1]};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t axis = at((major + index_of(i)) % 3);
            count_[i] = grid.counts[axis];
            stride_[i] = strides[axis];
        }
        towards_ = d[major] > 0.0f ? 1 : -1;
        // One plane nearer to the light, the ray to it is so many cells aside.
        const float aside_u = d[(major + 1) % 3] / std::abs(d[major]);
        const float aside_v = d[(major + 2) % 3] / std::abs(d[major]);
        cell_u_ = static_cast<Index>(std::floor(aside_u));
        cell_v_ = static_cast<Index>(std::floor(aside_v));
        const float share_u = aside_u - cell_u_, share_v = aside_v - cell_v_;
        weights_ = {(1 - share_u) * (1 - share_v), share_u * (1 - share_v), (1 - share_u) * share_v,
                    share_u * share_v};
        half_way_ = 0.5f * grid.step / std::abs(d[major]);
    }

    std::vector<float> run() {
        for (Index n = 0; n < count_[0]; ++n) {
            const Index plane = towards_ > 0 ? count_[0] - 1 - n : n;
            for (Index v = 0; v < count_[2]; ++v) {
                for (Index u = 0; u < count_[1]; ++u) light(plane, u, v, n == 0);
            }
        }
        return std::move(light_);
    }

  private:
    std::ptrdiff_t place(Index plane, Index u, Index v) const {
        return plane * stride_[0] + u * stride_[1] + v * stride_[2];
    }

    void light(Index plane, Index u, Index v, bool first) {
        const std::ptrdiff_t here = place(plane, u, v);
        float arriving = first ? 1.0f : 0.0f;
        float passed = extinction_[here];
        for (int corner = 0; !first && corner < 4; ++corner) {
            const Index cu = u + cell_u_ + (corner & 1), cv = v + cell_v_ + (corner >> 1);
            const float weight = weights_[corner];
            if (cu < 0 || cv < 0 || cu >= count_[1] || cv >= count_[2]) {
                arriving += weight;
                continue;
            }
            const std::ptrdiff_t there = place(plane + towards_, cu, cv);
            arriving += weight * light_[there];
            passed += weight * extinction_[there];
        }
        if (passed > 0.0f) arriving *= std::exp(-half_way_ * passed);
        light_[here] = arriving;
    }

    const std::vector<float>& extinction_;
    std::vector<float> light_;
    // The axis that is nearest to the direction of the light, and the two others.
    std::array<Index, 3> count_{};
    std::array<std::ptrdiff_t, 3> stride_{};
    Index towards_ = 1, cell_u_ = 0, cell_v_ = 0;
    // Of the four cells around the ray.
    std::array<float, 4> weights_{};
    float half_way_ = 0.0f;
};

}  // namespace

std::vector<float> light_through(const ViewGrid& grid, const std::vector<float>& extinction,
                                 const Eigen::Vector3f& to_light) {
    return LightSweep(grid, extinction, to_light.normalized()).run();
}

}  // namespace lissom
