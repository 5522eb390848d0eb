/// StrandReport: findings of a check before saving strands, and omissions of a file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/error.h"

namespace lissom {

/// Kinds of findings. The name in scripts is that of `strand_finding_name`.
enum class StrandFindingKind {
    // Changes of the written strands.
    strands_not_finite,   ///< left out: a coordinate is NaN or infinite
    points_repeated,      ///< strands with segments without length; the second points are left out
    strands_too_short,    ///< left out: fewer points than the format needs, once repeats are gone
    widths_not_positive,  ///< strands with a width that is not above 0; replaced by the least that
                          ///< is
    points_resampled,     ///< strands whose number of points the format does not have
    groups_unnamed,       ///< groups without a name or with one that is taken; named "group 3"
    content_dropped,      ///< content without a place in the format; the message names it
    // Written as they are.
    roots_last,        ///< strands whose tip lies nearer to the head than their root
    root_uv_constant,  ///< all strands have the same root uv, by which hair shows bald or in one
                       ///< place
};

/// Returns the name of a kind in scripts and reports: "points_repeated".
std::string_view strand_finding_name(StrandFindingKind kind);

struct StrandFinding {
    StrandFindingKind kind;
    /// Strands concerned, by their numbers; kind `none` if the finding is not about strands.
    Elements elements;
    /// A sentence on the finding and its treatment.
    std::string message;
};

/// Findings in the order of the checks; at most one of a kind.
struct StrandReport {
    std::vector<StrandFinding> findings;

    bool empty() const { return findings.empty(); }
    /// Returns the finding of a kind, or null.
    const StrandFinding* find(StrandFindingKind kind) const;
};

}  // namespace lissom
