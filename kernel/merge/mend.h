/// Choice between ways to sew a seam by their verdicts; private to kernel/merge.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/merge/merge.h"

namespace lissom {

/// Whether a report has faults of the surface around its seams, which depend on how they were sewn,
/// or crossings.
bool has_surface_faults(const MergeReport& report);

/// Returns the names of the faults of a report, as "folds, bend".
std::string fault_names(const MergeReport& report);

/// Whether a report has fewer faults than another, crossings counted twice and slivers half; or, if
/// `ties`, as many with a surface that turns by less in the bands around the seams.
bool is_better(const MergeReport& report, const MergeReport& than, bool ties);

/// Whether a side crumpled beside the seams along enough edges to show.
bool is_crumpled(const MergeReport& report);

/// Whether a report has fewer faults than another, or as many and a tenth less of crumpled edges.
bool is_fairer(const MergeReport& report, const MergeReport& than);

/// Returns the faces of the groups that cross at a seam and show.
std::vector<Index> showing_faces(std::span<const CrossingGroup> groups);

/// Warns that a seam had faults, and tells the way that it was sewn in its place.
void note_mended(const std::string& faults, const std::string& way, MergeReport& report);

}  // namespace lissom
