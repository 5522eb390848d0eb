/// The pairs of corners of a topology, for Topology::create_paired; private to the kernel.
#pragma once

#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// For each corner, which stands for the edge from its vertex to the next of its face, the one that
/// runs along that edge the other way, or kNoIndex on a boundary.
std::vector<Index> corner_twins(const Topology& topology);

}  // namespace lissom
