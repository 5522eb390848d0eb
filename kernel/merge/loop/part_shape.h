/// Orientation from the shape of a part: its plane of symmetry, its centre of mass and the lean of
/// its neck; private to kernel/merge.
#pragma once

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// The part of a mesh behind one of its boundaries.
struct PartShape {
    /// Unit normal of the part's plane of symmetry; zero if there is none or more than
    /// one.
    Vec3 mirror = Vec3::Zero();
    /// RMS distance of mirrored points from the surface, in sizes of the part: of the best plane,
    /// and of the best of those that lie at another angle.
    double asymmetry = 0.0, next_asymmetry = 0.0;
    /// Offsets from the boundary's axis, in radii of the boundary: of the centroid of the part, and
    /// of that of its surface within two radii of the boundary.
    Vec3 mass = Vec3::Zero(), neck = Vec3::Zero();
    /// Whether turning the part about the boundary's axis leaves it as it is.
    bool round = false;
};

/// The shape of the component of `mesh` that `loop` bounds. The plane is sought among those through
/// the part's centroid, starting from ones along the boundary's axis and from the part's principal
/// axes; each is then fitted to pairs of points that it mirrors.
/// Errors: memory_limit; cancelled.
PartShape part_shape(const Mesh& mesh, const Loop& loop, const Context& context);

}  // namespace lissom
