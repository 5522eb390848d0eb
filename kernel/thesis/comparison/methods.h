/// The methods that the thesis compares its own with (sections 2.3 and 2.4.4).
///
///     Deformer deformer(mesh, region, compared_by(DeformMethod::harmonic));
#pragma once

#include <memory>

#include "kernel/core/context.h"
#include "kernel/deform/comparison_method.h"
#include "kernel/deform/options.h"

namespace lissom {

/// Builds and factors `problem.options.method`, which is not `implicit`: a ComparisonMaker.
/// Errors: unconstrained if the method propagates gradients and a part has none;
/// not_positive_definite with local vertices as elements; memory_limit; cancelled.
std::unique_ptr<ComparisonMethod> make_comparison(const ComparisonProblem& problem,
                                                  const Context& context);

/// Returns the default options with a method, and its maker.
DeformOptions compared_by(DeformMethod method);

}  // namespace lissom
