// Another way to sew, if a verdict is not good.
#include <algorithm>
#include <string>
#include <utility>

#include "kernel/merge/merge_stages.h"

namespace lissom {
namespace {

// Faults of the surface around a seam, which depend on how it was sewn.
bool depends_on_sewing(const MergeReason& reason) {
    switch (reason.fault) {
        case MergeFault::folds:
        case MergeFault::roughness:
        case MergeFault::bend:
        case MergeFault::flare:
        case MergeFault::spike:
        case MergeFault::seam:
            return true;
        default:
            return false;
    }
}

bool may_mend(const MergeOptions& options, const MergeReport& report) {
    const bool plain = options.seam == SeamKind::conform && !options.auto_transition &&
                       !(options.source_transition > 0.0) && !(options.target_transition > 0.0);
    return options.mend && plain && options.collar && options.smooth > 0 && !options.thesis &&
           std::any_of(report.reasons.begin(), report.reasons.end(), depends_on_sewing);
}

JudgedSides sewn_judged(const MergePreparation& preparation, const MergeOptions& options,
                        const Matching& matching, const DeformedSource& moved,
                        const Context& context) {
    JudgedSides sides{sew_sides(preparation.boundaries, options, matching, moved, context), {}};
    sides.report = report_of(preparation.report, preparation.boundaries, options, matching, moved,
                             sides.merged, context);
    return sides;
}

// Angles by which the surface turns in the bands: of two ways with as many faults the one with
// less looks better.
double unrest(const MergeReport& report) {
    double sum = 0.0;
    for (const JoinReport& join : report.joins) {
        sum += join.band.flare + join.band.bend + join.band.roughness;
    }
    return sum;
}

std::string fault_names(const MergeReport& report) {
    std::string names;
    for (const MergeReason& reason : report.reasons) {
        names += (names.empty() ? "" : ", ") + std::string(fault_name(reason.fault));
    }
    return names;
}

}  // namespace

JudgedSides judged_sides(const MergePreparation& preparation, const Matching& matching,
                         const DeformedSource& moved, const Context& context) {
    const MergeOptions& asked = preparation.options;
    JudgedSides best = sewn_judged(preparation, asked, matching, moved, context);
    if (!may_mend(asked, best.report)) return best;
    const std::string faults = fault_names(best.report);
    MergeOptions fair = asked, blended = asked;
    fair.seam = SeamKind::fair;
    blended.auto_transition = true;
    std::string way;
    for (const auto& [options, name] :
         {std::pair(&fair, "the seam is fair"), std::pair(&blended, "a transition is made")}) {
        JudgedSides other = sewn_judged(preparation, *options, matching, moved, context);
        const bool first = way.empty();
        const std::size_t count = other.report.reasons.size(), least = best.report.reasons.size();
        const bool calmer = !first && count == least && unrest(other.report) < unrest(best.report);
        if (count >= least && !calmer) continue;
        best = std::move(other);
        way = name;
    }
    if (!way.empty()) {
        best.report.warnings.push_back("the plain seam had faults (" + faults + "): " + way +
                                       " in its place, which has fewer");
    }
    return best;
}

}  // namespace lissom
