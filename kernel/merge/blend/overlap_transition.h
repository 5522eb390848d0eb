/// Interface of transitions by regions that overlap: a region of the source comes to lie on one of
/// the target, whose faces go. kernel/thesis has that of the thesis (section 3.3.3), and the
/// formulas that belong to it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/deform/boundary/boundary_deformer.h"
#include "kernel/merge/blend/transition.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

struct Sewn;

/// All targets as one mesh, before they were opened.
struct OverlapTarget {
    Mesh mesh;
    /// By join: the boundary as it was, and the far end of the region beside it, both in the
    /// direction of the surface, and the region's width.
    std::vector<std::vector<Index>> loops, ends;
    double width = 0.0;
    /// For each vertex of the opened target the one it was.
    std::vector<Index> vertex_of;
};

/// The rest of a target without its regions. The far end of each is an open boundary.
struct OpenedForOverlap {
    Mesh mesh;
    MeshMap map;
    /// By join.
    std::vector<std::vector<Index>> loops;
    OverlapTarget whole;
};

/// One join of a merge with such a transition.
struct OverlapJoin {
    /// Loops of the source's boundary and of the far end of the target's region.
    LoopPair pair;
    /// Places of a key in `pair.source` and in the target's boundary, at which the cuts begin.
    Index start = 0, target_start = 0;
    /// Growth of the source at this join; 1 if it stays as it was put.
    double scale = 1.0;
    /// Width of the source's region along edges, in its own unit.
    double source_width = 0.0;
};

/// The transition of one merge: first `deform`, then sewing, then `reconstruct`.
class OverlapMerge {
  public:
    virtual ~OverlapMerge() = default;

    /// Deforms `region` of the source; `held` of it keeps the result of `ordinary`, the merge
    /// without transition. Errors: not_positive_definite; memory_limit; cancelled.
    virtual BoundaryDeformation deform(const Region& region, const Region& held,
                                       const BoundaryDeformation& ordinary,
                                       const Context& context) = 0;

    /// Moves the vertices of the source's regions in the sewn mesh; all others stay to the bit.
    /// Errors: as deform. The mesh is then unchanged.
    virtual TransitionReport reconstruct(Sewn& sewn, const Context& context) const = 0;
};

/// Makes such transitions. It has no state, so that merges of several threads may share it.
class OverlapTransition {
  public:
    virtual ~OverlapTransition() = default;

    /// Takes the regions of `width` beside `loops` out of a target.
    /// Errors: invalid_argument if a region is no band; cancelled.
    virtual OpenedForOverlap open(const Mesh& target, std::span<const std::vector<Index>> loops,
                                  double width, const Context& context) const = 0;

    /// Returns the vertex of the region's far end that vertex `start` of the boundary `loop` is cut
    /// to. Errors: as open.
    virtual Index cut_from(const OverlapTarget& whole, const std::vector<Index>& loop,
                           Index start) const = 0;

    /// Begins a merge; `weight` is w_T of the thesis. The meshes must outlive the result.
    /// Errors: as open; memory_limit.
    virtual std::shared_ptr<OverlapMerge> begin(const OverlapTarget& whole, const Mesh& opened,
                                                const Mesh& source, std::vector<OverlapJoin> joins,
                                                double weight, const Context& context) const = 0;
};

/// The formulas of merging that the thesis has: MergeOptions::thesis, PasteOptions::thesis.
struct ThesisFormulas {
    /// Deformation by boundaries.
    BoundaryDeformOptions deform;
    /// Makes the transitions of given widths.
    const OverlapTransition& overlap;
};

}  // namespace lissom
