/// Nested dissection of a grid; private to kernel/solve.
#pragma once

#include <vector>

#include "kernel/core/index.h"
#include "kernel/solve/grid/grid_size.h"

namespace lissom {

/// An order of elimination for an operator that couples points up to two steps apart, as A0 does:
/// both halves of the grid before the two planes that part them, and so on. permutation[i] is the
/// point that comes i-th.
std::vector<Index> dissect_grid(const GridSize& size);

}  // namespace lissom
