// What a merge does last: the seams, and what runs through what.
#include <algorithm>
#include <cstdio>
#include <set>
#include <string>
#include <utility>

#include "kernel/merge/blend/fair_seam.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/merge_stages.h"
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

// One side of a transition.
void note_narrow_band(std::size_t seam, const char* side, double width, double used,
                      std::vector<std::string>& warnings) {
    if (!(used < kNarrow * width)) return;
    warnings.push_back("join " + std::to_string(seam + 1) + ": the transition on the " + side +
                       " is " + short_number(used) + " wide in place of " + short_number(width) +
                       ", in the unit of the target: the surface has no room for more");
}

// Where more than this part of a band lies on folds, details land in wrong places.
constexpr double kFolded = 0.05;

// One side of a transition.
void note_folded_band(std::size_t seam, const char* side, const TransitionBand& band,
                      std::vector<std::string>& warnings) {
    if (!(band.flipped > kFolded * band.vertices)) return;
    warnings.push_back("join " + std::to_string(seam + 1) +
                       ": the surface beside the seam on the " + side + " is folded, at " +
                       std::to_string(band.flipped) +
                       " triangles of the transition, which may show as pits; look there, choose "
                       "a width for one side only, or the seam \"fair\" without a transition");
}

// A transition that went less than this part of its way is told: the first halving is no fault.
constexpr double kHardly = 0.4;

