/// Hair of one head is put onto another, of other faces, shape, place, size and unit.
#pragma once

#include <optional>

#include "kernel/core/context.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct TransferOptions {
    /// Factor of the strands' lengths, above 0; if absent, the ratio of the heads' sizes, by which
    /// styles fit them.
    std::optional<double> scale = std::nullopt;
    /// Keeps points out of the new head, this many metres off its skin from 10 mm along the strand
    /// on; 0 or more, or absent to leave them.
    std::optional<double> clearance = 0.0005;
};

/// A head and its scalp, which was made for it.
struct ScalpedHead {
    const Mesh& head;
    const Scalp& scalp;
};

/// Returns the strands on another head. Places correspond by directions from the middles of the
/// heads, as the frames of their scalps name them. Hair follows the old head as that takes the
/// shape of the new one (StrandFollower), is rooted on the nearest skin, and pushed out of it.
/// Groups, ids, guides, widths and colours stay; faces, weights and texture coordinates of roots
/// are those of the new head. Errors: invalid_argument for strands without roots on `from`, and for
/// options out of range; topology_mismatch for a scalp of another head; memory_limit; cancelled.
Strands transferred(const Strands& strands, const ScalpedHead& from, const ScalpedHead& to,
                    const TransferOptions& options = {}, const Context& context = {});

}  // namespace lissom
