/// Cutting strands shorter.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Cuts off the side that `normal` points to.
struct StrandTrimPlane {
    Vec3 point = Vec3::Zero();
    /// Any length but zero.
    Vec3 normal = -Vec3::UnitY();
};

/// A strand is cut at the first of these limits.
struct StrandTrimOptions {
    /// Longest length that is left, in metres; infinite for no limit.
    double length = std::numeric_limits<double>::infinity();
    /// Part of its length that each strand keeps, 0 to 1.
    double factor = 1.0;
    /// Each strand is randomly shortened by up to this fraction of its kept length; 0 to 1. Applies
    /// to `length` and `factor`.
    double variation = 0.0;
    std::optional<StrandTrimPlane> plane;
    /// Each strand meets the plane moved by at most this along its normal, either way, at random,
    /// in metres.
    double jitter = 0.0;
    /// No strand becomes shorter than this, in metres, unless it was; positive.
    double least = 0.001;
    std::uint64_t seed = 1;
};

/// Cuts strands off at the tip; a new last point lies on the old strand. Roots stay, strands with
/// nothing to cut stay to the bit, and the result of a strand depends on it, its id and the seed
/// alone. Errors: invalid_argument for options out of range; memory_limit, cancelled.
void trim(Strands& strands, const StrandTrimOptions& options, const Context& context = {});

}  // namespace lissom
