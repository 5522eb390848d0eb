/// Skins of meshes that are sewn; private to kernel/merge.
#pragma once

#include <optional>
#include <span>

#include "kernel/core/context.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Throws skin_mismatch if both meshes have skins whose joints are not known to be the same: the
/// joints of the objects at a join's loops must have the same names in the same order, or neither
/// mesh tells names. Numbers then mean the same joint on both sides, and weights are blended over
/// the seam by joint.
void require_same_joints(const Mesh& target, const Mesh& source, std::span<const LoopPair> joins);

/// The side that alone has a skin, if it is so.
std::optional<SeamSide> skinned_side(const Mesh& target, const Mesh& source);

/// Gives the other side weights: those of the seam, continued by a harmonic function over the
/// edges, so that it follows the skinned side and moves as one piece far from it. Its faces become
/// part of the skinned side's object at the seam. Pieces that no seam reaches get weights of 0.
void extend_skin(Sewn& sewn, SeamSide skinned, const Context& context);

}  // namespace lissom
