/// Unconstrained connected parts, and the surface that they follow; private to kernel/deform.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/deform/holds/constraints.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/working_patch.h"

namespace lissom {

/// A part that moves as a rigid piece with the surface nearest to it.
struct FollowingPart {
    /// Local vertices.
    std::vector<Index> members;
    /// Corners of the triangles nearest to its vertices, all of the part nearest to it.
    std::vector<Index> guides;
    /// The handle or pin that holds all of the guides, or kFree.
    Index owner = kFree;
};

/// Makes unconstrained parts known: they stay, or are returned with the surface that they follow,
/// single vertices without faces among them. Nothing is done for UnheldParts::error.
std::vector<FollowingPart> hold_loose_parts(const WorkingPatch& work, UnheldParts loose,
                                            HolderMap& holding, const Context& context);

}  // namespace lissom
