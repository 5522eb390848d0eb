/// A grid in space: a density spread over its points, and the light that passes through.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "kernel/core/index.h"

namespace lissom {

/// Points on the corners of cubes, along the axes of the space that the grid is in.
struct ViewGrid {
    Eigen::Vector3f origin = Eigen::Vector3f::Zero();
    float step = 1.0f;
    std::array<Index, 3> counts{1, 1, 1};

    std::size_t size() const { return at(counts[0]) * counts[1] * counts[2]; }
    /// Returns the index of a point; x runs fastest.
    std::size_t index(Index i, Index j, Index k) const {
        return i + counts[0] * (j + at(counts[1]) * k);
    }
};

/// A cell of a grid and a place in it.
struct GridCell {
    std::array<Index, 3> corner;
    Eigen::Vector3f share;
};

/// Returns the cell at `position`, which is clamped to the grid.
GridCell cell_at(const ViewGrid& grid, const Eigen::Vector3f& position);

/// Calls visit(grid point, weight) for the corners of the cell at `position` with a weight.
template <typename Visit>
void for_each_corner(const ViewGrid& grid, const Eigen::Vector3f& position, const Visit& visit) {
    const GridCell cell = cell_at(grid, position);
    for (int corner = 0; corner < 8; ++corner) {
        float weight = 1.0f;
        std::array<Index, 3> at = cell.corner;
        for (int axis = 0; axis < 3; ++axis) {
            const bool far = (corner >> axis & 1) != 0;
            weight *= far ? cell.share[axis] : 1.0f - cell.share[axis];
            if (far) ++at[axis];
        }
        if (weight > 0.0f) visit(grid.index(at[0], at[1], at[2]), weight);
    }
}

/// Spreads `amount` over the eight grid points around `position`; nothing outside the grid.
void splat(const ViewGrid& grid, std::vector<float>& values, const Eigen::Vector3f& position,
           float amount);

/// Returns the part of a distant light that reaches each grid point: exp(-the extinction summed up
/// along the way to it), 1 if nothing is in the way. `extinction` is per unit of length. Goes
/// through the grid plane by plane away from the light, so that the time is linear in the number of
/// points; shadows become a little softer with every plane.
std::vector<float> light_through(const ViewGrid& grid, const std::vector<float>& extinction,
                                 const Eigen::Vector3f& to_light);

}  // namespace lissom
