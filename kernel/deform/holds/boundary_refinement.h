/// Local refinement of a patch at constraints that are coarse beside the moving part (section 2.5);
/// private to kernel/deform.
#pragma once

#include <optional>

#include "kernel/core/index.h"
#include "kernel/deform/holds/constraints.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/deform/patch/sparse_row.h"

namespace lissom {

/// Ratio of edge lengths, border to moving part, in the mean over a connected piece, that makes the
/// border of a constraint coarse.
inline constexpr double kCoarseBorder = 2.0;
/// Length, in those of the edges that move, down to which a coarse border is refined.
inline constexpr double kRefinedBorder = 1.0;

/// Returns the patch with the edges of coarse borders split, by bisecting longest edges (Rivara
/// 1984), which keeps the angles of triangles; or nothing if no border is coarse. New vertices lie
/// on the triangles of the patch, so that its surface stays as it is, and those between vertices of
/// one holder are held by it. Quads that are reached become four triangles around their mean.
std::optional<Patch> refined_at_borders(const Patch& patch, const HolderMap& holding,
                                        double length = kRefinedBorder);

/// Returns the holder that vertices of the patch share and that fixes their position, or kFree.
Index common_holder(const SparseRow& row, const HolderMap& holding);

}  // namespace lissom
