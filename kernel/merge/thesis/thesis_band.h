/// Transition regions as the thesis parameterises them (section 3.3.3): cut open and laid over the
/// unit square; private to kernel/merge.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/blend/band_chart.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// A merging boundary of one mesh, in the direction of the seam.
struct BandLoop {
    SeamSide side = SeamSide::target;
    std::vector<Index> vertices;
    /// Where each vertex lies along the seam, 0 to 1: by arc length of the target's loop.
    std::vector<double> fraction;
    /// Place in `vertices` of the key vertex that the cut begins at.
    Index start = 0;
};

/// The two boundaries of a join; `start` is the place of a key in `pair.source`. The target's cut
/// begins at the vertex nearest to where that key goes.
BandLoop target_band_loop(const Mesh& target, const LoopPair& pair, Index start);
BandLoop source_band_loop(const Mesh& target, const LoopPair& pair, Index start);

/// A transition region over the unit square.
struct ThesisBand {
    /// Its vertices of the mesh with their coordinates: `angle` is that along the seam, counted
    /// from where the seam begins rather than the cut, `distance` that away from it times the
    /// width. Triangles that fill a hole of the region are left out.
    BandChart chart;
    double width = 0.0;
    /// For each vertex of the chart the length of the shortest path along edges to the loop.
    std::vector<double> path;
    /// Vertices of the mesh along the cut, from the loop to the far end.
    std::vector<Index> cut;
};

/// The region of the faces whose vertices all have a path along edges to the loop that is shorter
/// than `width`, as far as it hangs together with the loop. It is cut along the shortest path from
/// the loop's key to the region's other end, the longest of its other outlines; what other outlines
/// enclose counts as filled. The loop goes to the lower side of the square by `fraction`, the other
/// end to the upper one and the cut to both others by arc length, all else follows by harmonic
/// coordinates of weights above 0.
/// Errors: invalid_argument where the region is not a band: where it is narrower than the faces at
/// the loop, covers all there is, or has a handle; memory_limit; cancelled.
ThesisBand make_thesis_band(const Mesh& mesh, const BandLoop& loop, double width,
                            const Context& context);

}  // namespace lissom
