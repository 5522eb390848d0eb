/// The rim of a source that flares beside a seam; private to kernel/merge.
#pragma once

#include <span>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// The faces of a source in a merged mesh, the vertices of the seam, the distance of every vertex
/// of the mesh from it along edges, and its radius.
struct MadeRim {
    const Mesh& mesh;
    std::span<const Index> faces, loop;
    std::span<const double> distance;
    double radius = 0.0;
};

/// Returns the outward turn of the source beside its seam, beyond that at rest, such as that of a
/// widened boundary: the RMS over points of the seam of the greatest gain, in radians, between
/// neighbouring strips of surface a sixth of a radius wide, or as wide as its faces are long or
/// large, up to one radius away. The direction of a strip is that of its area, so that slivers
/// count for little. Only turns by which the surface stands out count: a fillet is no flare. `rest`
/// is the place of each vertex of the merged mesh on the source before, NaN for a vertex without
/// one; faces with such vertices do not count. `inside_out`: the faces look inward.
double rim_flare(const MadeRim& made, std::span<const Vec3> rest, bool inside_out);

}  // namespace lissom
