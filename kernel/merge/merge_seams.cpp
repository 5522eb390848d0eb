// Last steps of a merge: the seams, and self-intersections.
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>

#include "kernel/merge/blend/fair_seam.h"
#include "kernel/merge/blend/fair_spots.h"
#include "kernel/merge/blend/relax_faults.h"
#include "kernel/merge/creases.h"
#include "kernel/merge/crossings.h"
#include "kernel/merge/mend.h"
#include "kernel/merge/merge_stages.h"
#include "kernel/merge/provenance.h"
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

// If more than this part of a band lies on folds, details land in wrong places.
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
        ": more of it would have folded the surface at a seam; choose other widths, or cut at "
        "smoother places");
}

// A seam that turns by less at every edge is smooth: fairing would not improve it.
constexpr double kSmoothSeam = 5.0 * kDegree;

// A seam whose greatest dihedral angle is above this shows.
constexpr double kVisible = 20.0 * kPi / 180.0;
// In radii of a seam: creases within it are faired if they keep a place crumpled.
constexpr double kCreaseReach = 0.5;
// A seam without a collar must be this much better than one with it.
constexpr double kClearlyBetter = 0.9;

double max_angles(const SewReport& report) {
    return report.after.max_dihedral + report.after.max_near;
}

bool has_given_widths(const MergeOptions& options) {
    return !options.auto_transition &&
           (options.source_transition > 0.0 || options.target_transition > 0.0);
}

bool makes_transition(const MergeOptions& options) {
    return options.auto_transition || has_given_widths(options);
}

// The vertices that a crease of a side at rest ends at, in the numbers of both sides: those near
// the loops, which umbrella steps keep, and if bands move, those on all of the sides and in flat
// faces of the target.
struct KeptCreases {
    std::vector<Index> near, all;
};

std::vector<Index> creases_of(const Boundaries& boundaries, bool all) {
    const auto of_side = [&](const Mesh& mesh, const std::vector<std::vector<Index>>& loops) {
        std::vector<Index> asked(all ? at(mesh.vertex_count()) : 0);
        std::iota(asked.begin(), asked.end(), 0);
        return creased_vertices(mesh, all ? asked : vertices_near(mesh, loops));
    };
    std::vector<Index> creased = of_side(boundaries.target, boundaries.target_loops);
    for (const Index v : of_side(boundaries.source.mesh, boundaries.source.loops)) {
        creased.push_back(v + boundaries.target.vertex_count());
    }
    return creased;
}

// Adds the vertices of flat faces of the target to ascending ones.
void add_flat_faces(const Mesh& target, std::vector<Index>& firm) {
    std::vector<Index> all;
    const std::vector<Index> flat = flat_vertices(target);
    std::set_union(firm.begin(), firm.end(), flat.begin(), flat.end(), std::back_inserter(all));
    firm = std::move(all);
}

KeptCreases kept_creases(const Boundaries& boundaries, const MergeOptions& options) {
    if (options.thesis) return {};
    KeptCreases kept{creases_of(boundaries, false), {}};
    const bool bands = options.seam == SeamKind::fair || makes_transition(options);
    if (bands) kept.all = creases_of(boundaries, true);
    // Widths that were asked for may bend flat faces; what is chosen leaves them flat.
    if (bands && !has_given_widths(options)) add_flat_faces(boundaries.target, kept.all);
    return kept;
}

