// The last step of a paste: the part is deformed, the target opened, and both are sewn.
#include <optional>
#include <utility>

#include "kernel/core/clock.h"
#include "kernel/core/memory_error.h"
#include "kernel/merge/merge_stages.h"
#include "kernel/merge/paste/part/opened_target.h"
#include "kernel/merge/paste/part/paste_part.h"
#include "kernel/merge/paste/part/target_piece.h"
#include "kernel/merge/paste/part_trial.h"
#include "kernel/merge/paste/paste_state.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/merge/verdict.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

// A seam without a collar must be this much better than one with it.
constexpr double kPlainBetter = 0.9;
constexpr double kSteepSeam = 20.0 * kDegree;
// A boundary whose seam turns by more than this gives way to the loop of edges.
constexpr double kFoldedSeam = 90.0 * kDegree;

struct PasteSides {
    PartTrial source;
    const TargetPiece* piece = nullptr;
    OpenedTarget opened;
    LoopPair pair;
};

// The part comes to lie on the boundary as it was cut.
void lay_on_hole(const PartTrials& trials, PasteSides& sides, const Context& context) {
    const Loop hole(sides.opened.mesh, sides.opened.loop);
    const std::size_t n = sides.source.rim.size();
    for (std::size_t k = 0; k < n; ++k) {
        sides.source.rim[k].image.position =
            point_of(hole.points(), sides.pair.on_target[n - 1 - k]);
    }
    trials.move(sides.source, context);
}

Sewn sewn_with(const PasteSides& sides, const PasteMergeOptions& options, bool collar,
               const Context& context) {
    SewOptions how;
    how.smooth = options.draft ? 0 : options.smooth;
    how.collar = collar;
    how.flip = !options.draft;
    const LoopPair pairs[] = {sides.pair};
    return sew(sides.opened.mesh, sides.source.moved.mesh, pairs, how, context);
}

Sewn sewn_well(const PasteSides& sides, const PasteMergeOptions& options, const Context& context) {
    const auto angles = [](const Sewn& sewn) {
        return sewn.report.after.greatest_dihedral + sewn.report.after.greatest_near;
    };
    Sewn sewn = sewn_with(sides, options, options.collar && !options.draft, context);
    if (!(sewn.report.collar_added > 0 && sewn.report.after.greatest_dihedral > kSteepSeam)) {
        return sewn;
    }
    Sewn plain = sewn_with(sides, options, false, context);
    return angles(plain) <= kPlainBetter * angles(sewn) ? std::move(plain) : std::move(sewn);
}

double turns(const Sewn& sewn) {
    return sewn.report.after.greatest_dihedral;
}
// Whether a seam is so steep that its faces turn over.
bool folds(const Sewn& sewn) {
    return turns(sewn) > kFoldedSeam;
}

struct SewnSides {
    PasteSides sides;
    Sewn sewn;
    /// Near the boundary before it was laid on the hole.
    PasteDistortion near;
};

SewnSides sewn_along(const PartTrials& trials, const TargetPiece& target, PartTrial trial,
                     const PasteMergeOptions& options, const Context& context) {
    SewnSides result;
    PasteSides& sides = result.sides;
    sides.piece = &target;
    sides.source = std::move(trial);
    result.near = sides.source.near;
    std::vector<Vec2> outline;
    for (const RingPoint& point : sides.source.rim) outline.push_back(point.image.uv);
    sides.opened = open_target(target.mesh(), target.chart_vertices(),
                               trials.surface.map().target().map.uv, outline, context);
    sides.pair = paste_pair(sides.source.part(), sides.opened, sides.source.rim);
    lay_on_hole(trials, sides, context);
    result.sewn = sewn_well(sides, options, context);
    return result;
}

// `sewn` is that of the whole target.
MergeReport merge_report(const PasteSides& sides, const Sewn& sewn,
                         const PasteMergeOptions& options, const Context& context) {
    MergeReport report;
    const std::vector<Index> loops[] = {sides.source.part().loop, sides.opened.loop};
    report.source_rim = seam_quality(sides.source.part().mesh, {&loops[0], 1});
    report.target_rim = seam_quality(sides.opened.mesh, {&loops[1], 1});
    JoinReport join;
    join.source_size = count_of(sides.source.part().loop);
    join.target_size = count_of(sides.opened.loop);
    join.scale = sides.source.scale;
    report.joins.push_back(join);
    report.deform = sides.source.moved.stats;
    report.seam = sewn.report;
    const bool sought = options.find_intersections && !options.draft;
    if (sought) {
        report.intersections =
            new_intersections(sides.piece->target(), sides.source.part().mesh, sewn, context);
    }
    const Verdict verdict = verdict_of(report, sought);
    report.ok = verdict.good;
    report.verdict = verdict.text;
    return report;
}

