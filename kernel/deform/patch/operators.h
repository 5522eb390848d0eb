/// Laplacian operators of a triangle list (thesis section 2.3; Meyer et al., "Discrete
/// differential-geometry operators for triangulated 2-manifolds", 2002); private to kernel/deform.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/patch.h"

namespace lissom {

/// Least angle that the corner of a triangle counts as, so that slivers and collapsed edges stay
/// finite.
inline constexpr double kSmallestAngle = 0.5 * kPi / 180.0;

/// Geometry of the one-rings. Angles count as at least the smallest one asked for, and areas
/// follow.
struct RingGeometry {
    /// (cot a + cot b) / 2 of the edge, for every entry of the rings. May be negative.
    std::vector<double> cotangent;
    /// Mixed Voronoi area of every vertex.
    std::vector<double> area;
    /// Unit normal of every vertex, weighted by angle; zero if no face has a direction.
    std::vector<Vec3> normal;
};

RingGeometry ring_geometry(const Rings& rings, const WeightedTriangles& triangles,
                           std::span<const Vec3> positions, double smallest_angle = kSmallestAngle);

/// Rows of a Laplacian: D(x)_i = self[i] x_i + sum over the ring of neighbor[entry] x_j, with the
/// weight of the row's squared residual in an energy.
struct Laplacian {
    std::vector<double> self, neighbor, weight;

    /// D(x)_i.
    Vec3 apply(const Rings& rings, std::span<const Vec3> x, Index i) const;
};

/// Pointwise cotangent or uniform Laplacian. With `scale_free` a row weighs as much as its area, so
/// that energies have no unit; without it rows are (cot a + cot b) / area or 1 / valence as the
/// thesis prints them, all with weight 1.
Laplacian make_laplacian(const Rings& rings, const RingGeometry& geometry, LaplacianWeights weights,
                         bool scale_free);

/// Root mean square distance of the surface to its area centroid; invariant under rigid motions.
double surface_radius_of(const WeightedTriangles& triangles, std::span<const Vec3> positions);

/// Mean length of the edges in `rings`.
double mean_edge_length_of(const Rings& rings, std::span<const Vec3> positions);

}  // namespace lissom
