/// Weights of each gradient source at each vertex, for methods that propagate the gradients of
/// handles; private to kernel/thesis.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/deform/comparison_method.h"
#include "kernel/deform/patch/patch.h"

namespace lissom {

/// Weights of the sources at every real vertex: none negative, sum 1, and 1 for its own source at a
/// vertex whose gradient is prescribed.
struct SourceWeights {
    Index sources = 0;
    /// `sources` numbers a vertex.
    std::vector<double> value;

    std::span<const double> at(Index v) const {
        return {value.data() + lissom::at(v) * lissom::at(sources), lissom::at(sources)};
    }
};

/// Distance over the patch from the vertices with source[v] == `from`, by fast marching over the
/// triangles (Kimmel and Sethian, "Computing geodesic paths on manifolds", 1998); infinity out of
/// reach. First-order accurate, exact for flat fronts on flat patches.
std::vector<double> patch_distances(const Patch& patch, const Rings& rings,
                                    std::span<const Index> source, Index from);

/// Returns weights in inverse proportion to the geodesic distance from each source: linear in the
/// distances for two sources (Yu et al. 2004).
/// Errors: unconstrained if a vertex that may move reaches no source.
SourceWeights geodesic_weights(const ComparisonProblem& problem, const Rings& rings,
                               const Context& context);

/// One harmonic field a source: 1 there, 0 at the others, and no Laplacian between them (Zayer et
/// al. 2005). Edges weigh as much as their cotangent, from zero upwards, or all alike.
/// Errors: as geodesic_weights; not_positive_definite; memory_limit; cancelled.
SourceWeights harmonic_weights(const ComparisonProblem& problem, const Rings& rings,
                               const Context& context, ComparisonCosts& costs);

/// Weights of edges: cotangents from a small positive number upwards, or 1. One an entry of
/// `rings`.
std::vector<double> positive_edge_weights(const ComparisonProblem& problem, const Rings& rings);

}  // namespace lissom
