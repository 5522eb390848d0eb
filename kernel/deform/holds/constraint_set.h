/// Handles and constraints of a deformation, without their poses. Copies share their content, so
/// that keeping one is a cheap undo.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/deform/holds/bone_handles.h"
#include "kernel/deform/mesh_point.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/sparse_row.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Vertices and points that move as one.
struct Handle {
    Region region;
    HandleOptions options;
    /// Mean of the rest positions of its vertices and points.
    Vec3 center = Vec3::Zero();
    /// Its vertices by their numbers in the patch, and its points as means of such vertices.
    std::vector<Index> local = {};
    std::vector<SparseRow> points = {};
    /// The handle that is its mirror image, or kNoIndex.
    Index partner = kNoIndex;
    MirrorPlane mirror = {};

    bool soft() const { return options.weight.has_value(); }
};

/// A constraint of a vertex or a point; its values are in the poses.
struct Target {
    MeshPoint point;
    /// The point as a mean of vertices of the patch.
    SparseRow row;
    bool position = false, gradient = false;
    std::optional<double> weight = std::nullopt;

    /// Hard constraints of single vertices are eliminated; others become anchors (ties.h).
    bool is_hard_vertex() const { return row.size() == 1 && !weight; }
};

/// Handles, constraints, stiffness and bones.
struct ConstraintSet {
    /// By HandleId; null for a removed one.
    std::vector<std::shared_ptr<const Handle>> handles;
    /// Hard vertices first, by vertex; then the others, by row.
    std::vector<std::shared_ptr<const Target>> targets;
    /// Stiffness of each real vertex of the patch, or null if all are 1.
    std::shared_ptr<const std::vector<double>> stiffness;
    /// In the order they were added; their handles are there.
    std::vector<std::shared_ptr<const Bones>> bones = {};
};

}  // namespace lissom
