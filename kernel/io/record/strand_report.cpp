#include "kernel/io/record/strand_report.h"

#include <algorithm>
#include <array>

namespace lissom {

std::string_view strand_finding_name(StrandFindingKind kind) {
    constexpr std::array<std::string_view, 9> kNames{
        "strands_not_finite",  "points_repeated",  "strands_too_short",
        "widths_not_positive", "points_resampled", "groups_unnamed",
        "content_dropped",     "roots_last",       "root_uv_constant"};
    return kNames[static_cast<std::size_t>(kind)];
}

const StrandFinding* StrandReport::find(StrandFindingKind kind) const {
    const auto found =
        std::find_if(findings.begin(), findings.end(),
                     [&](const StrandFinding& finding) { return finding.kind == kind; });
    return found == findings.end() ? nullptr : &*found;
}

}  // namespace lissom
