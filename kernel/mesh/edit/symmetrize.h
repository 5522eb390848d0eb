/// A symmetric mesh from one of its halves.
#pragma once

#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct SymmetrizeOptions {
    /// A point of the plane, and its normal, of any length, towards the half that is kept.
    Vec3 point = Vec3::Zero(), normal = Vec3::UnitX();
    /// Vertices of open borders this near to the plane are on it; a hundredth of the mean edge
    /// length if absent.
    std::optional<double> weld = std::nullopt;
};

struct Symmetrized {
    Mesh mesh;
    /// For each vertex, its mirror image: itself on the plane.
    std::vector<Index> mirror;
};

/// Returns the half of a mesh on one side of a plane, with its mirror image, welded along the
/// plane. A mesh that crosses the plane is cut by it (cut.h); one that only reaches it is taken as
/// a half model. The vertices of the half come first. Attributes, labels and regions are those of
/// the half: texture coordinates are the same on both sides, directions and morph targets are
/// mirrored, and on the plane morph targets move along it. Errors: mesh_empty; invalid_argument for
/// a normal without length, a negative tolerance, a mesh with nothing on the kept side, or one that
/// lies on that side farther from the plane than the tolerance;
/// not_finite; boundary_conflict if an inner edge between vertices of the border is on the plane;
/// nonmanifold_vertex if it touches it at a vertex; memory_limit; cancelled.
Symmetrized symmetrize(const Mesh& mesh, const SymmetrizeOptions& options,
                       const Context& context = {});

}  // namespace lissom
