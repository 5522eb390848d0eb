// Another way to sew, if a verdict is not good.
#include <string>
#include <utility>

#include "kernel/merge/blend/relax_faults.h"
#include "kernel/merge/mend.h"
#include "kernel/merge/merge_stages.h"
#include "kernel/merge/verdict.h"

namespace lissom {
namespace {

bool may_mend(const MergeOptions& options, const MergeReport& report) {
    const bool plain = options.seam == SeamKind::conform && !options.auto_transition &&
                       !(options.source_transition > 0.0) && !(options.target_transition > 0.0);
    return options.mend && plain && options.collar && options.smooth > 0 && !options.thesis &&
           has_surface_faults(report);
}

JudgedSides sewn_judged(const PreparationReport& prepared, const Boundaries& boundaries,
                        const MergeOptions& options, const Matching& matching,
                        const DeformedSource& moved, const Context& context) {
    JudgedSides sides{sew_sides(boundaries, options, matching, moved, context), {}};
    sides.report = report_of(prepared, boundaries, options, matching, moved, sides.merged, context);
    return sides;
}

// Takes folds and crossings beside the seams away, as far as that leaves fewer faults. Returns
// whether it did.
bool relax_best(const PreparationReport& prepared, const Boundaries& boundaries,
                const MergeOptions& options, const Matching& matching, const DeformedSource& moved,
                JudgedSides& best, const Context& context) {
    bool better = false;
    JudgedSides tried = best;
    for (Index rings = 1; rings <= kRelaxRings && !tried.report.ok; rings *= 2) {
        if (!relax_sides(boundaries, options, tried.report, rings, tried.merged, context)) break;
        tried.report =
            report_of(prepared, boundaries, options, matching, moved, tried.merged, context);
        if (!is_better(tried.report, best.report, false)) continue;
        best = tried;
        better = true;
    }
    return better;
}

}  // namespace

JudgedSides judged_sides(const PreparationReport& prepared, const Boundaries& boundaries,
                         const MergeOptions& asked, const Matching& matching,
                         const DeformedSource& moved, const Context& context) {
    JudgedSides best = sewn_judged(prepared, boundaries, asked, matching, moved, context);
    if (!may_mend(asked, best.report)) return best;
    const std::string faults = fault_names(best.report);
    // The least change first.
    const bool relaxed = has_only_thorns(best.report) &&
                         relax_best(prepared, boundaries, asked, matching, moved, best, context);
    if (relaxed && best.report.ok) {
        note_mended(faults, "its thorns are smoothed", best.report);
        return best;
    }
    MergeOptions fair = asked, blended = asked;
    fair.seam = SeamKind::fair;
    blended.auto_transition = true;
    std::string way = relaxed ? "its thorns are smoothed" : "";
    const MergeOptions* taken = &asked;
    for (const auto& [options, name] :
         {std::pair(&fair, "the seam is fair"), std::pair(&blended, "a transition is made")}) {
        JudgedSides other = sewn_judged(prepared, boundaries, *options, matching, moved, context);
        if (!is_better(other.report, best.report, !way.empty())) continue;
        best = std::move(other);
        way = name;
        taken = options;
    }
    if (!best.report.ok &&
        relax_best(prepared, boundaries, *taken, matching, moved, best, context)) {
        way += (way.empty() ? "" : " and ") + std::string("the folds beside it are smoothed");
    }
    if (!way.empty()) note_mended(faults, way, best.report);
    return best;
}

}  // namespace lissom
