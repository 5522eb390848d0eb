/// Sewing: a source mesh, whose boundary has been brought onto that of a target, and the target
/// become one watertight mesh (thesis section 3.3.1, last step).
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/merge/piece/places.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// The faces that come from a side, given that of each, ascending.
std::vector<Index> faces_on(std::span<const SeamSide> side_of_face, SeamSide side);

struct SewOptions {
    SeamKind kind = SeamKind::conform;
    /// Times, at most, that the umbrella operator moves the seam and, half as far, the vertices
    /// next to it. A step that would fold the seam is made only as far as it does not, or is the
    /// last: no dihedral angle at the seam grows by it, and no faces are made to run through one
    /// another. 0 leaves every position of the target as it is, to the bit.
    Index smooth = 3;
    /// Neighbours on the seam that are closer than this many mean seam edges become one vertex, 0
    /// to 1: that of the target, if one is. Two of the target stay apart. `band` does not use it.
    double snap = 0.5;
    /// False makes every umbrella step whole, whatever it folds (the thesis).
    bool guard = true;
    /// Flips edges within two rings of the seam that make slivers.
    bool flip = true;
    /// Remeshes the collar: the faces beside a seam on a side whose edges there are more than 1.5
    /// times as long as the seam's, which holds the vertices of both loops, or that has triangles
    /// with angles below 2 degrees there. Their edges grow from
    /// the seam's length to the side's by half the distance from it; sharp edges and borders of
    /// charts and labels keep their shape, and attributes of vertices and corners are interpolated.
    /// Elements beyond the collar stay as they are; the vertices and faces made come after the
    /// others of their side.
    bool collar = false;
    /// By join, or empty for none: true keeps every vertex of both sides in place at that seam.
    /// None is snapped, collapsed or smoothed, no edge is flipped, and there is no collar; a `band`
    /// is conforming there.
    std::vector<char> kept = {};
    /// Vertices that smoothing leaves in place, ascending: of the target, and after all of them
    /// those of the source.
    std::vector<Index> firm = {};
};

/// One mesh made of two.
struct Sewn {
    Mesh mesh;
    /// Origin of its elements. Elements of the target keep their numbers, those of the source are
    /// numbered after them, as `append` does.
    MeshMap map;
    std::vector<SeamSide> side_of_face;
    /// The vertices of each seam, in the order of the target's loop; consecutive ones share an
    /// edge.
    std::vector<std::vector<Index>> seams;
    SewReport report;
    /// Vertices from this one on are the source's, or were made on its side.
    Index first_source_vertex = 0;
    /// By seam, or empty for none: whether SewOptions::kept keeps it.
    std::vector<char> kept = {};
    /// Among the elements that `map` leads to.
    Places place = {};
};

/// Sews `source` to `target` along all `joins`. Both may be polygon meshes of any genus; boundaries
/// that no join names stay open. Vertices of the source's loops are put at their places on the
/// target's, to which the caller has brought them.
///
/// The result has the surviving vertices of the target in their order, then those of the source,
/// and the same of faces; faces that get seam vertices become triangles in their place. Away from
/// the seam (two rings if edges flip or the seam is smoothed) everything is kept to the bit:
/// - attributes of vertices on the seam are blended half and half from both sides, or are those of
///   the side that has any. Those of corners are interpolated in their own face, so that each side
///   keeps its values along the seam, but for displacements by morph targets, which are blended as
///   those of vertices so that no target tears the seam. Texture coordinates and tangents of
///   vertices become those of corners before;
/// - a side without colors is white, without texture coordinates has 0, 0; other attributes
///   of one side alone are NaN on the other, as `append` does;
/// - a seam vertex is in the regions that it lies in on either side;
/// - normals are those of the surface on the seam, and turn with the vertices that were smoothed;
/// - "joints" and "weights" are blended by joint if both sides have the same joints: the names
///   that the assets tell at the loops must agree, or the meshes must have the same asset or none.
///   If one side alone has a skin, the other gets the weights of the seam, continued by a
///   harmonic function, and in an asset the object of that skin. Offsets of "morph" attributes are
///   blended as they are: the caller has turned the source's with the source.
///
/// Errors: invalid_argument for options out of range, for no joins, or if a join's counts differ;
/// out_of_range; not_a_boundary; boundary_conflict (two joins on one boundary, places that do not
/// follow each other around a loop); nonmanifold_edge if both sides join two seam vertices by an
/// inner edge that cannot be flipped; skin_mismatch; cancelled; internal instead of a result that
/// is not sound.
Sewn sew(const Mesh& target, const Mesh& source, std::span<const LoopPair> joins,
         const SewOptions& options = {}, const Context& context = {});

/// Returns the vertices of `sewn` that vertices of the sides became, ascending: at least half of
/// each comes from those of `firm`, which are ascending and numbered as in SewOptions.
std::vector<Index> became_of(const Sewn& sewn, std::span<const Index> firm);

/// The seams that are not kept as they were sewn.
std::vector<std::vector<Index>> worked_seams(const Sewn& sewn);

/// Throws internal if a sewn mesh is not the union of two sound meshes along `joins`: a vertex has
/// lost all of its faces, or it has another Euler characteristic, or more or fewer components or
/// open boundaries.
void require_sound(const Sewn& sewn, const Mesh& target, const Mesh& source,
                   std::span<const LoopPair> joins);

}  // namespace lissom
