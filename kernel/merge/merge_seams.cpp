// What a merge does last: the seams, and what runs through what.
#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "kernel/merge/blend/fair_seam.h"
#include "kernel/merge/merge_state.h"

namespace lissom {
namespace {

// A band narrower than this part of the width asked for is told.
constexpr double kNarrow = 0.95;

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

void note_narrow_bands(std::span<const TransitionWidths> asked, MergeReport& now) {
    const auto note = [&](std::size_t seam, const char* side, double width, double used) {
        if (!(used < kNarrow * width)) return;
        now.warnings.push_back("join " + std::to_string(seam + 1) + ": the transition on the " +
                               side + " is " + short_number(used) + " wide in place of " +
                               short_number(width) +
                               ", in the unit of the target: the surface "
                               "has no room for more");
    };
    for (std::size_t k = 0; k < asked.size(); ++k) {
        note(k, "source", asked[k].source, now.transition.source[k].width);
        note(k, "target", asked[k].target, now.transition.target[k].width);
    }
}

}  // namespace

SewOptions Merge::State::sewing() const {
    SewOptions how;
    how.kind = options.seam;
    how.smooth = options.smooth;
    return how;
}

std::vector<TransitionWidths> Merge::State::asked_widths(const MergeReport& now) const {
    std::vector<TransitionWidths> widths;
    for (const JoinReport& join : now.joins) {
        widths.push_back({options.target_transition, options.source_transition * join.scale});
    }
    return widths;
}

void Merge::State::finish_seams(Sewn& sewn, const std::optional<ThesisMerge>& thesis,
                                MergeReport& now, const Context& context) const {
    const bool blends = options.suit_transition || options.source_transition > 0.0 ||
                        options.target_transition > 0.0;
    if (thesis) {
        now.transition = thesis->reconstruct(sewn, context);
    } else if (blends) {
        const std::vector<TransitionWidths> widths =
            options.suit_transition ? suitable_widths(sewn, context) : asked_widths(now);
        now.transition = blend_transition(sewn, widths, {}, context);
        note_narrow_bands(widths, now);
    } else if (options.seam == SeamKind::fair) {
        fair_seam(sewn.mesh, sewn.seams, {}, context);
    }
    if (blends || options.seam == SeamKind::fair) {
        sewn.report.after = seam_quality(sewn.mesh, sewn.seams);
    }
    now.seam = sewn.report;
}

std::vector<FacePair> Merge::State::new_intersections(const Sewn& sewn,
                                                      const Context& context) const {
    std::vector<Index> faces;
    for (Index f = 0; f < sewn.mesh.face_count(); ++f) {
        if (sewn.side_of_face[f] == SeamSide::source) faces.push_back(f);
    }
    std::vector<FacePair> pairs = self_intersections(sewn.mesh, {std::move(faces)}, context);
    const std::vector<FacePair> before = own_intersections(sewn, pairs, context);
    std::erase_if(pairs, [&](const FacePair& pair) {
        return std::binary_search(before.begin(), before.end(), origin_of(sewn, pair));
    });
    return pairs;
}

// The faces of the source that two of the result come from; negative for one of the target.
FacePair Merge::State::origin_of(const Sewn& sewn, const FacePair& pair) const {
    const Index a = sewn.map.faces.main_source(pair.first) - target.face_count();
    const Index b = sewn.map.faces.main_source(pair.second) - target.face_count();
    return {std::min(a, b), std::max(a, b)};
}

// Those of the source as it is among the faces that `pairs` come from.
std::vector<FacePair> Merge::State::own_intersections(const Sewn& sewn,
                                                      const std::vector<FacePair>& pairs,
                                                      const Context& context) const {
    std::vector<Index> faces;
    for (const FacePair& pair : pairs) {
        const FacePair origin = origin_of(sewn, pair);
        if (origin.first < 0) continue;
        faces.push_back(origin.first);
        faces.push_back(origin.second);
    }
    if (faces.empty()) return {};
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return self_intersections(source.mesh, {faces, faces}, context);
}

}  // namespace lissom
