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
#include "kernel/deform/stats.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/merge/paste/opened_target.h"
#include "kernel/merge/paste/paste.h"
#include "kernel/merge/paste/paste_energy.h"
#include "kernel/merge/paste/paste_regions.h"
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

/// Where the vertices of a part's loop go: their places, and unit normals of the target there.
struct LoopImage {
    std::vector<Vec3> positions, normals;
};

/// Frames by the least rotation from the turned normals of the source, `normals` of the loop, to
/// those of the target, averaged three times along the loop.
std::vector<BoundaryValue> paste_values(std::span<const Vec3> normals, const LoopImage& image,
                                        const PasteSimilarity& similarity, double scale);

struct MovedPart {
    Mesh mesh;
    DeformStats stats;
};
MovedPart moved_part(const PastePart& part, std::span<const BoundaryValue> values,
                     const BoundaryDeformOptions& options, const Context& context);

/// Of the faces within three rings of the loop, or of those of the given faces of the source.
PasteDistortion near_distortion(const PastePart& part, const Mesh& moved, double scale);
PasteDistortion feature_distortion(const PastePart& part, const Mesh& moved, double scale,
                                   std::span<const Index> feature);

/// Which points of the part's loop and of the hole meet: those whose images are nearest, in order.
LoopPair paste_pair(const PastePart& part, const OpenedTarget& target,
                    std::span<const Vec3> images);

}  // namespace lissom
