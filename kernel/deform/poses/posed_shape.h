/// One shape of a pose, as values that blend linearly; private to kernel/deform.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/poses/pose_triangles.h"
#include "kernel/deform/poses/turn_field.h"

namespace lissom {

/// A shape beside the rest. By triangle: its turn, and the change of its edges before that turn.
struct PosedShape {
    std::vector<Vec3> positions;
    std::vector<SurfaceTurn> turns;
    std::vector<TriangleEdges> stretches;

    std::size_t memory_bytes() const;
};

/// Splits the motion from `rest` into turns and stretches. `before` is as in surface_turns.
PosedShape posed_shape(const PoseTriangles& triangles, std::span<const Vec3> rest,
                       std::vector<Vec3> positions, std::span<const SurfaceTurn> before,
                       const Context& context);

/// A shape times a factor, as part of a sum.
struct ShapeShare {
    const PosedShape* shape;
    double share;
};

/// Puts the edges of all triangles in the sum of shapes into `edges`, whose memory is used again.
void blend_edges(const PoseTriangles& triangles, std::span<const Vec3> rest,
                 std::span<const ShapeShare> shares, std::vector<TriangleEdges>& edges,
                 const Context& context);

/// Sums over the triangles of a floating component.
struct FloatingSum {
    double area = 0.0, motion = 0.0, weight = 0.0;
    Vec3 shift = Vec3::Zero();
};

/// Moves each floating component of `positions`, which is right but for a shift, to its place in
/// the sum of shapes: that to which the screws of its triangles lead, those of little motion above
/// all. The memory of `sums` is used again.
void place_floating(const PoseTriangles& triangles, std::span<const Index> component_of_vertex,
                    std::span<const char> floats, std::span<const Vec3> rest,
                    std::span<const ShapeShare> shares, std::vector<FloatingSum>& sums,
                    std::span<Vec3> positions);

}  // namespace lissom
