/// Packing: charts beside one another in a square; private to kernel/mesh.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/mesh/unwrap/flat_chart.h"

namespace lissom {

/// Turns and moves the charts so that they lie in a square from the origin, `gap` times its side
/// apart, and returns the side. Charts lie along the sides of their smallest rectangle, and are set
/// on top of those before, the longest first (Levy et al. 2002, section 4). Scales stay.
double pack_charts(std::vector<FlatChart>& charts, double gap, const Context& context);

}  // namespace lissom