void note_refused_bands(double kept, std::vector<std::string>& warnings) {
    if (!(kept < kHardly)) return;
    warnings.push_back(
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

// An edge that the surface turns at by more than this is a crease.
constexpr double kCrease = 30.0 * kDegree;

// The vertices on the loops and next to them that a crease of a side at rest ends at, in the
// numbers of both sides.
std::vector<Index> creased_vertices(const Boundaries& boundaries) {
    std::set<Index> creased;
    const auto add = [&](const Mesh& mesh, const std::vector<std::vector<Index>>& loops,
                         Index shift) {
        const auto look_at = [&](Index v) {
            for (const Index w : mesh.topology().neighbors(v)) {
                if (edge_dihedral(mesh, v, w) > kCrease) creased.insert(v + shift);
            }
        };
        for (const std::vector<Index>& loop : loops) {
            for (const Index v : loop) {
                look_at(v);
                for (const Index w : mesh.topology().neighbors(v)) look_at(w);
            }
        }
    };
    add(boundaries.target, boundaries.target_loops, 0);
    add(boundaries.source.mesh, boundaries.source.loops, boundaries.target.vertex_count());
    return {creased.begin(), creased.end()};
}

SewOptions sewing(const MergePreparation& preparation, const Matching& matching, bool collar) {
    const MergeOptions& options = preparation.options;
    SewOptions how;
    for (const auto& fit : matching.fits) how.kept.push_back(fit ? 1 : 0);
    if (!options.thesis) how.firm = creased_vertices(preparation.boundaries);
    how.kind = options.seam;
    how.smooth = options.smooth;
    how.collar = collar;
    how.guard = how.flip = preparation.method.guard;
    return how;
}

std::vector<TransitionWidths> asked_widths(const MergeOptions& options,
                                           std::span<const JoinReport> joins) {
    std::vector<TransitionWidths> widths;
    for (const JoinReport& join : joins) {
        widths.push_back({options.target_transition, options.source_transition * join.scale});
    }
    return widths;
}

void blend(const MergeOptions& options, const Matching& matching, MergedSides& merged,
           const Context& context) {
    std::vector<TransitionWidths> widths = options.suit_transition
                                               ? suitable_widths(merged.sewn, context)
                                               : asked_widths(options, matching.joins);
    for (std::size_t k = 0; k < widths.size(); ++k) {
        if (matching.joins[k].fits) widths[k] = {0.0, 0.0};
    }
    merged.transition = blend_transition(merged.sewn, widths, {}, context);
    for (std::size_t k = 0; k < widths.size(); ++k) {
        note_narrow_band(k, "source", widths[k].source, merged.transition.source[k].width,
                         merged.warnings);
        note_narrow_band(k, "target", widths[k].target, merged.transition.target[k].width,
                         merged.warnings);
    }
    for (std::size_t k = 0; k < widths.size(); ++k) {
        note_folded_band(k, "source", merged.transition.source[k], merged.warnings);
        note_folded_band(k, "target", merged.transition.target[k], merged.warnings);
    }
    note_refused_bands(merged.transition.kept, merged.warnings);
}

void finish_seams(const MergeOptions& options, const Matching& matching, const Moved& moved,
                  MergedSides& merged, const Context& context) {
    const bool blends = options.suit_transition || options.source_transition > 0.0 ||
                        options.target_transition > 0.0;
    Sewn& sewn = merged.sewn;
    const std::vector<std::vector<Index>> worked = worked_seams(sewn);
    if (worked.empty()) {
        merged.transition.target.resize(blends ? sewn.seams.size() : 0);
        merged.transition.source = merged.transition.target;
        return;
    }
    if (moved.thesis) {
        merged.transition = moved.thesis->reconstruct(sewn, context);
    } else if (blends) {
        blend(options, matching, merged, context);
    } else if (options.seam == SeamKind::fair) {
        fair_seam(sewn.mesh, worked, {}, context);
        flip_near_seams(sewn, context);
    }
    if (blends || options.seam == SeamKind::fair) {
        sewn.report.after = seam_quality(sewn.mesh, sewn.seams);
    }
}

// With collars, and without where that hides the seam better: on sides that are folded no step
// after the collar may be possible.
MergedSides sew_well(const MergePreparation& preparation, const Matching& matching,
                     const Moved& moved, const Context& context) {
    const MergeOptions& options = preparation.options;
    const Mesh& target = preparation.boundaries.target;
    const auto sew_with = [&](bool collar) {
        MergedSides merged;
        merged.sewn = sew(target, moved.source, matching.pairs,
                          sewing(preparation, matching, collar), context);
        finish_seams(options, matching, moved, merged, context);
        require_sound(merged.sewn, target, moved.source, matching.pairs);
        return merged;
    };
    MergedSides merged = sew_with(options.collar);
    const SewReport& report = merged.sewn.report;
    if (!(report.collar_added > 0 && report.after.greatest_dihedral > kVisible)) return merged;
    MergedSides plain = sew_with(false);
    const bool better =
        greatest_angles(plain.sewn.report) <= kClearlyBetter * greatest_angles(report);
    return better ? std::move(plain) : std::move(merged);
}

// The faces of the source, which is deformed, and those of the target that were made or moved.
std::vector<Index> changed_faces(const Mesh& target, const Sewn& sewn) {
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

// Those of the targets and of the source as they are, among the given faces: of the targets, then
// of the source.
std::vector<FacePair> own_intersections(const Mesh& target, const Mesh& source,
                                        const std::vector<Index>& origins, const Context& context) {
    std::vector<FacePair> result;
    Index shift = 0;
    for (const Mesh* mesh : {&target, &source}) {
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

}  // namespace

std::vector<FacePair> new_intersections(const Mesh& target, const Mesh& source, const Sewn& sewn,
                                        const Context& context) {
    std::vector<FacePair> pairs =
        self_intersections(sewn.mesh, {changed_faces(target, sewn), std::nullopt}, context);
    if (pairs.empty()) return pairs;
    // In the numbers of the unconnected mesh: faces of the target, then of the source.
    const Topology& old = target.topology();
    const Topology& other = source.topology();
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
    const std::vector<FacePair> before = own_intersections(target, source, concerned, context);
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

MergedSides sew_sides(const MergePreparation& preparation, const Matching& matching,
                      const Moved& moved, const Context& context) {
    MergedSides merged = sew_well(preparation, matching, moved, context);
    if (!preparation.options.find_intersections) return merged;
    merged.intersections = new_intersections(
        preparation.boundaries.target, preparation.boundaries.source.mesh, merged.sewn, context);
    if (!merged.intersections.empty()) {
        merged.warnings.push_back(std::to_string(merged.intersections.size()) +
                                  " pairs of faces run through one another that did not "
                                  "before; see the report's intersections");
    }
    return merged;
}

}  // namespace lissom
