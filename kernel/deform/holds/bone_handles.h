/// Bones: a chain of handles that turn at joints.
#pragma once

#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/deform/options.h"

namespace lissom {

/// A chain of bones of a deformer, at rest: bone i is a handle and goes from joint i to joint
/// i + 1. Its pose is that of its handles.
struct Bones {
    std::vector<Vec3> joints = {};
    /// As of BoneChain: one for each bone, or none.
    std::vector<double> limits = {};
    /// One for each bone; the first also names the chain.
    std::vector<HandleId> handles = {};

    bool operator==(const Bones&) const = default;
};

}  // namespace lissom
