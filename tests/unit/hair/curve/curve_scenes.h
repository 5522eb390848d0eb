/// A ball in a grid, and checks of constraints on it.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "kernel/hair/field/distance_grid.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/solve/grid/grid_constraints.h"
#include "tests/unit/hair/hair_support.h"

namespace lissom::test {

inline constexpr double kBallRadius = 0.09;

/// A ball of the size of a head in a cube of 30 x 30 x 30 points; no plane of them holds the
/// middle.
inline const DistanceGrid& ball() {
    static const DistanceGrid grid(make_sphere({.radius = kBallRadius, .segments = 24}),
                                   fit_grid({Vec3::Constant(-0.2), Vec3::Constant(0.2)}, 27000));
    return grid;
}

inline Vec3 place_of(const GridLayout& layout, Index point) {
    const Index nx = layout.counts[0], ny = layout.counts[1];
    return layout.point(point % nx, point / nx % ny, point / nx / ny);
}

inline bool ascending(std::span<const GridConstraint> all) {
    return std::is_sorted(all.begin(), all.end(),
                          [](const auto& a, const auto& b) { return a.point <= b.point; });
}

inline std::map<Index, Vec3> by_point(std::span<const GridConstraint> all) {
    std::map<Index, Vec3> result;
    for (const GridConstraint& c : all) result[c.point] = c.value;
    return result;
}

/// The greatest difference to the mirror image in x = 0; infinite where a point has no image.
inline double asymmetry(const GridLayout& layout, std::span<const GridConstraint> all) {
    const std::map<Index, Vec3> values = by_point(all);
    double worst = 0.0;
    for (const auto& [point, value] : values) {
        const Index i = point % layout.counts[0];
        const auto image = values.find(point + layout.counts[0] - 1 - 2 * i);
        if (image == values.end()) return std::numeric_limits<double>::infinity();
        const Vec3 mirrored(-image->second.x(), image->second.y(), image->second.z());
        worst = std::max(worst, (mirrored - value).norm());
    }
    return worst;
}

}  // namespace lissom::test
