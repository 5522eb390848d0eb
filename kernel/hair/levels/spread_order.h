/// An order of strands whose beginnings are spread over the head.
#pragma once

#include <vector>

#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Returns the numbers of all strands in an order whose first n, for each n, are spread over the
/// roots about as all are: as dense in each place, for so many. Groups and files may hold strands
/// in any order. Strands whose root is not finite come where one at 0 would.
std::vector<Index> spread_order(const Strands& strands);

}  // namespace lissom
