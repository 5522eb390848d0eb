/// Reconstruction from Laplacian coordinates without a transformation, and with rotations estimated
/// from that; private to kernel/thesis.
#pragma once

#include <memory>

#include "kernel/core/context.h"
#include "kernel/deform/comparison_method.h"

namespace lissom {

/// Laplacian coordinates as they are in the rest shape (Eq 2.1, or 2.2 with M_i = I): minimises
/// sum of a_i |D(x)_i - delta_i|^2. Details keep their direction in space. Gradients of handles
/// have no effect.
std::unique_ptr<ComparisonMethod> make_naive(const ComparisonProblem& problem,
                                             const Context& context);

/// Lipman, Sorkine, Cohen-Or, Levin, Rossl and Seidel, "Differential coordinates for interactive
/// mesh editing" (2004): the naive solution first; from it and from the rest shape a local frame a
/// vertex, made of the normal averaged over the one-ring and of one edge projected to the tangent
/// plane; then a second solve by the same factor with each delta_i turned as its frame has turned.
/// Gradients of handles have no effect but through their positions.
std::unique_ptr<ComparisonMethod> make_rotation_estimate(const ComparisonProblem& problem,
                                                         const Context& context);

}  // namespace lissom
