/// Sharp edges of a target, and the bites that parts take out of them; private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/merge.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// An edge at which a surface turns by more than kSharpEdge, and by 2.5 times as much as at the
/// edges around it that turn by less than that.
struct SharpEdge {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    /// Length of all of the sharp edges that hang together with it.
    double line = 0.0;
    /// Its vertices.
    Index first = kNoIndex, second = kNoIndex;
};

/// The least angle of a sharp edge, in radians: a twelfth of a turn and a bit, so that round bodies
/// of twelve faces have none.
inline constexpr double kSharpEdge = 35.0 * kDegree;

/// The sharp edges of a mesh; open ones are none. Errors: cancelled.
std::vector<SharpEdge> sharp_edges(const Mesh& mesh, const Context& context);

/// Returns the point of an edge nearest to a point.
Vec3 nearest_point_of(const SharpEdge& edge, const Vec3& point);

/// The mesh that a part was sewn into.
struct BittenMesh {
    const Mesh& mesh;
    /// The side that each of its faces comes from.
    std::span<const SeamSide> side_of_face;
    /// The part is a dent, in which edges of the target end.
    bool dent = false;
};

/// Measures the loss of sharp edges near a seam: parts of them that stand out of the result, or lie
/// below the surface still left of the target. Lines of sharp edges shorter than half the seam's
/// radius do not count. `seam` has the points of the seam. Errors: cancelled.
TargetBite target_bite(std::span<const SharpEdge> edges, std::span<const Vec3> seam,
                       const BittenMesh& result, const Context& context);

/// Returns the volume of a part over the cone from the middle of its boundary to that: negative for
/// a dent. `loop` is counter-clockwise around the part.
double volume_over(const Mesh& part, std::span<const Index> loop);

}  // namespace lissom
