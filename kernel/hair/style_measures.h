/// Measures of strands at partings and ties: whether hair follows the curves of its style.
#pragma once

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/hair/curve/dividing_curve.h"
#include "kernel/hair/curve/ponytail.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Lengths are in the unit of the strands.
struct CrossingOptions {
    /// Strands are counted whose root is at most this far from the line along the skin, and those
    /// among them that cross it within `reach` of their length from the root.
    double near = 0.02, reach = 0.03;
};

struct StrandFraction {
    /// Strands that were looked at, and those among them that were found.
    Index strands = 0, found = 0;

    /// 0 if there were none.
    double fraction() const { return strands > 0 ? static_cast<double>(found) / strands : 0.0; }
};

/// Strands rooted near a dividing curve that cross the surface of its normals. The same for any
/// number of threads. Errors: invalid_argument for options that are negative; cancelled.
StrandFraction parting_crossings(const Strands& strands, const DividingLine& line,
                                 const CrossingOptions& options = {}, const Context& context = {});

/// Strands that pass through the circle of a ponytail's cross section in its direction, of all
/// strands, those without hair included. Errors: cancelled.
StrandFraction section_passages(const Strands& strands, const PonytailSection& section,
                                const Context& context = {});

}  // namespace lissom
