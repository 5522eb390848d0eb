/// Affine maps and orientation of whole meshes.
#pragma once

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Moves all vertices by `map`, in place. "normal" attributes turn by the inverse transpose and
/// stay unit. A mirroring map (negative determinant) also reverses the faces, so that they still
/// face outward; the mesh then has a new topology, to which its named regions move. Errors:
/// singular_transform if the determinant is zero or the map is not finite; not_finite if a result
/// would overflow.
void transform(Mesh& mesh, const Affine& map, const Context& context = {});

/// Reverses the orientation of all faces, each from its first vertex, in place. "normal" attributes
/// change sign. The topology is a new one; ids stay, and named regions move to it.
void flip(Mesh& mesh, const Context& context = {});

}  // namespace lissom
