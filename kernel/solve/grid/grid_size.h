/// GridSize: how many points a uniform grid has, and how they are numbered.
#pragma once

#include <cstddef>

#include "kernel/core/geometry.h"

namespace lissom {

/// Position of a point in a grid, in steps from the first point.
struct GridPoint {
    Index x = 0, y = 0, z = 0;
    bool operator==(const GridPoint&) const = default;
};

/// Points along each axis. Point (x, y, z) has the index x + nx (y + ny z).
struct GridSize {
    Index nx = 0, ny = 0, nz = 0;

    /// Points of the grid.
    Index count() const { return nx * ny * nz; }
    Index index(const GridPoint& p) const { return p.x + nx * (p.y + ny * p.z); }
    GridPoint point(Index i) const { return {i % nx, i / nx % ny, i / nx / ny}; }
    Index operator[](int axis) const { return axis == 0 ? nx : axis == 1 ? ny : nz; }
    bool operator==(const GridSize&) const = default;
};

/// Points that an axis has at most: the tables of an axis take the square of it.
inline constexpr Index kLongestAxis = 2048;
/// Points that a grid has at most, so that the entries of three components have an Index.
inline constexpr Index kMaxGridPoints = Index{1} << 28;

/// Errors: invalid_argument if an axis has no point or more than kLongestAxis, or if the grid has
/// more than kMaxGridPoints (a sixteenth of them with addresses of 32 bits).
void require_valid(const GridSize& size);

}  // namespace lissom
