// Another way to sew, if a verdict is not good.
#include <string>
#include <utility>

#include "kernel/merge/blend/fair_spots.h"
#include "kernel/merge/blend/relax_faults.h"
#include "kernel/merge/mend.h"
#include "kernel/merge/merge_stages.h"
#include "kernel/merge/verdict.h"

namespace lissom {
namespace {

bool may_mend(const MergeOptions& options) {
    const bool plain = options.seam == SeamKind::conform && !options.auto_transition &&
                       !(options.source_transition > 0.0) && !(options.target_transition > 0.0);
    return options.mend && plain && options.collar && options.smooth > 0 && !options.thesis;
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

// Fairs the places at which a side crumpled, as far as that leaves fewer of them and no more
// faults.
void fair_along(const PreparationReport& prepared, const Boundaries& boundaries,
                const MergeOptions& options, const Matching& matching, const DeformedSource& moved,
                bool creases, JudgedSides& best, const Context& context) {
    for (SpotWay way{kMinSpotRings, creases}; way.rings <= kMaxSpotRings; ++way.rings) {
        if (!is_crumpled(best.report)) return;
        JudgedSides tried = best;
        if (!fair_sides(boundaries, options, way, tried.merged, context)) return;
        tried.report =
            report_of(prepared, boundaries, options, matching, moved, tried.merged, context);
        if (is_fairer(tried.report, best.report)) best = std::move(tried);
    }
}

// The same. Creases of the source that keep a place crumpled, as all edges of a coarse one do, are
// faired too.
void fair_best(const PreparationReport& prepared, const Boundaries& boundaries,
               const MergeOptions& options, const Matching& matching, const DeformedSource& moved,
               JudgedSides& best, const Context& context) {
    if (!is_crumpled(best.report)) return;
    JudgedSides other = best;
    fair_along(prepared, boundaries, options, matching, moved, true, best, context);
    if (!is_crumpled(best.report)) return;
    fair_along(prepared, boundaries, options, matching, moved, false, other, context);
    if (is_fairer(other.report, best.report)) best = std::move(other);
}

// Says so in the report, and in all that are made of the same sides.
void note_way(const std::string& faults, const std::string& way, JudgedSides& best) {
    note_mended(faults, way, best.report);
    best.merged.warnings.push_back(best.report.warnings.back());
}

// Sews another way, as far as that leaves fewer faults than `best`.
void mend_best(const PreparationReport& prepared, const Boundaries& boundaries,
               const MergeOptions& asked, const Matching& matching, const DeformedSource& moved,
               JudgedSides& best, const Context& context) {
    const std::string faults = fault_names(best.report);
    // The least change first.
    const bool relaxed = has_only_thorns(best.report) &&
                         relax_best(prepared, boundaries, asked, matching, moved, best, context);
    if (relaxed && best.report.ok) return note_way(faults, "its thorns are smoothed", best);
    MergeOptions fair = asked, blended = asked;
    fair.seam = SeamKind::fair;
    blended.auto_transition = true;
    std::string way = relaxed ? "its thorns are smoothed" : "";
    const MergeOptions* taken = &asked;
    for (const auto& [options, name] :
         {std::pair(&fair, "the seam is fair"), std::pair(&blended, "a transition is made")}) {
        JudgedSides other = sewn_judged(prepared, boundaries, *options, matching, moved, context);
        fair_best(prepared, boundaries, *options, matching, moved, other, context);
        if (!is_better(other.report, best.report, !way.empty())) continue;
        best = std::move(other);
        way = name;
        taken = options;
    }
    if (!best.report.ok &&
        relax_best(prepared, boundaries, *taken, matching, moved, best, context)) {
        way += (way.empty() ? "" : " and ") + std::string("the folds beside it are smoothed");
    }
    if (!way.empty()) note_way(faults, way, best);
}

}  // namespace

JudgedSides judged_sides(const PreparationReport& prepared, const Boundaries& boundaries,
                         const MergeOptions& asked, const Matching& matching,
                         const DeformedSource& moved, const Context& context) {
    JudgedSides best = sewn_judged(prepared, boundaries, asked, matching, moved, context);
    if (!may_mend(asked)) return best;
    const std::string faults = best.report.ok ? "" : fault_names(best.report);
    fair_best(prepared, boundaries, asked, matching, moved, best, context);
    if (has_surface_faults(best.report)) {
        mend_best(prepared, boundaries, asked, matching, moved, best, context);
    } else if (best.report.ok && !faults.empty()) {
        note_way(faults, "its crumpled places are fair", best);
    }
    return best;
}

}  // namespace lissom
