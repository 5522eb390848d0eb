/// Attributes that turn with a mesh's surface; private to kernel/merge.
#pragma once

#include "kernel/deform/boundary/boundary_deformer.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Normals and tangents turn with the surface; displacements of morph targets grow with it as well.
/// `moved` is `rest` with the positions of `deformed`, which is of `region`.
void turn_directions(const Mesh& rest, const Region& region, const BoundaryDeformation& deformed,
                     Mesh& moved);

}  // namespace lissom
