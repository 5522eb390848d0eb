/// Fits joints and weights of a linear skin to poses of a surface.
///
/// Smooth skinning decomposition with rigid bones: B. H. Le, Z. Deng, "Smooth Skinning
/// Decomposition with Rigid Bones", ACM Transactions on Graphics 31(6), 2012. The fit alternates
/// between the weights of each vertex (least squares, not negative, summing to 1, few) and the
/// rigid motion of each joint in each pose (its equation 8).
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"

namespace lissom {

struct SkinOptions {
    /// Joints, 1 to 250. Fewer come of surfaces that have fewer vertices.
    Index joints = 8;
    /// Joints that a vertex may follow, 1 to 8.
    Index influences = 4;
    /// Passes over weights and motions, at least 1.
    int passes = 10;
};

struct SkinFit {
    /// Joints a vertex follows and their weights, as many columns.
    Index influences = 0;
    /// Row by row; joints beyond those of a vertex are 0 with the weight 0.
    std::vector<Index> joints;
    std::vector<double> weights;
    /// Place of each joint at rest: the mean of its vertices.
    std::vector<Vec3> centers;
    /// The rigid motion of each joint in each pose: motions[pose][joint].
    std::vector<std::vector<Affine>> motions;
    /// Greatest and RMS distance of the skinned vertices from those of the poses.
    double max_error = 0.0, rms_error = 0.0;

    /// Returns the place of a vertex at `rest` in a pose.
    Vec3 position(Index vertex, const Vec3& rest, Index pose) const;
};

/// Fits a skin to poses, each with as many points as `rest`. With `still`, joint 0 never moves, as
/// vertices around the surface do. Errors: invalid_argument for options out of range, no points, no
/// pose, or a pose with another number of points; memory_limit; cancelled.
SkinFit fit_skin(std::span<const Vec3> rest, const std::vector<std::vector<Vec3>>& poses,
                 bool still, const SkinOptions& options = {}, const Context& context = {});

}  // namespace lissom
