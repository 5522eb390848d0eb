/// Rotations of triangles that go on smoothly from each to the next, beyond half a turn; private to
/// kernel/deform.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/poses/pose_triangles.h"

namespace lissom {

/// A rotation that can be taken in parts: first `local`, then about `turn`, both rotation vectors.
/// `turn` counts full turns. Near a full turn its axis is in doubt, and `local` has the rotation
/// across it.
struct SurfaceTurn {
    Vec3 turn = Vec3::Zero(), local = Vec3::Zero();

    Mat3 rotation() const;
};

/// Returns the rotations of the triangles from `rest` to `posed`. A triangle has the rotation
/// vector nearest to that of a neighbour, along a tree of the pairs that differ least. The tree of
/// a component starts at the triangle that turns least from `before`: the turns of the shape before
/// on a path, or none. Flat triangles turn as their neighbours do, links as their hosts. Errors:
/// cancelled.
std::vector<SurfaceTurn> surface_turns(const PoseTriangles& triangles, std::span<const Vec3> rest,
                                       std::span<const Vec3> posed,
                                       std::span<const SurfaceTurn> before, const Context& context);

}  // namespace lissom
