#include "kernel/merge/verdict.h"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace lissom {
namespace {

constexpr double kRadian = 180.0 / kPi;
// Pairs of real models whose seams nobody sees turn by up to this angle at one edge, in radians.
constexpr double kSteep = 30.0 / kRadian;
// Triangles thinner than this have no reliable normals.
constexpr double kThin = 2.0 / kRadian;

std::string angle_text(double radians) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f degrees", radians * kRadian < 10.0 ? 1 : 0,
                  radians * kRadian);
    return text;
}

std::string joined_by(const std::vector<std::string>& texts, const char* separator) {
    std::string all;
    for (const std::string& text : texts) all += (all.empty() ? "" : separator) + text;
    return all;
}

double steepest_rim(const MergeReport& report) {
    return std::max(report.source_rim.greatest_near, report.target_rim.greatest_near);
}

bool all_fit(const MergeReport& report) {
    return !report.joins.empty() && std::all_of(report.joins.begin(), report.joins.end(),
                                                [](const JoinReport& join) { return join.fits; });
}

// A steep seam is good where the surface was as steep beside it, which is told.
std::string beside_text(const MergeReport& report) {
    if (report.seam.after.greatest_dihedral <= kSteep) return "";
    if (all_fit(report)) return "as the parts were given, ";
    return "as beside the boundaries before (" + angle_text(steepest_rim(report)) + "), ";
}

void judge_angles(const MergeReport& report, std::vector<std::string>& faults) {
    const SeamQuality& seam = report.seam.after;
    const double steepest = steepest_rim(report);
    // Parts that fit are as steep as they were given.
    if (seam.greatest_dihedral > std::max(kSteep, steepest) && !all_fit(report)) {
        faults.push_back("the surface turns by " + angle_text(seam.greatest_dihedral) +
                         " across the seam, and by " + angle_text(steepest) +
                         " at most beside the boundaries before");
    }
    double thinnest = kThin;
    for (const SeamQuality* rim : {&report.source_rim, &report.target_rim}) {
        if (rim->smallest_angle > 0.0) thinnest = std::min(thinnest, rim->smallest_angle);
    }
    // Both are 0 where there are no triangles.
    const bool triangles = seam.smallest_angle > 0.0 || seam.low_angle > 0.0;
    if (triangles && seam.smallest_angle < thinnest) {
        faults.push_back("triangles at the seam have angles down to " +
                         angle_text(seam.smallest_angle));
    }
}

void judge_sides(const MergeReport& report, std::vector<std::string>& faults) {
    for (std::size_t j = 0; j < report.joins.size(); ++j) {
        if (!report.joins[j].same_side) continue;
        faults.push_back("both parts lie on the same side of join " + std::to_string(j + 1) +
                         ", so that the source turns over");
    }
}

void judge_places(const MergeReport& report, std::vector<std::string>& faults) {
    for (std::size_t j = 0; j < report.joins.size(); ++j) {
        const JoinReport& join = report.joins[j];
        if (!join.guessed || join.any_turn || join.certainty >= kCertain) continue;
        faults.push_back("where the boundaries of join " + std::to_string(j + 1) +
                         " meet is a guess");
    }
}

}  // namespace

Verdict verdict_of(const MergeReport& report, bool sought) {
    std::vector<std::string> faults;
    judge_angles(report, faults);
    judge_sides(report, faults);
    if (!report.intersections.empty()) {
        faults.push_back(std::to_string(report.intersections.size()) +
                         " pairs of faces run through one another that did not before");
    }
    judge_places(report, faults);
    if (!faults.empty()) return {false, "not good: " + joined_by(faults, "; ")};
    return {true, "good: the surface turns by at most " +
                      angle_text(report.seam.after.greatest_dihedral) + " across the seam, " +
                      beside_text(report) + "and " +
                      (sought ? "no faces run through one another that did not before"
                              : "faces that run through one another were not looked for")};
}

}  // namespace lissom
