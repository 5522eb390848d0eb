/// Removal of features: bumps and dents of a surface go, and the surface around them closes over
/// the place (the fill of thesis section 3.4.1).
#pragma once

#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/fill/fairing.h"
#include "kernel/mesh/fill/fill.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/path.h"
#include "kernel/mesh/region.h"

namespace lissom {

struct EraseOptions {
    /// Distance from the region, along edges, within which the surface may be cut, in radii of
    /// its outline (its length over 2 pi); 0 cuts along the outline. Less is used if the surface
    /// around is no ring that far.
    double ring = 0.5;
    /// Weight of curvature in the cost of the cut: an edge costs |e| (1 + bend R k), with the
    /// outline's radius R and k = |k1| + |k2| of the surface around its ends. 0 or more; 0 cuts
    /// along the shortest loop.
    double bend = 1.0;
    /// Order of continuity of the patch with the surface around it. Curvature is continued only if
    /// it is even around the cut (its standard deviation over three rings is at most .05 of its
    /// mean) and the patch does not turn more from face to face; elsewhere tangents, as an
    /// uncertain curvature would be carried on.
    FairContinuity continuity = FairContinuity::curvature;
    /// Vertices that the patch may have at most.
    Index maximum_vertices = 200000;
};

struct EraseReport {
    /// Vertices of the cut, its cost, and the width of the ring that was searched, in the mesh's
    /// unit.
    Index loop_size = 0;
    double loop_cost = 0.0, ring = 0.0;
    Index removed_vertices = 0, removed_faces = 0;
    /// Order of continuity of the patch, and the greatest angle between neighbouring faces when
    /// one is in the patch, in radians.
    FairContinuity continuity = FairContinuity::curvature;
    double max_dihedral = 0.0;
    /// The same of the faces around the patch, within three rings of it.
    double max_around = 0.0;
    /// Density of the patch, over that of the surface around it: more than 1 if it would have been
    /// too coarse to bend as it must.
    double density = 1.0;
    /// Whether the patch turns no more than 30 degrees from face to face, or than the surface
    /// around it; and a sentence with the reason.
    bool ok = false;
    std::string verdict;
    /// The patch; its ids are those of the result.
    FillReport patch;
};

struct ErasedFeature {
    Mesh mesh;
    /// Origin of its elements; those of the patch have none.
    MeshMap map;
    /// The cut, on the mesh as given and counter-clockwise around the region.
    Path loop;
    EraseReport report;
};

/// Removes the feature that `region` marks: cuts along the least-cost loop around it, which runs
/// over even surface, and closes the hole by a patch as dense as its surroundings, or up to four
/// times as dense if that lets it bend more evenly from a steep rim. Nothing goes beyond the region
/// and the ring around it, nor across a crease at which the surface around it falls away by more
/// than 60 degrees. The region may have any genus, several parts and open boundaries; the place is
/// a disk afterwards. Everything outside the loop keeps its order and its values to the bit. On the
/// patch, labels and attributes of faces are those of the nearest faces around; values of vertices
/// and corners are continued harmonically from its rim, from one side of any seam of corner values;
/// normals are those of the patch. Joints and weights are blended as in `fill`.
/// Errors: topology_mismatch; region_empty if the region holds no face, or nothing lies around it;
/// not_a_disk, naming vertices, if the surface around it is no ring, or naming faces that it runs
/// around and does not hold; boundary_conflict if an open boundary is so near that no loop around
/// the region stays off it; invalid_argument for options out of range; not_positive_definite;
/// memory_limit; cancelled.
ErasedFeature erase_feature(const Mesh& mesh, const Region& region,
                            const EraseOptions& options = {}, const Context& context = {});

}  // namespace lissom
