/// Edges by the vertices and faces that they join.
#pragma once

#include <utility>

#include "kernel/core/index.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Returns the edge between two vertices, in either direction; kNoIndex if there is none. The time
/// grows as the valence of `a`.
Index find_edge(const Topology& topology, Index a, Index b);

/// Returns the face on the left of the edge directed from one vertex to the other, or kNoIndex. The
/// time grows as the lesser valence of the two, not as the corners of the face.
Index face_left_of(const Topology& topology, Index from, Index to);

/// Returns the faces on both sides of edge `e`: first the one that it is directed along, then the
/// other or kNoIndex on a boundary.
std::pair<Index, Index> faces_at_edge(const Topology& topology, Index e);

}  // namespace lissom
