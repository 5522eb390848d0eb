/// Fairing of seams: the surface bends smoothly across them and keeps its details.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct SeamFairing {
    /// Vertices within this many edges of a seam may move; at least 1.
    Index rings = 5;
    /// Size of the core, whose shape is made anew: the seam itself and this many rings less one; at
    /// least 1, at most `rings`. Details between the core and the end of the band are kept. Two
    /// rings beside the seam have faces that sewing has changed, and show neither side's shape.
    Index core = 3;
    /// Umbrella steps within the tangent planes of the core, which spread its vertices before the
    /// surface is bent; 0 or more. Vertices that would move by a quarter of their shortest edge or
    /// more stay.
    Index umbrella = 1;
    /// Times that the surface is bent, each from the shape before; at least 1.
    Index passes = 2;
    /// Vertices that stay, ascending.
    std::vector<Index> firm = {};
};

/// Bends `mesh` in place around `seams`, each a closed loop of vertices joined by edges, as Sewn
/// has them. The band takes the shape whose Laplacian coordinates are, in the least squares
/// weighted by area, nearest to those it had; in the core to a mean curvature and normals that
/// continue those around it. Seams whose bands meet are solved together. Vertices on open
/// boundaries stay; so do those farthest from its seams in a component that lies wholly in the
/// band. Every other vertex stays to the bit; "normal" attributes turn with the surface. The
/// way there is gone only as far as it does no harm: no dihedral angle across the seams may
/// become greater than the greatest before, or than 20 degrees, and none near them than the
/// greatest before; the band may not become rougher by more than a tenth (SeamGuard), and no
/// face may run through another that it did not. A surface so folded that it does not say how
/// it bends stays as it is. Returns the vertices of the band, ascending; none if nothing moved
/// for that.
/// Errors: invalid_argument for options out of range, or if two consecutive vertices of a seam
/// share no edge; out_of_range naming the vertices; not_positive_definite; memory_limit;
/// cancelled. The mesh is then unchanged.
std::vector<Index> fair_seam(Mesh& mesh, std::span<const std::vector<Index>> seams,
                             const SeamFairing& options = {}, const Context& context = {});

}  // namespace lissom
