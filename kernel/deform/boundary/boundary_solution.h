/// BoundarySolution: a deformation by boundaries on its way from the values of held vertices to
/// positions; private to kernel/deform. Each function takes the solution of the one before it:
///
///     placed -> first_solved -> turned -> second_solved -> deformation_of
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/boundary/boundary_deformer.h"
#include "kernel/deform/boundary/boundary_sizes.h"
#include "kernel/deform/boundary/boundary_systems.h"
#include "kernel/deform/system/frame_loops.h"

namespace lissom {

/// The similarity that a solution deviates from: rest position q, in the frame of the systems, goes
/// to center + length * (rotation q + deviation).
struct BoundaryBase {
    Mat3 rotation = Mat3::Identity();
    double scale = 1.0;
    Vec3 center = Vec3::Zero();
    double length = 1.0;
};

struct BoundarySolution {
    /// Of the held vertices, in their order.
    std::vector<BoundaryValue> values;
    BoundaryBase base;
    /// Relative to the base, by local vertex: deviations of positions and of known gradients,
    /// scales, and transforms of the second system.
    std::vector<Vec3> deviation;
    std::vector<Mat3> known_turn;
    std::vector<double> size;
    std::vector<PaddedMat3> turns;
};

/// Returns the similarity that fits the values, or the identity if other vertices are fixed, with
/// the held vertices at their values.
BoundarySolution placed(const BoundarySystems& systems, std::span<const BoundaryValue> values);

/// Solves the first system (2.8), and gives each feature its affine map of least energy.
BoundarySolution first_solved(const BoundarySystems& systems, BoundarySolution from);

/// Finds the sizes and rotations of the surface. Errors: those of BoundarySizes::interpolated.
BoundarySolution turned(const BoundarySystems& systems, BoundarySizes& sizes, BoundarySolution from,
                        const Context& context);

/// Solves the second system for the rotations. Errors: cancelled.
BoundarySolution second_solved(const BoundarySystems& systems, BoundarySolution from,
                               const Context& context);

/// A solution after ARAP iterations, and the energy before them and after each.
struct RefinedSolution {
    BoundarySolution solution;
    std::vector<double> energy;
};
/// Makes at most `steps` iterations. Errors: cancelled.
RefinedSolution refined(const BoundarySystems& systems, BoundarySolution from, int steps,
                        const Context& context);

/// Returns positions, transforms and pulls; no energy and no times.
BoundaryDeformation deformation_of(const BoundarySystems& systems,
                                   const BoundarySolution& solution);

}  // namespace lissom
