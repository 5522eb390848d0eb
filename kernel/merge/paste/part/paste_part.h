/// The part of the source inside a loop, and its deformation onto the target; private to
/// kernel/merge.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/boundary/boundary_deformer.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/merge/paste/part/opened_target.h"
#include "kernel/merge/paste/paste_options.h"
#include "kernel/merge/paste/placement/paste_map.h"
#include "kernel/merge/paste/region/paste_regions.h"
#include "kernel/merge/paste/search/free_loop.h"
#include "kernel/merge/paste/search/paste_energy.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct PastePart {
    Mesh mesh;
    MeshMap map;
    /// Vertices of its boundary, counter-clockwise around the feature, in the order of the loop.
    std::vector<Index> loop;
};

/// The faces inside a loop of the ring. Errors: cancelled.
PastePart part_inside(const Mesh& source, const PasteRegions& regions, std::span<const Index> loop,
                      const Context& context);
/// Returns the same of a closed line, in the plane of the chart, that divides faces: vertices
/// nearer to it than a quarter of an edge slide onto it, so that there are no slivers.
/// Errors: boundary_conflict if the line does not part the ring in two; cancelled.
PastePart part_inside(const Mesh& source, const PasteRegions& regions, const PasteChart& chart,
                      std::span<const Vec2> line, const Context& context);

/// Returns the part inside the line along which `height`, one value a vertex, passes 0: without the
/// surface around its foot. Errors: boundary_conflict if that is not one closed line; cancelled.
PastePart part_above(const PastePart& part, std::vector<double> height, const Context& context);

/// Returns the points of a part's loop with images. Errors: boundary_conflict if one has none.
std::vector<RingPoint> rim_of(const PastePart& part, const RingSurface& surface);

/// Frames by the least rotation from the turned normals of the source to those of the target,
/// averaged three times along the loop. All of these rotations are made smaller by one factor, so
/// that `crease` is left of the larger ones; a refinement may turn each to within that of the whole
/// rotation.
std::vector<BoundaryValue> paste_values(std::span<const RingPoint> rim,
                                        const PasteSimilarity& similarity, double scale,
                                        double crease);

/// Returns the distortion of faces within three rings of the loop, or of given faces of the source.
PasteDistortion near_distortion(const PastePart& part, const Mesh& moved, double scale);
PasteDistortion feature_distortion(const PastePart& part, const Mesh& moved, double scale,
                                   std::span<const Index> feature);

/// Returns pairs of points of the part's loop and of the hole: nearest images, in order.
LoopPair paste_pair(const PastePart& part, const OpenedTarget& target,
                    std::span<const RingPoint> rim);

}  // namespace lissom
