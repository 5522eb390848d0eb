/// Bones of a deformer: each holds the surface around its middle as a handle, and the solver finds
/// how the rest follows.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/bones/bone_chain.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/holds/bone_handles.h"
#include "kernel/deform/options.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

class FramedCurve;

struct BonesOptions {
    /// Joints in the rest pose, from the base to the tip, within the surface, of which the first
    /// and the last may stick out a little; two at least.
    std::vector<Vec3> joints;
    /// As of BoneChain.
    std::vector<double> limits = {};
    /// Part of each bone's length, around its middle, along which it holds the surface; above 0, at
    /// most 1.
    double share = 0.3;
    /// Above 0 a bone holds the vertices within this distance of it, and joints may lie anywhere:
    /// for lines along a surface, such as brows and lips. In units of length.
    double radius = 0.0;
};

/// Options of a handle along a curve, in arc lengths of the curve and radians.
struct CarryOptions {
    double from = 0.0, along = 0.0, twist = 0.0;
};

/// Options of bones along a curve.
struct BonesFollowOptions {
    /// Joints keep their shares of the length, and bones stretch along themselves to span them; no
    /// limit holds then. Otherwise their lengths stay.
    bool stretch = false;
    /// Turn about the curve from the base to the tip, in radians.
    double twist = 0.0;
};

/// Returns for each bone the vertices that it holds: those in `region` that are nearer to it than
/// to the other bones, lie beside its middle share, and see it from within the surface, or are as
/// near as the radius. Coarse meshes, which have none there, give the nearest beside the bone's
/// middle. Errors: invalid_argument for options out of range, and naming the bone, if no vertex
/// sees it, or the joint, if it lies outside a surface that has an inside; as BoneChain;
/// memory_limit; cancelled.
std::vector<Region> bone_regions(const Mesh& rest, const Region& region,
                                 const BonesOptions& options, const Context& context = {});

/// Adds a handle for each bone. `mesh` is that of the deformer, which keeps the chain along with
/// its handles: in snapshots, scene files, and through a rebase, after which limits count from the
/// new rest. Errors: as bone_regions and Deformer::add_handle; no handle is added then.
Bones add_bones(Deformer& deformer, const Mesh& mesh, const BonesOptions& options,
                const Context& context = {});

/// Returns the chains of a deformer, in the order they were added. A chain goes when one of its
/// handles is removed.
std::vector<Bones> bones_of(const Deformer& deformer);
/// Returns the chain of which this is the first handle. Errors: handle_removed if there is none.
const Bones& bones_with(const Deformer& deformer, HandleId first);
/// Removes a chain and its handles. Errors: handle_removed.
void remove_bones(Deformer& deformer, const Bones& bones);

/// Returns the chain as its handles are now, without their stretch. Errors: handle_removed.
BoneChain chain_of(const Deformer& deformer, const Bones& bones);
/// Returns the joints where the handles carry them. Errors: handle_removed.
std::vector<Vec3> joints_of(const Deformer& deformer, const Bones& bones);

/// Moves the handles as a chain. Errors: handle_removed; invalid_argument for another number of
/// bones.
void set_bones(Deformer& deformer, const Bones& bones, const BoneChain& chain);

/// Lays bones along a curve (spline IK), as BoneChain::follow or stretched. Errors: handle_removed;
/// not_finite; invalid_argument for a stretch over a curve that runs back onto itself at a joint.
void follow(Deformer& deformer, const Bones& bones, const FramedCurve& curve,
            const BonesFollowOptions& options = {});
/// Moves a handle along a curve: as a body that is carried from arc length `from` to `along` with
/// the curve's frame, turned by `twist` radians about it. Its former motion is replaced. Errors:
/// handle_removed; not_finite.
void follow(Deformer& deformer, HandleId handle, const FramedCurve& curve,
            const CarryOptions& options);

}  // namespace lissom
