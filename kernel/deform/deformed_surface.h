/// The surface that a Deformer shows, beyond its positions.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/options.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

const DeformOptions& options_of(const Deformer& deformer);
/// Returns the context that the deformer was made with.
const Context& context_of(const Deformer& deformer);
/// Returns the rest positions of the region's vertices, in its order.
const std::vector<Vec3>& rest_positions_of(const Deformer& deformer);
/// Returns the unit normals at the region's vertices, in the order of `positions()`, for renderers.
/// Faces count by their angle, as in `vertex_normals`. Takes a small part of a frame. Errors:
/// cancelled; memory_limit.
const std::vector<Vec3>& normals_of(Deformer& deformer, const Context& context = own_context());
/// Returns the deformation gradients M_i of the region's vertices in the last solve, before shear
/// is taken out; the identity before one. For a comparison method, the M_i by which it transforms
/// the details (Eq 2.2).
const std::vector<Mat3>& gradients_of(Deformer& deformer);

/// Throws topology_mismatch if `mesh` has another topology, or has changed around the region since
/// the deformer was made: the result would tear there.
void require_surroundings(const Deformer& deformer, const Mesh& mesh);
/// Writes the rest shape into the region's vertices of `mesh`, with the custom normals it had.
/// Errors: as Deformer::apply_to.
void apply_rest(const Deformer& deformer, Mesh& mesh);
/// Returns `mesh` as apply_to leaves it, with the vertices that a refinement of coarse borders
/// inserted: behind its own, at their places in the last result. Their faces become triangles;
/// attributes are interpolated. A mesh without such vertices is only copied. Errors: as apply_to;
/// as prepare.
Mesh subdivided_mesh(Deformer& deformer, const Mesh& mesh, const Context& context = own_context());

}  // namespace lissom
