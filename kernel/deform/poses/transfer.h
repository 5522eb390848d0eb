/// Deformation transfer: another mesh takes the pose of a mesh (Sumner and Popovic, "Deformation
/// transfer for triangle meshes", 2004).
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Parts of two meshes that correspond, such as their heads.
struct TransferPair {
    Region from, to;
};

/// Returns `to` deformed as `from` was into `from_posed`: each triangle takes the deformation
/// gradient of the corresponding part, and the surface is fitted to these. Both rest shapes stand
/// alike; their sizes and places may differ. Without pairs the faces of both meshes correspond one
/// to one. With pairs, points correspond by harmonic functions of each mesh, 1 on a part of a pair
/// and 0 on the others, and by their normals and places; some pairs at the ends of limbs and at the
/// trunk serve best. A part that the pose does not move stays to the bit. Custom normals, tangents
/// and morph targets turn along. Errors: mesh_empty without faces; topology_mismatch if
/// `from_posed` or, without pairs, `to` has other faces than `from`, or a region is of another
/// mesh; region_empty; invalid_argument for parts that overlap; unconstrained, naming a vertex, for
/// a component without a part of a pair; memory_limit; cancelled.
Mesh transferred(const Mesh& from, const Mesh& from_posed, const Mesh& to,
                 const std::vector<TransferPair>& pairs = {}, const Context& context = {});

}  // namespace lissom
