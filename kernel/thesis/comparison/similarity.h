/// Laplacian coordinates transformed by similarities that are implicit in the positions; private to
/// kernel/thesis.
#pragma once

#include <memory>

#include "kernel/core/context.h"
#include "kernel/deform/comparison_method.h"

namespace lissom {

/// Sorkine, Cohen-Or, Lipman, Alexa, Rossl and Seidel, "Laplacian surface editing" (2004):
/// minimises sum of a_i |D(x)_i - T_i(x) delta_i|^2. T_i = s_i I + [h_i] is the similarity,
/// linearised in the rotation, that best maps vertex i and its ring at rest to their new positions;
/// s_i and h_i are linear in x, so that all coordinates make one system of 3 n unknowns. Exact for
/// uniform scales and translations, and for rotations to first order in the angle. Gradients of
/// handles have no effect but through their positions.
std::unique_ptr<ComparisonMethod> make_similarity(const ComparisonProblem& problem,
                                                  const Context& context);

}  // namespace lissom
