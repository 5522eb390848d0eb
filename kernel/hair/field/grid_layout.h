/// GridLayout: the points of a uniform grid. Cells are cubes; every count of points is even, so
/// that the planes through the middle of the box hold no points: a parting in the middle of a head
/// then never falls on grid points.
#pragma once

#include <array>

#include "kernel/core/geometry.h"

namespace lissom {

struct GridLayout {
    /// Points along x, y and z.
    std::array<Index, 3> counts{0, 0, 0};
    /// The point (0, 0, 0).
    Vec3 origin = Vec3::Zero();
    /// Distance between neighbouring points.
    double step = 0.0;

    Index size() const { return counts[0] * counts[1] * counts[2]; }
    /// Number of point (i, j, k); x runs fastest.
    Index index(Index i, Index j, Index k) const { return i + counts[0] * (j + counts[1] * k); }
    Vec3 point(Index i, Index j, Index k) const { return origin + step * Vec3(i, j, k); }
    Vec3 point(Index number) const {
        return point(number % counts[0], number / counts[0] % counts[1],
                     number / (counts[0] * counts[1]));
    }
    /// From the first to the last point.
    Box box() const;
};

/// Returns the finest grid of at most `resolution` points that covers `box`; it stands out on all
/// sides alike, together by less than two steps an axis if the box is no thinner than that. Errors:
/// not_finite; invalid_argument for a box without extent on some axis, or a resolution outside
/// kMinimumResolution .. kMaximumResolution.
GridLayout fit_grid(const Box& box, Index resolution);

inline constexpr Index kMinimumResolution = 1000;
inline constexpr Index kMaximumResolution = 200'000'000;

}  // namespace lissom
