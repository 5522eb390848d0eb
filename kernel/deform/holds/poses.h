/// Poses of the handles and targets of a deformation.
#pragma once

#include <optional>
#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

/// The pose of one handle.
struct HandlePose {
    Affine transform = {};
    /// `transform` as the patch sees it: relative to the patch's origin, with digits that the one
    /// above lacks if the mesh lies far from the origin of its coordinates.
    Affine local_transform = {};
    /// The rotation of the transform as a rotation vector that counts full turns.
    Vec3 turn = Vec3::Zero();

    bool at_rest() const { return transform.is_identity() && turn.isZero(0.0); }
    bool operator==(const HandlePose&) const = default;
};

/// The values of one target; those that it does not prescribe have no effect.
struct TargetPose {
    Vec3 position = Vec3::Zero();
    Mat3 gradient = Mat3::Identity();

    bool operator==(const TargetPose&) const = default;
};

/// One pose for each handle and each target of a constraint set, and the share of the volume that
/// is kept in place of DeformOptions::volume, if it is given.
struct Poses {
    std::vector<HandlePose> handles;
    std::vector<TargetPose> targets;
    std::optional<double> volume = std::nullopt;

    bool operator==(const Poses&) const = default;
};

}  // namespace lissom
