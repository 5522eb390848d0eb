/// Curves of a hairstyle as polylines.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/hair/field/distance_grid.h"

namespace lissom {

/// Errors: not_finite, saying which point; invalid_argument if fewer than two of the points differ.
void require_curve(std::span<const Vec3> points);

/// Errors: invalid_argument for a weight that no constraint may have (constraint_weight.h).
void require_curve_weight(double weight);

double curve_length(std::span<const Vec3> points);

/// Returns a smooth curve through `points`, of segments at most `step` long: centripetal
/// Catmull-Rom (Barry and Goldman 1988; Yuksel et al. 2011), which neither loops nor leaves its
/// points far. Repeated points are left out. Errors: as require_curve; invalid_argument for a step
/// that is not above 0; out_of_range for a curve of more than a million steps.
std::vector<Vec3> smooth_curve(std::span<const Vec3> points, double step);

/// Returns the same polyline in segments of equal length, closest to `step`, with the same ends
/// (section 4.5). Errors: as smooth_curve.
std::vector<Vec3> resampled_curve(std::span<const Vec3> points, double step);

/// Moves points inside the head or nearer than `clearance` to its surface outward to that distance,
/// within the range of the grid of distances.
void push_out(std::span<Vec3> points, const DistanceGrid& distances, double clearance);

}  // namespace lissom
