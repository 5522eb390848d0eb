/// A patch over a hole in the shape of a cap that leaves the hole's rim as steeply as the surface
/// comes to it; private to kernel/merge.
#pragma once

#include "kernel/mesh/fill/fill.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/path.h"

namespace lissom {

/// Lifts the vertices of a flat patch to the height of a ball's cap whose slope at the rim is that
/// of the surface around `hole` (its vertices have the same numbers in `mesh`): flat in a flat
/// surface, half a ball on a tube. Thin plates, which are found from the flat patch, bend too
/// little at a steep rim.
void dome(Mesh& mesh, const FillReport& patch, const Path& hole);

}  // namespace lissom
