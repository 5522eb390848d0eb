#include "kernel/merge/paste/part_trial.h"

#include <utility>
#include <vector>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// The thesis scales Laplacian coordinates by one factor, that of the boundary (section 3.4.4).
BoundaryDeformOptions paste_deformation(bool thesis) {
    if (!thesis) return {};
    BoundaryDeformOptions options = BoundaryDeformOptions::thesis();
    options.size = SizeField::harmonic;
    return options;
}

}  // namespace

void PartTrials::move(PartTrial& trial, const Context& context) const {
    const double crease = options.thesis ? 0.0 : options.crease;
    const std::vector<BoundaryValue> values =
        paste_values(trial.rim, trial.similarity, trial.scale, crease);
    trial.moved = trial.moving->moved(values, context);
    trial.near = near_distortion(trial.part(), trial.moved.mesh, trial.scale);
}

PartTrial PartTrials::trial_of(std::shared_ptr<MovingPart> part, const PasteSimilarity& similarity,
                               const Context& context) const {
    PartTrial trial{std::move(part), {}, similarity, 1.0, false, false, {}, {}};
    trial.scale = lock_scale ? placed.placement.scale : similarity.scale;
    trial.rim = rim_of(trial.part(), surface);
    move(trial, context);
    return trial;
}

std::shared_ptr<MovingPart> PartTrials::inside(MovingParts::Boundary kind,
                                               std::span<const Index> loop,
                                               const Context& context) const {
    const Mesh& source = surface.map().source_mesh();
    return parts.inside(
        kind, loop, [&] { return part_inside(source, regions, loop, context); },
        paste_deformation(options.thesis), context);
}

PartTrial PartTrials::along_loop(const Context& context) const {
    return trial_of(inside(MovingParts::Boundary::loop, placed.loop.vertices, context),
                    placed.loop.similarity, context);
}

std::optional<PartTrial> PartTrials::along_line(const Context& context) const {
    if (!placed.line) return std::nullopt;
    std::vector<Vec2> line;
    for (const RingPoint& point : placed.line->points) line.push_back(point.uv);
    try {
        const auto make = [&] {
            return part_inside(surface.map().source_mesh(), regions, surface.map().source(), line,
                               context);
        };
        PartTrial trial =
            trial_of(parts.inside(line, make, paste_deformation(options.thesis), context),
                     placed.line->similarity, context);
        trial.smooth = true;
        return trial;
    } catch (const Error& error) {
        if (error.code() != ErrorCode::boundary_conflict) throw;
        return std::nullopt;
    }
}

PartTrial PartTrials::along_outline(const Context& context) const {
    PasteEnergy energy(ring_edges(surface.map(), ring, surface.images()), energy_for(options, 1));
    const std::vector<Index> edges = energy.edges_of(ring, regions.outer);
    const PasteSimilarity start = energy.start(edges);
    PartTrial trial = trial_of(inside(MovingParts::Boundary::outline, regions.outer, context),
                               energy.improved(edges, start), context);
    trial.outline = true;
    return trial;
}

}  // namespace lissom
