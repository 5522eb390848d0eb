/// Transition regions as the thesis parameterises them (section 3.3.3): cut open and laid over the
/// unit square; private to kernel/thesis.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/blend/band_chart.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// A merging boundary of one mesh, in the direction of the seam.
struct BandLoop {
    SeamSide side = SeamSide::target;
    std::vector<Index> vertices;
    /// Parameter of each vertex along the seam, 0 to 1: by arc length of the target's loop.
    std::vector<double> fraction;
    /// Place in `vertices` of the key vertex that the cut begins at.
    Index start = 0;
};

/// Returns the boundary of a target by its own arc length, that of the source by its images on the
/// target's; `start` is the place of a key in `loop` and in `pair.source`.
BandLoop target_band_loop(const Mesh& target, std::vector<Index> loop, Index start);
BandLoop source_band_loop(const Mesh& target, const LoopPair& pair, Index start);

/// The faces of a transition region, and its far end in the direction of the surface that lies
/// beyond: the longest of its outlines beside the loop.
struct ThesisRegion {
    std::vector<Index> faces, end;
};
/// Errors: as make_thesis_band.
ThesisRegion make_thesis_region(const Mesh& mesh, SeamSide side, std::span<const Index> loop,
                                double width, const Context& context);

/// Returns the vertex at the far end of the cut that begins at a vertex of the loop.
/// Errors: as make_thesis_band.
Index cut_end(const Mesh& mesh, const BandLoop& loop, double width, const Context& context);

/// A transition region over the unit square.
struct ThesisBand {
    /// Its vertices of the mesh with their coordinates: `angle` is that along the seam, counted
    /// from the start of the seam rather than the cut, `distance` that away from it times the
    /// width. Triangles that fill a hole of the region are left out.
    BandChart chart;
    double width = 0.0;
    /// Vertices of the mesh along the cut, from the loop to the far end.
    std::vector<Index> cut;
};

/// The region of the faces whose vertices all have a path along edges to the loop that is shorter
/// than `width`, as far as it hangs together with the loop. It is cut along the shortest path from
/// the loop's key to the region's other end, the longest of its other outlines; areas that other
/// outlines enclose count as filled. The loop goes to the lower side of the square by `fraction`,
/// the other end to the upper one and the cut to both others by arc length, all else follows by
/// harmonic coordinates of weights above 0.
/// Errors: invalid_argument if the region is not a band: if it is narrower than the faces at the
/// loop, covers the whole mesh, or has a handle; memory_limit; cancelled.
ThesisBand make_thesis_band(const Mesh& mesh, const BandLoop& loop, double width,
                            const Context& context);

}  // namespace lissom
