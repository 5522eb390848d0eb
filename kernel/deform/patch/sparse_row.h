/// Sums over vertices; private to kernel/deform.
#pragma once

#include <utility>
#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

/// A row of coefficients of vertices, in any order.
using SparseRow = std::vector<std::pair<Index, double>>;

}  // namespace lissom
