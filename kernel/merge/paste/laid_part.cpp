#include "kernel/merge/paste/laid_part.h"

#include <utility>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/merge/sew/seam_loop.h"
#include "kernel/merge/sew/sew.h"

namespace lissom {
namespace {

void lay_on_hole(const PartTrials& trials, LaidPart& laid, const Context& context) {
    const Loop hole(laid.opened.mesh, laid.opened.loop);
    const std::size_t n = laid.trial.rim.size();
    for (std::size_t k = 0; k < n; ++k) {
        laid.trial.rim[k].image.position = point_of(hole.points(), laid.pair.on_target[n - 1 - k]);
    }
    trials.move(laid.trial, context);
}

}  // namespace

namespace {

// Calls `use` with trials whose ring the maps alone place.
template <typename Use>
auto as_mapped(const PartTrials& trials, const Use& use) {
    const RingSurface mapped(trials.surface.map(), trials.surface.ring(), trials.placed.mapped);
    const PartTrials marked{trials.options,    trials.regions, mapped,
                            trials.ring,       trials.placed,  trials.parts,
                            trials.lock_scale, trials.refines, trials.settles};
    return use(marked);
}

// The outline without teeth, if that distorts the part no more.
PartTrial smooth_or(const PartTrials& trials, PartTrial outline, const Context& context) {
    if (trials.options.thesis || trials.options.loop == PasteBoundary::mesh) return outline;
    std::optional<PartTrial> smooth = as_mapped(
        trials, [&](const PartTrials& mapped) { return mapped.along_smooth_outline(context); });
    const bool good = smooth && smooth->near.energy <= outline.plain.energy;
    return good ? std::move(*smooth) : std::move(outline);
}

}  // namespace

PartTrial outline_trial(const PartTrials& trials, const Context& context) {
    return as_mapped(trials,
                     [&](const PartTrials& mapped) { return mapped.along_outline(context); });
}

PartTrial tight_trial(const PartTrials& trials, const Context& context) {
    return as_mapped(trials, [&](const PartTrials& mapped) {
        std::optional<PartTrial> smooth;
        const bool edges = mapped.options.thesis || mapped.options.loop == PasteBoundary::mesh;
        if (!edges) smooth = mapped.along_smooth_inner(context);
        return smooth ? *std::move(smooth) : mapped.along_inner(context);
    });
}

BestTrial best_trial(const PartTrials& trials, bool with_outline, const Context& context) {
    std::optional<PartTrial> found = trials.along_line(context);
    PartTrial best = found ? std::move(*found) : trials.along_loop(context);
    if (!with_outline) return {std::move(best), std::nullopt};
    PartTrial outline = outline_trial(trials, context);
    const PasteDistortion near = outline.plain;
    const bool less = outline.near.energy < best.near.energy;
    return {less ? smooth_or(trials, std::move(outline), context) : std::move(best), near};
}

LaidPart laid_part(const PartTrials& trials, const Mesh& ground,
                   std::span<const Index> chart_vertices, PartTrial trial, const Context& context) {
    std::vector<Vec2> outline;
    for (const RingPoint& point : trial.rim) outline.push_back(point.image.uv);
    LaidPart laid;
    laid.near = trial.near;
    laid.trial = std::move(trial);
    laid.opened =
        open_target(ground, chart_vertices, trials.surface.map().target().map.uv, outline, context);
    laid.pair = paste_pair(laid.trial.part(), laid.opened, laid.trial.rim);
    lay_on_hole(trials, laid, context);
    return laid;
}

Mesh part_at_seam(const LaidPart& laid) {
    std::vector<Vec3> hole;
    for (const Index v : laid.opened.loop) hole.push_back(laid.opened.mesh.position(v));
    std::vector<SeamVertex> seam = seam_loop(laid.pair);
    snap(seam, hole, SewOptions().snap);
    Mesh part = laid.trial.moved.mesh;
    const std::span<Vec3> positions = part.edit_positions();
    for (const SeamVertex& vertex : seam) {
        if (!vertex.of_source) continue;
        const Index v = laid.pair.source[at(vertex.on_source.segment)];
        positions[at(v)] = seam_point(hole, vertex);
    }
    return part;
}

}  // namespace lissom
