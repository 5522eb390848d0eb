/// Lengths of edges that a surface asks for. Private to kernel/mesh.
#pragma once

#include <vector>

#include "kernel/mesh/mesh.h"

namespace lissom {

struct EdgeLengths {
    double longest = 0.0, shortest = 0.0;
    /// Greatest distance of an edge from the surface; 0: all edges are as long as the longest.
    double error = 0.0;
};

/// Returns for each vertex of a triangle mesh the length of edges there. An edge of length l on a
/// surface of curvature k is k l^2 / 8 away from it; the curvature is that of the normals along the
/// edges at the vertex. Neighbouring lengths differ by no more than half of their distance.
std::vector<double> edge_lengths(const Mesh& mesh, const EdgeLengths& wanted);

}  // namespace lissom
