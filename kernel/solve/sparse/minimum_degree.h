/// Approximate minimum degree: an order of elimination with little fill; private to kernel/solve.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/solve/sparse/adjacency.h"

namespace lissom {

/// Returns the order of elimination that takes an unknown of least approximate degree at each step
/// (Amestoy, Davis and Duff, An approximate minimum degree ordering algorithm, 1996): quotient
/// graph, mass elimination, supervariables found by hashing, elements absorbed if another covers
/// them. Unknowns with more than 10 sqrt(n) neighbors come last. order[k] is the unknown eliminated
/// k-th. The same graph gives the same order everywhere. Errors: cancelled.
std::vector<Index> minimum_degree_order(const Adjacency& graph, const Context& context = {});

/// Bytes that it takes while it runs, the graph not counted, for a graph of this size.
std::size_t minimum_degree_bytes(std::size_t unknowns, std::size_t entries);

/// Entries of the lists that it works on; more than an Index counts are too many.
std::size_t minimum_degree_room(std::size_t unknowns, std::size_t entries);

}  // namespace lissom
