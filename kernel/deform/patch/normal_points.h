/// Points beside flat vertices; private to kernel/deform.
///
/// The positions of a flat ring do not determine gradients across its plane. A point p = v + d, d
/// along the normal of vertex v, completes them: M_v takes the offset at rest to x_p - x_v. It has
/// an unknown of its own, neighbours v only, and no Laplacian row, so that the coherence of
/// gradients alone determines it: a plane that is moved within itself stays one.
#pragma once

#include "kernel/deform/patch/working_patch.h"

namespace lissom {

/// Adds a point beside each vertex of the region whose ring is flatter than the condition number
/// `threshold` allows, but lies not on a line, to the patch and its operators. It lies
/// `displacement` sqrt(valence) mean edge lengths away.
void add_normal_points(WorkingPatch& work, double threshold, double displacement);

}  // namespace lissom
