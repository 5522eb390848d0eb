/// Lines of a surface that a change of its triangles keeps: borders, seams of attributes, outlines
/// of labels and of named regions, creases. Private to kernel/mesh.
#pragma once

#include <vector>

#include "kernel/mesh/mesh.h"

namespace lissom {

/// Returns for each corner whether the edge from its vertex to the next one of its face is on a
/// line: an open border; an edge on whose two sides corner attributes differ ("normal" and
/// "tangent" by more than 30 degrees), or labels, or one face of which is in a named region and the
/// other not; an edge between faces whose normals differ by more than `crease` radians.
std::vector<char> feature_lines(const Mesh& mesh, double crease);

}  // namespace lissom
