/// The collar of a seam: new faces on a side that is sparser than the seam; private to
/// kernel/merge.
#pragma once

#include "kernel/core/context.h"
#include "kernel/merge/sew/sew.h"

namespace lissom {

/// Remeshes each side of each seam whose edges are more than 1.5 times as long as the seam's, or
/// which has triangles with angles below 2 degrees at the seam, as far as edges must grow from the
/// one length to the other by half their distance from the seam.
/// Seam, the end of the collar and open boundaries stay; features (edges above 20 degrees, borders
/// of charts and labels) keep their shape. A collar is not kept if it makes the seam worse or faces
/// run through one another. Then, if it has angles below 15 degrees at the seam, it is made again
/// with all edges above 1 degree as features, and the one with fewer slivers is kept. New vertices
/// and faces come after the others of their side; attributes of the collar's vertices and corners
/// are interpolated. Counts are added to the report.
void make_collars(Sewn& sewn, const Context& context);

/// Flips edges of triangles with a vertex on the seams or next to them if that makes the smallest
/// angle greater, as ClosedPatch does. The flips are undone if they make the seam worse or faces
/// run through one another.
void flip_near_seams(Sewn& sewn, const Context& context);

}  // namespace lissom
