/// Values for a patch that closed a hole; private to kernel/merge.
#pragma once

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Continues the values of a mesh over the patch that `fill` has added, the faces from `first_face`
/// and the vertices from `first_vertex` on:
/// - labels and attributes of faces are those of the nearest faces around, by steps over edges;
/// - attributes of vertices, but for joints and weights, and of corners are harmonic, from their
/// values at the rim. If corners at one rim vertex differ, as at the seams of texture
///   coordinates, only the longest stretch of the rim between such vertices counts;
/// - normals are those of the surface, of unit length.
/// Errors: not_positive_definite; memory_limit; cancelled: the mesh may then hold some of them.
void continue_values(Mesh& mesh, Index first_vertex, Index first_face, const Context& context);

}  // namespace lissom
