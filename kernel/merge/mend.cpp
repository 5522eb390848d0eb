#include "kernel/merge/mend.h"

#include <algorithm>

#include "kernel/merge/verdict.h"

namespace lissom {
namespace {

bool depends_on_sewing(const MergeReason& reason) {
    switch (reason.fault) {
        case MergeFault::crossings:
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

// Angles by which the surface turns in the bands: of two ways with as many faults the one with
// less looks better.
double unrest(const MergeReport& report) {
    double sum = 0.0;
    for (const JoinReport& join : report.joins) {
        sum += join.band.flare + join.band.bend + join.band.roughness;
    }
    return sum;
}

// How much a fault spoils a result.
double weight_of(const MergeReason& reason) {
    if (reason.fault == MergeFault::crossings || reason.fault == MergeFault::side) return 2.0;
    return reason.fault == MergeFault::slivers ? 0.5 : 1.0;
}

double weight_of(const MergeReport& report) {
    double sum = 0.0;
    for (const MergeReason& reason : report.reasons) sum += weight_of(reason);
    return sum;
}

// Shorter crumpled edges, in radii of the seams, do not show.
constexpr double kFewCrumpled = 0.25;
// Part of the crumpled edges that fairing takes away, if it is worth it.
constexpr double kFairerBy = 0.1;

double crumpled_sum(const MergeReport& report) {
    double sum = 0.0;
    for (const JoinReport& join : report.joins) sum += join.band.crumpled;
    return sum;
}

}  // namespace

bool has_surface_faults(const MergeReport& report) {
    return std::any_of(report.reasons.begin(), report.reasons.end(), depends_on_sewing);
}

std::string fault_names(const MergeReport& report) {
    std::string names;
    for (const MergeReason& reason : report.reasons) {
        names += (names.empty() ? "" : ", ") + std::string(fault_name(reason.fault));
    }
    return names;
}

bool is_better(const MergeReport& report, const MergeReport& than, bool ties) {
    const double weight = weight_of(report), least = weight_of(than);
    return weight < least || (ties && weight <= least && unrest(report) < unrest(than));
}

bool is_crumpled(const MergeReport& report) {
    return crumpled_sum(report) > kFewCrumpled;
}

bool is_fairer(const MergeReport& report, const MergeReport& than) {
    const double weight = weight_of(report), before = weight_of(than);
    const bool fairer = crumpled_sum(report) < (1.0 - kFairerBy) * crumpled_sum(than);
    return weight < before || (weight <= before && fairer);
}

std::vector<Index> showing_faces(std::span<const CrossingGroup> groups) {
    std::vector<Index> faces;
    for (const CrossingGroup& group : groups) {
        if (group.place != CrossingPlace::seam || group.shallow || group.hidden) continue;
        faces.insert(faces.end(), group.faces.begin(), group.faces.end());
    }
    return faces;
}

void note_mended(const std::string& faults, const std::string& way, MergeReport& report) {
    report.warnings.push_back("the plain seam had faults (" + faults + "): " + way +
                              " in its place, which has fewer");
}

}  // namespace lissom