// The outline where the maps alone put it.
PartTrial outline_trial(const PartTrials& trials, const Context& context) {
    const RingSurface mapped(trials.surface.map(), trials.surface.ring(), trials.placed.mapped);
    PartTrials marked{trials.options,    trials.regions, mapped,
                      trials.ring,       trials.placed,  trials.parts,
                      trials.lock_scale, trials.refines, trials.settles};
    return marked.along_outline(context);
}

// The best boundary: the one that was found, unless the outline distorts less.
PartTrial best_trial(const PartTrials& trials, bool compare, bool covered, PasteReport& report,
                     const Context& context) {
    std::optional<PartTrial> found = trials.along_line(context);
    PartTrial best = found ? std::move(*found) : trials.along_loop(context);
    if (!compare || !covered) return best;
    PartTrial outline = outline_trial(trials, context);
    report.outline_near = outline.plain;
    return outline.near.energy < best.near.energy ? std::move(outline) : std::move(best);
}

// Where the seam turns faces over, along edges or the outline: what turns least, and is distorted
// no more than the outline.
void unfold(const PartTrials& trials, const TargetPiece& target, const PasteReport& report,
            const PasteMergeOptions& options, SewnSides& whole, const Context& context) {
    const auto attempt = [&](PartTrial trial) {
        if (report.outline_near && trial.near.energy > report.outline_near->energy) return;
        SewnSides next = sewn_along(trials, target, std::move(trial), options, context);
        if (turns(next.sewn) < turns(whole.sewn)) whole = std::move(next);
    };
    if (folds(whole.sewn)) attempt(trials.along_loop(context));
    if (folds(whole.sewn) && report.outline_near) attempt(outline_trial(trials, context));
}

// The part on a piece of the target, along the boundary that folds least.
SewnSides sewn_onto(const PartTrials& trials, const TargetPiece& target, bool covered,
                    PasteReport& report, const PasteMergeOptions& options, const Context& context) {
    PartTrial best = best_trial(trials, options.compare, covered, report, context);
    SewnSides result = sewn_along(trials, target, std::move(best), options, context);
    if (!options.draft) unfold(trials, target, report, options, result, context);
    return result;
}

}  // namespace

PasteResult Paste::merge(const PasteMergeOptions& options, const Context& context) try {
    State& state = *state_;
    Progress progress(context, "paste");
    const auto start = Clock::now();
    const PlacedFeature& placed = state.placed;
    const RingSurface surface(*state.map, *state.triangles, placed.images);
    const bool refines = options.compare && !state.options.thesis && !options.draft;
    const bool settles =
        refines && state.optimized && state.options.correspondence == PasteCorrespondence::closest;
    const PartTrials trials{state.options, state.regions,      surface, *state.ring, placed,
                            state.parts,   options.lock_scale, refines, settles};
    PasteReport report;
    report.search = placed.loop.report;
    report.source_map = state.source_map.quality();
    report.target_map = state.map->target().quality();
    report.angle = placed.angle;
    report.angle_chosen = placed.angle_chosen;
    report.draft = options.draft;
    const bool covered = state.covers(placed);
    progress.step(0.6);
    const TargetPiece& piece = state.target_piece(context);
    SewnSides pasted = sewn_onto(trials, piece, covered, report, options, context);
    progress.step(0.4);
    const PasteOrigins origins{state.cleared ? &*state.cleared : nullptr,
                               (state.cleared ? state.given : state.target).topology(),
                               !options.draft, options.find_intersections && !options.draft};
    const auto put_back = [&](const TargetPiece& onto) {
        return onto.put_back(pasted.sides.opened, pasted.sides.source.part(),
                             std::move(pasted.sewn), origins, context);
    };
    std::optional<PastedOn> made = put_back(piece);
    const TargetPiece whole = TargetPiece::whole(state.target, state.map->target());
    if (!made) {
        pasted = sewn_onto(trials, whole, covered, report, options, context);
        made = put_back(whole);
    }
    const PasteSides& sides = pasted.sides;
    Sewn& sewn = made->sewn;
    report.scale = sides.source.scale;
    report.smooth = sides.source.smooth;
    report.kept_outline = sides.source.outline;
    report.near = pasted.near;
    report.laid = sides.source.near;
    report.feature = feature_distortion(sides.source.part(), sides.source.moved.mesh, report.scale,
                                        state.regions.feature);
    PasteResult result{{}, std::move(report)};
    result.merged.report = merge_report(sides, sewn, options, context);
    result.merged.report.solve_seconds = seconds_since(start);
    result.merged.provenance = std::move(made->provenance);
    result.report.euler_characteristic = euler_characteristic(sewn.mesh.topology());
    result.report.expected_characteristic =
        euler_characteristic(state.target.topology()) +
        euler_characteristic(sides.source.part().mesh.topology()) - 1;
    result.merged.mesh = std::move(sewn.mesh);
    result.merged.side_of_face = std::move(sewn.side_of_face);
    result.merged.seams = std::move(sewn.seams);
    return result;
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

}  // namespace lissom