SewOptions sewing(const MergeOptions& options, const Matching& matching,
                  const std::vector<Index>& firm, bool collar) {
    SewOptions how;
    for (const auto& fit : matching.fits) how.kept.push_back(fit ? 1 : 0);
    how.firm = firm;
    how.kind = options.seam;
    how.smooth = options.smooth;
    how.collar = collar;
    how.guard = how.flip = method_of(options).guard;
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

void blend(const MergeOptions& options, const Matching& matching, const std::vector<Index>& firm,
           MergedSides& merged, const Context& context) {
    std::vector<TransitionWidths> widths = options.auto_transition
                                               ? suitable_widths(merged.sewn, context)
                                               : asked_widths(options, matching.joins);
    for (std::size_t k = 0; k < widths.size(); ++k) {
        if (matching.joins[k].fits) widths[k] = {0.0, 0.0};
    }
    TransitionOptions how;
    how.firm = became_of(merged.sewn, firm);
    merged.transition = blend_transition(merged.sewn, widths, how, context);
    for (std::size_t k = 0; k < widths.size(); ++k) {
        note_narrow_band(k, "source", widths[k].source, merged.transition.source[k].width,
                         merged.warnings);
        note_narrow_band(k, "target", widths[k].target, merged.transition.target[k].width,
                         merged.warnings);
    }
    // A band that was left out cannot have folded.
    for (std::size_t k = 0; merged.transition.kept > 0.0 && k < widths.size(); ++k) {
        note_folded_band(k, "source", merged.transition.source[k], merged.warnings);
        note_folded_band(k, "target", merged.transition.target[k], merged.warnings);
    }
    note_refused_bands(merged.transition.kept, merged.warnings);
}

void finish_seams(const MergeOptions& options, const Matching& matching,
                  const DeformedSource& moved, const std::vector<Index>& firm, MergedSides& merged,
                  const Context& context) {
    const bool blends = makes_transition(options);
    Sewn& sewn = merged.sewn;
    const std::vector<std::vector<Index>> worked = worked_seams(sewn);
    if (worked.empty()) {
        merged.transition.target.resize(blends ? sewn.seams.size() : 0);
        merged.transition.source = merged.transition.target;
        return;
    }
    if (moved.overlap) {
        merged.transition = moved.overlap->reconstruct(sewn, context);
    } else if (blends) {
        blend(options, matching, firm, merged, context);
    } else if (options.seam == SeamKind::fair && sewn.report.after.max_dihedral > kSmoothSeam) {
        SeamFairing how;
        how.firm = became_of(sewn, firm);
        fair_seam(sewn.mesh, worked, how, context);
        flip_near_seams(sewn, context);
    }
    if (blends || options.seam == SeamKind::fair) {
        sewn.report.after = seam_quality(sewn.mesh, sewn.seams);
    }
}

// Sews with collars, and without if that hides the seam better: no step after the collar may be
// possible on folded sides.
MergedSides sew_well(const Boundaries& boundaries, const MergeOptions& options,
                     const Matching& matching, const DeformedSource& moved,
                     const Context& context) {
    const Mesh& target = boundaries.target;
    const KeptCreases firm = kept_creases(boundaries, options);
    const auto sew_with = [&](bool collar) {
        MergedSides merged;
        merged.sewn = sew(target, moved.source, matching.pairs,
                          sewing(options, matching, firm.near, collar), context);
        finish_seams(options, matching, moved, firm.all, merged, context);
        require_sound(merged.sewn, target, moved.source, matching.pairs);
        return merged;
    };
    MergedSides merged = sew_with(options.collar);
    const SewReport& report = merged.sewn.report;
    if (!(report.collar_added > 0 && report.after.max_dihedral > kVisible)) return merged;
    MergedSides plain = sew_with(false);
    const bool better = max_angles(plain.sewn.report) <= kClearlyBetter * max_angles(report);
    return better ? std::move(plain) : std::move(merged);
}

void find_crossings(const Boundaries& boundaries, MergedSides& merged, const Context& context) {
    Crossings found =
        new_crossings(boundaries.target, boundaries.source.mesh, merged.sewn, context);
    merged.intersections = std::move(found.pairs);
    merged.known_intersections = found.known;
}

}  // namespace

MergedSides sew_sides(const Boundaries& boundaries, const MergeOptions& options,
                      const Matching& matching, const DeformedSource& moved,
                      const Context& context) {
    MergedSides merged = sew_well(boundaries, options, matching, moved, context);
    if (options.find_intersections) find_crossings(boundaries, merged, context);
    return merged;
}

bool relax_sides(const Boundaries& boundaries, const MergeOptions& options,
                 const MergeReport& report, Index rings, MergedSides& merged,
                 const Context& context) {
    const std::vector<Index> firm = became_of(merged.sewn, creases_of(boundaries, true));
    const std::vector<Index> crossing = showing_faces(report.crossings);
    const std::vector<Vec3> rest =
        places_on_second(merged.sewn.map, boundaries.source.mesh, boundaries.target.vertex_count());
    if (!relax_faults(merged.sewn, {crossing, firm, rest}, rings, context)) return false;
    if (options.find_intersections) find_crossings(boundaries, merged, context);
    return true;
}

bool fair_sides(const Boundaries& boundaries, const MergeOptions& options, const SpotWay& way,
                MergedSides& merged, const Context& context) {
    const std::vector<Vec3> source =
        places_on_second(merged.sewn.map, boundaries.source.mesh, boundaries.target.vertex_count());
    const std::vector<Vec3> target = places_on_first(merged.sewn.map, boundaries.target);
    std::vector<Index> firm = creases_of(boundaries, true);
    const Index of_target = boundaries.target.vertex_count();
    if (!way.creases) std::erase_if(firm, [&](Index v) { return v >= of_target; });
    add_flat_faces(boundaries.target, firm);
    firm = became_of(merged.sewn, firm);
    SpotFairing how{source, target, std::move(firm), way.rings};
    // Farther creases are the shape of the source, such as a muzzle above a neck.
    if (!way.creases) how.reach = kCreaseReach;
    if (!fair_spots(merged.sewn, how, context)) return false;
    if (options.find_intersections) find_crossings(boundaries, merged, context);
    return true;
}

}  // namespace lissom
