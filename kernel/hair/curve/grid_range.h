/// The points of a grid that lie in a box.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/field/grid_layout.h"

namespace lissom {

/// Calls `visit` with the indices {i, j, k} of every point of the grid in `box`, ascending by
/// GridLayout::index.
template <typename Visit>
void for_grid_points_in(const GridLayout& layout, const Box& box, const Visit& visit) {
    std::array<Index, 3> first{}, end{};
    for (int axis = 0; axis < 3; ++axis) {
        // Clamped before it must fit an Index.
        const auto cells_below = [&](double coordinate) {
            const double cell = std::floor((coordinate - layout.origin[axis]) / layout.step);
            return static_cast<Index>(std::clamp(cell, -1.0, layout.counts[at(axis)] - 1.0)) + 1;
        };
        first[axis] = cells_below(box.min[axis]);
        end[axis] = cells_below(box.max[axis]);
    }
    for (Index k = first[2]; k < end[2]; ++k) {
        for (Index j = first[1]; j < end[1]; ++j) {
            for (Index i = first[0]; i < end[0]; ++i) visit(std::array<Index, 3>{i, j, k});
        }
    }
}

}  // namespace lissom
