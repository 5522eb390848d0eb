/// Handle transforms propagated over the surface, and positions from the gradients that they
/// transform; private to kernel/thesis.
#pragma once

#include <memory>

#include "kernel/core/context.h"
#include "kernel/deform/comparison_method.h"

namespace lissom {

/// Explicit methods: each handle's gradient is split into a rotation and a stretch; their blend
/// exp(sum w_h r_h) sum w_h S_h transforms the gradient of each triangle, and a Poisson system
/// makes the surface whose gradients are nearest to those. r_h is the handle's rotation vector,
/// which may be longer than pi. A translation of handles turns nothing.
///
/// `geodesic`: weights from geodesic distances; Yu, Zhou, Xu, Shi, Bao, Guo and Shum, "Mesh editing
/// with Poisson-based gradient field manipulation" (2004). `harmonic`: harmonic fields; Zayer,
/// Rossl, Karni and Seidel, "Harmonic guidance for surface deformation" (2005).
/// Errors: as make_comparison.
std::unique_ptr<ComparisonMethod> make_propagation(const ComparisonProblem& problem,
                                                   const Context& context);

}  // namespace lissom
