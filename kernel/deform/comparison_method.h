/// Interface of methods that deform in place of the implicit one (sections 2.3 and 2.4.4 of the
/// thesis). All work on the same patch, operators and hard positions. kernel/thesis has six.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/holds/known_mask.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {

/// Input of a comparison method. It outlives the method.
struct ComparisonProblem {
    const Patch& patch;
    /// Real vertices first, as everywhere; virtual ones are not read.
    const KnownMask& known;
    /// Source of the gradient of each local vertex, or kNoIndex if it has none. Sources count from
    /// 0: handles, constrained vertices, and the pinned part.
    const std::vector<Index>& source;
    Index source_count = 0;
    const DeformOptions& options;
};

/// Motion of a source: its deformation gradient, and the rotation in it as a vector along the
/// axis whose length is the angle, which may exceed pi.
struct SourceMotion {
    Mat3 gradient = Mat3::Identity();
    Vec3 rotation = Vec3::Zero();
};

/// One frame. Positions and the base are in the coordinates of the patch.
struct ComparisonFrame {
    std::span<const SourceMotion> sources;
    /// Transform of the pinned part, or else of the first handle. Solving for deviations from it
    /// makes the motions exact that a method reproduces.
    Affine base;
};

/// Memory and time of the factors of a method.
struct ComparisonCosts {
    std::size_t first_nonzeros = 0, second_nonzeros = 0, factor_bytes = 0;
    double first_seconds = 0, second_seconds = 0;
};

/// One comparison method, factored. Several threads may solve at the same time.
class ComparisonMethod {
  public:
    virtual ~ComparisonMethod() = default;

    /// Free positions of one frame. `positions` holds a place for every real local vertex: those
    /// known are given, the others are found. `gradients` receives the M_i of Eq 2.2, by which the
    /// method transforms the details.
    virtual void solve(const ComparisonFrame& frame, std::span<Vec3> positions,
                       std::span<Mat3> gradients, const Context& context) const = 0;
    virtual ComparisonCosts costs() const = 0;
};

}  // namespace lissom
