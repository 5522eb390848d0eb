/// Corrections of a handle basis at key poses, blended by the pose: pose space deformation (Lewis,
/// Cordner and Fong 2000) with cubic radial functions. bindings/engine/lissom_basis.h describes
/// their place in a file.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/deformer.h"

namespace lissom {

/// Greatest number of key poses of a basis.
inline constexpr std::size_t kMaxBasisKeys = 256;

/// A pose whose surface is known.
struct BasisKey {
    /// Transforms of the mesh's space, one a handle.
    std::vector<Affine> transforms;
    /// Positions of the region's vertices.
    std::vector<Vec3> positions;
};

/// A pose of handles is a list of 12 numbers a handle: its turn as a rotation vector of at most
/// half a turn, the way of its center in sizes of the basis, and its stretch less the identity. The
/// poses of the keys span a space; a pose is projected onto its axes, and held within the range of
/// the keys, before the weights are found.
struct EngineKeys {
    /// Orthonormal axes of the keys' poses, one a row.
    Eigen::MatrixXd axes;
    /// Range of the keys along each axis.
    Eigen::VectorXd min, max;
    /// Coordinates of the keys, one a row; and then of the rest pose, which has no correction,
    /// unless it is a key.
    Eigen::MatrixXd nodes;
    /// Weights of the keys, a column each: a row for the cubed distance to each node, one for each
    /// coordinate, and one for the number 1.
    Eigen::MatrixXd blend;
    /// Offsets of the vertices, a list for each key.
    std::vector<std::vector<Eigen::Vector3f>> corrections;

    bool empty() const { return corrections.empty(); }
    /// Returns the weight of each key at a pose; see `engine_pose`.
    Eigen::VectorXd weights_at(const Eigen::VectorXd& pose) const;
};

/// Returns the 12 numbers of a handle with its center at `center`, moved by `local`, both relative
/// to the origin of a basis of the given size.
Eigen::Matrix<double, 12, 1> engine_pose(const Affine& local, const Vec3& center, double size);

/// Solves the deformation as its handles stand now, with both systems, as a key. Errors: as
/// Deformer::solve.
BasisKey make_basis_key(Deformer& deformer, const Context& context = {});

/// Solves keys for given transforms, one a handle each; the deformer is as before afterwards.
/// Errors: as Deformer::solve and Deformer::set_transform; invalid_argument for another number of
/// transforms.
std::vector<BasisKey> make_basis_keys(Deformer& deformer,
                                      std::span<const std::vector<Affine>> poses,
                                      const Context& context = {});

/// Fits axes, nodes and weights to poses, one a column. Errors: invalid_argument for a pose that is
/// there twice.
EngineKeys fit_engine_keys(const Eigen::MatrixXd& poses);

}  // namespace lissom
