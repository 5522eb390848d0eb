/// Contacts: faces of a deformed surface that run through one another.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/deform/deformer.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {

/// Returns the pairs of faces of `mesh` that intersect with the region as the last solve left it,
/// and do not with the region at rest: those of DeformReport::crossings, ascending. The first call
/// builds a hierarchy of boxes over all faces, which later ones fit to the shape; they take about
/// as long as a frame, less if handles hold large parts. Accepts the mesh that the deformer was
/// made for, or a copy; its shape within the region does not matter. Errors: as
/// require_surroundings; not_finite for a surface that reaches beyond 1e30; memory_limit;
/// cancelled.
std::vector<FacePair> contacts_of(Deformer& deformer, const Mesh& mesh,
                                  const Context& context = own_context());

}  // namespace lissom
