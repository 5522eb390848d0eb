#include "kernel/merge/paste/scatter_verdict.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lissom {
namespace {

// The part of the places that may have no part before a scatter looks patchy.
constexpr double kLeftOut = 0.1;
// The part of the parts that may have a fault of the surface beside them: a scatter is seen as a
// whole.
constexpr double kFaultyParts = 0.1;

std::string parts_text(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " part" : " parts");
}

// Whether one part with a fault spoils a scatter.
bool spoils(MergeFault fault) {
    return fault == MergeFault::crossings || fault == MergeFault::folds ||
           fault == MergeFault::bite;
}

bool are_few(std::size_t parts, const ScatterResult& result) {
    return static_cast<double>(parts) <= kFaultyParts * static_cast<double>(result.placed);
}

void note_crossings(const ScatterResult& result, std::vector<MergeReason>& reasons) {
    if (result.crossings == 0) return;
    reasons.push_back(
        {MergeFault::crossings, kNoIndex, static_cast<double>(result.crossings), 0.0,
         std::to_string(result.crossings) + " pairs of faces of parts run through something",
         "let parts shrink or leave out crossing ones"});
}

// The first of each kind of fault stands for all parts that have it.
void note_parts(const ScatterResult& result, std::vector<MergeReason>& reasons) {
    std::map<MergeFault, std::vector<const MergeReason*>> kinds;
    for (const FaultyPlace& place : result.faulty) {
        for (const MergeReason& reason : place.reasons) kinds[reason.fault].push_back(&reason);
    }
    for (const auto& [fault, found] : kinds) {
        if (!spoils(fault) && are_few(found.size(), result)) continue;
        const std::string text = parts_text(found.size()) + ": " + found.front()->text;
        reasons.push_back(
            {fault, kNoIndex, static_cast<double>(found.size()), 0.0, text, found.front()->remedy});
    }
}

// The message that most refusals have.
std::string usual_refusal(const ScatterResult& result) {
    std::map<std::string, int> counts;
    for (const RefusedPlace& refused : result.refused) ++counts[refused.message];
    const auto most =
        std::max_element(counts.begin(), counts.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == counts.end() ? "" : most->first;
}

void note_left_out(const ScatterResult& result, Index places, std::vector<MergeReason>& reasons) {
    const std::size_t count = result.refused.size();
    const double part = places > 0 ? static_cast<double>(count) / places : 0.0;
    if (!(part > kLeftOut)) return;
    reasons.push_back({MergeFault::left_out, kNoIndex, part, kLeftOut,
                       std::to_string(count) + " of " + std::to_string(places) +
                           " places have no part, most of them since: " + usual_refusal(result),
                       "make parts smaller, put places farther apart or away from borders and "
                       "sharp edges"});
}

std::string counts_text(const ScatterResult& result) {
    std::string text = parts_text(at(result.placed)) + " stand";
    if (!result.moved.empty()) text += ", " + std::to_string(result.moved.size()) + " moved";
    if (!result.faulty.empty()) {
        text += ", " + std::to_string(result.faulty.size()) + " with a fault beside them";
    }
    if (!result.shrunk.empty()) text += ", " + std::to_string(result.shrunk.size()) + " smaller";
    return text + ", " + std::to_string(result.refused.size()) + " places left out";
}

}  // namespace

void judge_scatter(ScatterResult& result, Index places) {
    std::vector<MergeReason> reasons;
    note_crossings(result, reasons);
    note_parts(result, reasons);
    note_left_out(result, places, reasons);
    result.ok = reasons.empty();
    result.verdict = (result.ok ? "good: " : "not good: ") + counts_text(result);
    for (const MergeReason& reason : reasons) result.verdict += "; " + reason.text;
    result.reasons = std::move(reasons);
}

}  // namespace lissom
