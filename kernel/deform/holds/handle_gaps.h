/// Gaps between constraints of different holders; private to kernel/deform.
#pragma once

#include <vector>

#include "kernel/core/index.h"
#include "kernel/deform/holds/constraints.h"
#include "kernel/deform/patch/working_patch.h"

namespace lissom {

/// Two local vertices with different holders, at most two edges apart.
struct HandleGap {
    Index first = kNoIndex, second = kNoIndex;
    /// Length of the edges between them.
    double length = 0.0;
};

/// The gaps of one edge, then those of two, by vertices.
std::vector<HandleGap> handle_gaps(const WorkingPatch& work, const HolderMap& holding);

/// Frees up to `rings` rings of each handle from its vertices at gaps inwards, but never all of a
/// handle: of a small one the innermost ring stays.
void free_gap_rings(const WorkingPatch& work, int rings, HolderMap& holding);

}  // namespace lissom
