/// Transition regions: bands on both sides of a seam whose details cross-fade into each other
/// (thesis section 3.3.3).
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"

namespace lissom {

struct Sewn;

/// Reach of a transition from one seam, in geodesic distance on the merged mesh: a width of
/// the source is in the merged mesh's unit too, which is the source's times the scale of its join.
/// A side of width 0 does not move; then the other one takes over all of its shape at the seam,
/// read from a band as wide as its own.
struct TransitionWidths {
    double target = 0.0, source = 0.0;
};

/// Widths that suit each seam of `sewn`: .9 of its radius (length over 2 pi), at least three edges
/// of the side beside it, at most half of the greatest distance there is on the side, and never
/// more than there is room for. Errors: memory_limit; cancelled.
std::vector<TransitionWidths> suitable_widths(const Sewn& sewn, const Context& context = {});

struct TransitionOptions {
    /// Core of the seam, as SeamFairing: rings whose curvature continues that of the surface around
    /// them, at least 1, umbrella steps within it, 0 or more, and times that the bands are bent, at
    /// least 1.
    Index core = 3;
    Index umbrella = 1;
    Index passes = 2;
    /// Vertices that stay, ascending.
    std::vector<Index> firm = {};
};

/// Measures of the band on one side of a seam.
struct TransitionBand {
    /// Width used: the given one, or less for lack of room. The most are half the distance to the
    /// nearest other seam, the distance to an open boundary that goes around the band, and nine
    /// tenths of the greatest distance on the side.
    double width = 0.0;
    /// Vertices within it.
    Index vertices = 0;
    /// Triangles that the band's coordinates turn over, and vertices without a counterpart in the
    /// other band, which took that with the nearest coordinates. Both are 0 unless the band has
    /// folds or holes.
    Index flipped = 0, unmapped = 0;
};

/// Measures of a transition.
struct TransitionReport {
    /// The bands of each seam, in the order of Sewn::seams.
    std::vector<TransitionBand> target, source;
    /// Vertices that were free to move, ascending.
    std::vector<Index> moved;
    /// The part of the way that the bands went: less than 1 if all of it would have folded the
    /// surface.
    double kept = 1.0;
};

/// Blends the two sides of every seam of `sewn` within bands beside it, in place. A vertex of one
/// band corresponds to the point of the other one with the same coordinates (band_chart.h: angle
/// around the seam, distance over width). Its mean curvature becomes a mean of its own and of its
/// counterpart's, half of either at the seam and all its own at the end of the band (smoothstep);
/// in the core of the seam it continues the curvature around it. The bands take the shape with
/// these curvatures in the least squares, weighted by area; everything else stays to the bit, open
/// boundaries included. "normal" attributes turn with the surface. The way there is gone only as
/// far as it does no harm: no dihedral angle across the seams may become greater than the greatest
/// before, or than 20 degrees, and none near them than the greatest before, or than 10, which do
/// not show; the bands may not become rougher by more than a tenth (SeamGuard), and no face may run
/// through another that it did not.
/// Errors: invalid_argument for a number of widths other than that of seams, widths that are
/// negative or not finite, and options out of range; not_positive_definite; memory_limit;
/// cancelled. The mesh is then unchanged.
TransitionReport blend_transition(Sewn& sewn, std::span<const TransitionWidths> widths,
                                  const TransitionOptions& options = {},
                                  const Context& context = {});

}  // namespace lissom
