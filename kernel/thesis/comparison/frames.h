/// Rotation-invariant coordinates; private to kernel/thesis.
#pragma once

#include <memory>

#include "kernel/core/context.h"
#include "kernel/deform/comparison_method.h"

namespace lissom {

/// Lipman, Sorkine, Levin and Cohen-Or, "Linear rotation-invariant coordinates for meshes" (2005):
/// each vertex has an orthonormal frame F_i at rest, and each edge the frame of one end as seen
/// from the other and the edge itself in the frame of its vertex. First the frames are solved for,
/// from those that handles prescribe and the differences between neighbours, in the least-squares
/// sense and then made orthonormal; then the positions, from the edges that the frames give.
///
/// With F_i = R_i F_i(rest) the first energy, sum of |F_j - F_i F_i(rest)^T F_j(rest)|^2, is
/// sum of |R_j - R_i|^2: the entries of R_i are harmonic functions of those at the handles, so that
/// the choice of frames at rest does not matter and one scalar system serves for all of them. Scale
/// is not propagated, and a rotation beyond pi is one the other way round.
/// Errors: as make_comparison.
std::unique_ptr<ComparisonMethod> make_frames(const ComparisonProblem& problem,
                                              const Context& context);

}  // namespace lissom
