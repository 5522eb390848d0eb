/// The two values that a user of a deformation edits: who is held, and where it goes. Copies share
/// what they have in common, so that keeping one is a cheap undo.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/deform/mesh_point.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/sparse_row.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// What moves as one.
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

/// What a constraint of a vertex or a point prescribes; the values are in the poses.
struct Target {
    MeshPoint point;
    /// The point as a mean of vertices of the patch.
    SparseRow row;
    bool position = false, gradient = false;
    std::optional<double> weight = std::nullopt;

    /// Hard constraints of single vertices are eliminated; others become anchors (ties.h).
    bool is_hard_vertex() const { return row.size() == 1 && !weight; }
};

/// Who is held, and who is stiff.
struct Holds {
    /// By HandleId; null where one was removed.
    std::vector<std::shared_ptr<const Handle>> handles;
    /// Those of hard vertices first, by vertex; then the others, by row.
    std::vector<std::shared_ptr<const Target>> targets;
    /// Stiffness of each real vertex of the patch, or null where all are 1.
    std::shared_ptr<const std::vector<double>> stiffness;
};

/// Where one handle goes.
struct HandlePose {
    Affine transform = {};
    /// `transform` as the patch sees it: relative to the patch's origin, with digits that the one
    /// above lacks where the mesh lies far from the origin of its coordinates.
    Affine local_transform = {};
    /// The rotation of the transform as a rotation vector that counts full turns.
    Vec3 turn = Vec3::Zero();

    bool at_rest() const { return transform.is_identity() && turn.isZero(0.0); }
    bool operator==(const HandlePose&) const = default;
};

/// Where one target goes; what it does not prescribe has no effect.
struct TargetPose {
    Vec3 position = Vec3::Zero();
    Mat3 gradient = Mat3::Identity();

    bool operator==(const TargetPose&) const = default;
};

/// Where everything goes: one pose for each handle and each target of the holds.
struct Poses {
    std::vector<HandlePose> handles;
    std::vector<TargetPose> targets;

    bool operator==(const Poses&) const = default;
};

}  // namespace lissom
