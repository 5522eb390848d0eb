/// Smoothing of a surface.
#pragma once

#include <optional>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Weights of the neighbours in the mean that a vertex moves to. Uniform weights also even out the
/// spacing of vertices; cotangent weights keep it and move along the normal only.
enum class SmoothWeights { uniform, cotangent };

/// Treatment of vertices on open boundaries: they stay, or are smoothed along their loop.
enum class SmoothBoundary { fixed, along };

struct SmoothOptions {
    /// Number of steps, 0 or more.
    Index iterations = 10;
    /// Fraction of the way to the mean that a vertex moves in a step, above 0, at most 1.
    double strength = 0.5;
    SmoothWeights weights = SmoothWeights::uniform;
    SmoothBoundary boundary = SmoothBoundary::fixed;
    /// Follows each step by one outwards, so that the mesh does not shrink (Taubin 1995, pass band
    /// 0.1).
    bool keep_volume = false;
    /// Vertices that may move; all if it is absent.
    std::optional<Region> region = std::nullopt;
};

/// Smooths `mesh` in place by explicit Laplacian steps. Cotangents are those of the shape at the
/// start, of the triangulated polygons, negative ones taken as zero. "normal" attributes turn with
/// the surface; displacements of morph targets are smoothed by the same weights. Vertices without
/// faces stay.
/// Errors: invalid_argument; topology_mismatch; cancelled: the mesh is then unchanged.
void smooth(Mesh& mesh, const SmoothOptions& options = {}, const Context& context = {});

}  // namespace lissom
