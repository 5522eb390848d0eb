// What a merge does last: the seams, and what runs through what.
#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "kernel/merge/blend/fair_seam.h"
#include "kernel/merge/merge_state.h"
#include "kernel/merge/sew/seam_collar.h"
#include "kernel/merge/sew/seam_guard.h"

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

// A transition that went less than this part of its way is told.
constexpr double kHardly = 0.1;

void note_refused_bands(MergeReport& now) {
    const double kept = now.transition.kept;
    if (!(kept < kHardly)) return;
    now.warnings.push_back(
        (kept > 0.0 ? "the transition went only " + short_number(100.0 * kept) + " % of its way"
                    : std::string("the transition was left out")) +
        ": more of it would have folded the surface at a seam; choose other widths, or cut where "
        "the parts are smoother");
}

// A seam whose greatest dihedral angle is above this shows.
constexpr double kVisible = 20.0 * kPi / 180.0;
// A seam without a collar must be this much better than one with it.
constexpr double kClearlyBetter = 0.9;

double greatest_angles(const SewReport& report) {
    return report.after.greatest_dihedral + report.after.greatest_near;
}

}  // namespace

SewOptions Merge::State::sewing(bool collar) const {
    SewOptions how;
    how.kind = options.seam;
    how.smooth = options.smooth;
    how.collar = collar;
    return how;
}

// With collars, and without where that hides the seam better: on sides that are folded no step
// after the collar may be possible.
Sewn Merge::State::sew_sides(const Mesh& moved, const std::vector<LoopPair>& pairs,
                             const std::optional<ThesisMerge>& thesis, MergeReport& now,
                             const Context& context) const {
    MergeReport plain_report = now;
    const auto sew_with = [&](bool collar, MergeReport& told) {
        Sewn sewn = sew(target, moved, pairs, sewing(collar), context);
        finish_seams(sewn, thesis, told, context);
        require_sound(sewn, target, moved, pairs);
        return sewn;
    };
    Sewn sewn = sew_with(options.collar && !options.thesis, now);
    const bool doubtful = now.seam.collar_added > 0 && now.seam.after.greatest_dihedral > kVisible;
    if (!doubtful) return sewn;
    Sewn plain = sew_with(false, plain_report);
    if (greatest_angles(plain_report.seam) > kClearlyBetter * greatest_angles(now.seam)) {
        return sewn;
    }
    now = std::move(plain_report);
    return plain;
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
        note_refused_bands(now);
    } else if (options.seam == SeamKind::fair) {
        fair_seam(sewn.mesh, sewn.seams, {}, context);
        flip_near_seams(sewn, context);
    }
    if (blends || options.seam == SeamKind::fair) {
        sewn.report.after = seam_quality(sewn.mesh, sewn.seams);
    }
    now.seam = sewn.report;
}

// The faces of the source, which is deformed, and those of the target that were made or moved.
std::vector<Index> Merge::State::changed_faces(const Sewn& sewn) const {
    const auto is_same = [&](Index v) {
        const auto sources = sewn.map.vertices[v];
        return sources.size() == 1 && sources.front().element < target.vertex_count() &&
               sewn.mesh.position(v) == target.position(sources.front().element);
    };
    const auto stays = [&](Index f) {
        const std::span<const Index> face = sewn.mesh.topology().face(f);
        const std::span<const Index> old = target.topology().face(sewn.map.faces.main_source(f));
        if (face.size() != old.size()) return false;
        for (std::size_t k = 0; k < face.size(); ++k) {
            if (!is_same(face[k]) || sewn.map.vertices.main_source(face[k]) != old[k]) return false;
        }
        return true;
    };
    std::vector<Index> faces;
    for (Index f = 0; f < sewn.mesh.face_count(); ++f) {
        if (sewn.side_of_face[f] == SeamSide::source || !stays(f)) faces.push_back(f);
    }
    return faces;
}

std::vector<FacePair> Merge::State::new_intersections(const Sewn& sewn,
                                                      const Context& context) const {
    std::vector<FacePair> pairs =
        self_intersections(sewn.mesh, {changed_faces(sewn), std::nullopt}, context);
    if (pairs.empty()) return pairs;
    // In the numbers of the unconnected mesh: faces of the target, then of the source.
    const Topology& old = target.topology();
    const Topology& other = source.mesh.topology();
    const auto origins = [&](Index f) {
        if (sewn.side_of_face[f] == SeamSide::target) {
            return origin_faces(old, sewn.mesh.topology(), sewn.map, f);
        }
        std::vector<Index> faces = origin_faces(other, sewn.mesh.topology(), sewn.map, f,
                                                {old.face_count(), old.corner_count()});
        for (Index& face : faces) face += old.face_count();
        return faces;
    };
    // Where two parts of the source run through one another, one that is loose moves as a whole and
    // the other bends: the line along which they cross slides over to the next faces.
    const auto part = [&](Index f) {
        return other.components()[other.face(f - old.face_count())[0]];
    };
    const auto slides = [&](Index a, Index b) {
        return a >= old.face_count() && b >= old.face_count() && part(a) != part(b);
    };
    const auto around = [&](Index f) {
        std::vector<Index> faces;
        for (const Index v : other.face(f - old.face_count())) {
            for (const Index g : other.faces_around(v)) faces.push_back(g + old.face_count());
        }
        return faces;
    };
    std::vector<Index> concerned;
    for (const FacePair& pair : pairs) {
        const std::vector<Index> first = origins(pair.first), second = origins(pair.second);
        for (const std::vector<Index>& faces : {first, second}) {
            concerned.insert(concerned.end(), faces.begin(), faces.end());
            if (!slides(first.front(), second.front())) continue;
            for (const Index f : faces) {
                const std::vector<Index> near = around(f);
                concerned.insert(concerned.end(), near.begin(), near.end());
            }
        }
    }
    const std::vector<FacePair> before = own_intersections(concerned, context);
    const auto was = [&](std::span<const Index> first, std::span<const Index> second) {
        for (const Index a : first) {
            for (const Index b : second) {
                const FacePair own{std::min(a, b), std::max(a, b)};
                if (std::binary_search(before.begin(), before.end(), own)) return true;
            }
        }
        return false;
    };
    std::erase_if(pairs, [&](const FacePair& pair) {
        const std::vector<Index> first = origins(pair.first), second = origins(pair.second);
        if (was(first, second)) return true;
        return slides(first.front(), second.front()) &&
               was(around(first.front()), around(second.front()));
    });
    return pairs;
}

// Those of the targets and of the source as they are, among the given faces: of the targets, then
// of the source.
std::vector<FacePair> Merge::State::own_intersections(const std::vector<Index>& origins,
                                                      const Context& context) const {
    std::vector<FacePair> result;
    Index shift = 0;
    for (const Mesh* mesh : {&target, &source.mesh}) {
        std::vector<Index> faces;
        for (const Index f : origins) {
            if (f >= shift && f < shift + mesh->face_count()) faces.push_back(f - shift);
        }
        std::sort(faces.begin(), faces.end());
        faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
        if (!faces.empty()) {
            for (const FacePair& pair : self_intersections(*mesh, {faces, faces}, context)) {
                result.push_back({pair.first + shift, pair.second + shift});
            }
        }
        shift += mesh->face_count();
    }
    return result;
}

}  // namespace lissom
