/// A part inside the boundary that suits it best, on the target as that is opened for it; private
/// to kernel/merge.
#pragma once

#include <optional>
#include <span>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/merge/paste/part/opened_target.h"
#include "kernel/merge/paste/part_trial.h"
#include "kernel/merge/paste/paste_options.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Returns the part inside the outline, placed by the maps alone.
PartTrial outline_trial(const PartTrials& trials, const Context& context);

/// The feature inside its own outline, without teeth if that can be.
PartTrial tight_trial(const PartTrials& trials, const Context& context);

/// The feature as it was, with its foot drawn down to the target, if that has sharp edges under it;
/// nothing if it has none or the foot would go too deep.
std::optional<PartTrial> draped_trial(const PartTrials& trials, const Context& context);

struct BestTrial {
    PartTrial trial;
    /// Distortion near the outline, of the part before iterations, if it was compared.
    std::optional<PasteDistortion> outline_near;
};

/// Returns the part inside the boundary that was found, or inside the outline if that is to be
/// compared and distorts it less.
BestTrial best_trial(const PartTrials& trials, bool with_outline, const Context& context);

/// A part whose boundary lies on the edge of the hole that was cut for it.
struct LaidPart {
    PartTrial trial;
    OpenedTarget opened;
    LoopPair pair;
    /// Near the boundary before it was laid on the edge.
    PasteDistortion near;
};

/// `ground` has the faces of the target's chart, whose vertices are `chart_vertices` of it.
/// Errors: as open_target.
LaidPart laid_part(const PartTrials& trials, const Mesh& ground,
                   std::span<const Index> chart_vertices, PartTrial trial, const Context& context);

/// Returns the part as sewing leaves it, with its boundary at the seam's vertices; but the vertices
/// that sewing drops, since they are close to another of the part, are still there.
Mesh part_at_seam(const LaidPart& laid);

}  // namespace lissom
