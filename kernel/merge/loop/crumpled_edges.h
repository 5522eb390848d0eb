/// Edges that turn more beside a seam than at rest; private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/loop/rim_flare.h"

namespace lissom {

/// Distance from a seam, in its radii, within which edges are looked at.
inline constexpr double kCrumpledReach = 0.5;

/// An edge by its vertices, and its length.
struct CrumpledEdge {
    Index a = kNoIndex, b = kNoIndex;
    double length = 0.0;
};

/// Returns the edges of faces with a vertex within half a radius of a seam that turn more sharply
/// than at rest, and whose angle, positive on ridges and negative in valleys, differs by more than
/// 20 degrees from that at rest. A deformation spreads over many edges, wrinkles, pits and lips do
/// not; and a side's own ridges and valleys do not count, however rough it is, nor if they become
/// flatter. `rest` is the place of each vertex of the merged mesh on the side before, NaN for a
/// vertex without one; faces with such vertices do not count, nor do those without area. The same
/// under similarities of either place.
std::vector<CrumpledEdge> crumpled_edges(const MadeRim& made, std::span<const Vec3> rest);

/// The sum of their lengths, in radii.
double crumpled_length(const MadeRim& made, std::span<const Vec3> rest);

}  // namespace lissom
