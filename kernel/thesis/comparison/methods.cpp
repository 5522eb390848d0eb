#include "kernel/thesis/comparison/methods.h"

#include "kernel/core/error.h"
#include "kernel/thesis/comparison/frames.h"
#include "kernel/thesis/comparison/laplacian.h"
#include "kernel/thesis/comparison/propagation.h"
#include "kernel/thesis/comparison/similarity.h"

namespace lissom {

std::unique_ptr<ComparisonMethod> make_comparison(const ComparisonProblem& problem,
                                                  const Context& context) {
    switch (problem.options.method) {
        case DeformMethod::naive:
            return make_naive(problem, context);
        case DeformMethod::rotation_estimate:
            return make_rotation_estimate(problem, context);
        case DeformMethod::similarity:
            return make_similarity(problem, context);
        case DeformMethod::geodesic:
        case DeformMethod::harmonic:
            return make_propagation(problem, context);
        case DeformMethod::frames:
            return make_frames(problem, context);
        case DeformMethod::implicit:
            break;
    }
    throw Error(ErrorCode::internal, "the implicit method is not a comparison method");
}

DeformOptions compared_by(DeformMethod method) {
    DeformOptions options;
    options.method = method;
    options.comparison = make_comparison;
    return options;
}

}  // namespace lissom
