#include "kernel/merge/paste/part_trial.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/merge/blend/overlap_transition.h"
#include "kernel/merge/loop/band_quality.h"
#include "kernel/merge/paste/part/draped_part.h"
#include "kernel/merge/paste/placement/plane_line.h"

namespace lissom {
namespace {

// ARAP iterations of a part, and times that its boundary slides, at most.
constexpr int kPartRefinements = 20;
constexpr int kSettlingRounds = 12;
// Least part of the way that a boundary slides if all of it does not serve.
constexpr double kMinSlide = 0.25;
// A part stands out where it is this high over its boundary, in radii of that.
constexpr double kFoot = 0.02;

// The thesis scales Laplacian coordinates by one factor, that of the boundary (section 3.4.4).
BoundaryDeformOptions paste_deformation(const ThesisFormulas* thesis) {
    if (!thesis) return {};
    BoundaryDeformOptions options = thesis->deform;
    options.size = SizeField::harmonic;
    return options;
}

// The greatest value of each vertex and its neighbours.
std::vector<double> max_around(const Topology& topology, const std::vector<double>& values) {
    std::vector<double> result = values;
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        for (const Index n : topology.neighbors(v)) {
            result[at(v)] = std::max(result[at(v)], values[at(n)]);
        }
    }
    return result;
}

}  // namespace

PasteDistortion PartTrials::move(PartTrial& trial, const Context& context) const {
    if (trial.draped) return drape(trial, context);
    const double crease = options.thesis ? 0.0 : options.crease;
    const std::vector<BoundaryValue> values =
        paste_values(trial.rim, trial.similarity, trial.scale, crease);
    trial.moved = trial.moving->moved(values, context);
    const PasteDistortion plain = near_distortion(trial.part(), trial.moved.mesh, trial.scale);
    trial.near = plain;
    if (!refines) return plain;
    MovedPart refined = trial.moving->refined(kPartRefinements, context);
    const PasteDistortion near = near_distortion(trial.part(), refined.mesh, trial.scale);
    if (near.energy < plain.energy) {
        trial.moved = std::move(refined);
        trial.near = near;
    }
    return plain;
}

PasteDistortion PartTrials::drape(PartTrial& trial, const Context& context) const {
    std::vector<Vec3> images;
    for (const RingPoint& point : trial.rim) images.push_back(point.image.position);
    const auto ground = [&](const Vec3& point, const Vec3& axis) -> std::optional<Vec3> {
        const std::optional<ImagePoint> found = surface.map().along(point, axis, point);
        return found ? std::optional<Vec3>(found->position) : std::nullopt;
    };
    trial.moved = Drape(trial.part(), images, trial.similarity, trial.scale, ground).moved(context);
    trial.near = near_distortion(trial.part(), trial.moved.mesh, trial.scale);
    return trial.near;
}

// False if the boundary would cross itself or the part be distorted more.
bool PartTrials::slide(PartTrial& trial, double part, const Context& context) const {
    PartTrial next = trial;
    std::vector<Vec2> outline;
    for (std::size_t k = 0; k < next.rim.size(); ++k) {
        ImagePoint& image = next.rim[k].image;
        image = surface.map().nearest(image.position + part * trial.moved.pulls[k]);
        outline.push_back(image.uv);
    }
    if (crosses_itself(outline)) return false;
    move(next, context);
    if (!(next.near.energy < trial.near.energy)) return false;
    trial = std::move(next);
    return true;
}

void PartTrials::settle(PartTrial& trial, const Context& context) const {
    double part = 1.0;
    for (int round = 0; round < kSettlingRounds && part >= kMinSlide; ++round) {
        context.checkpoint();
        if (!slide(trial, part, context)) part *= 0.5;
    }
}

PartTrial PartTrials::trial_of(std::shared_ptr<MovingPart> part, const PasteSimilarity& similarity,
                               const Context& context) const {
    PartTrial trial;
    trial.moving = std::move(part);
    trial.similarity = similarity;
    trial.scale = lock_scale ? placed.placement.scale : similarity.scale;
    trial.rim = rim_of(trial.part(), surface);
    trial.plain = move(trial, context);
    if (settles) settle(trial, context);
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
    return along(MovingParts::Boundary::line, *placed.line, context);
}

std::optional<PartTrial> PartTrials::along(MovingParts::Boundary kind, const FreeLoop& free,
                                           const Context& context) const {
    std::vector<Vec2> line;
    for (const RingPoint& point : free.points) line.push_back(point.uv);
    try {
        const auto make = [&] {
            return part_inside(surface.map().source_mesh(), regions, surface.map().source(), line,
                               context);
        };
        PartTrial trial =
            trial_of(parts.inside(kind, line, make, paste_deformation(options.thesis), context),
                     free.similarity, context);
        trial.smooth = true;
        return trial;
    } catch (const Error& error) {
        if (error.code() != ErrorCode::boundary_conflict) throw;
        return std::nullopt;
    }
}

// A loop of edges with its similarity.
PasteLoop PartTrials::fitted(std::span<const Index> vertices) const {
    PasteEnergy energy(ring_edges(surface.map(), ring, surface.images()), energy_for(options, 1));
    const std::vector<Index> edges = energy.edges_of(ring, vertices);
    PasteLoop loop;
    loop.vertices.assign(vertices.begin(), vertices.end());
    const PasteSimilarity start = energy.start(edges);
    loop.first_scale = start.scale;
    loop.similarity = energy.improved(edges, start);
    return loop;
}

std::optional<PartTrial> PartTrials::along_smooth_outline(const Context& context) const {
    const std::optional<FreeLoop> line =
        outline_loop(surface, fitted(regions.outer), Outline::outer, energy_for(options, 1));
    if (!line) return std::nullopt;
    std::optional<PartTrial> trial = along(MovingParts::Boundary::outline_line, *line, context);
    if (trial) trial->outline = true;
    return trial;
}

PartTrial PartTrials::along_outline(const Context& context) const {
    PartTrial trial = trial_of(inside(MovingParts::Boundary::outline, regions.outer, context),
                               fitted(regions.outer).similarity, context);
    trial.outline = true;
    return trial;
}

std::optional<PartTrial> PartTrials::along_smooth_inner(const Context& context) const {
    const std::optional<FreeLoop> line =
        outline_loop(surface, fitted(regions.inner), Outline::inner, energy_for(options, 1));
    if (!line) return std::nullopt;
    std::optional<PartTrial> trial = along(MovingParts::Boundary::inner_line, *line, context);
    if (trial) trial->tight = true;
    return trial;
}

// The boundary of a part of the part of a trial, where that is placed.
std::vector<RingPoint> PartTrials::rim_within(const PastePart& part, const PartTrial& whole) const {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    const double count = static_cast<double>(whole.rim.size());
    for (const RingPoint& point : whole.rim) {
        from += point.position / count;
        to += point.image.position / count;
    }
    std::vector<RingPoint> rim;
    for (const Index v : part.loop) {
        RingPoint point;
        point.position = part.mesh.position(v);
        for (const ElementMap::Source& source : part.map.vertices[v]) {
            point.normal += source.weight * surface.map().source_normals()[at(source.element)];
        }
        point.normal.normalize();
        const Vec3 way = whole.similarity.rotation * (point.position - from);
        point.image = surface.map().nearest(to + whole.scale * way);
        rim.push_back(point);
    }
    return rim;
}

std::optional<PartTrial> PartTrials::along_foot(const PartTrial& inner,
                                                const Context& context) const {
    if (!surface.map().has_nearest()) return std::nullopt;
    const PastePart& part = inner.part();
    // The foot follows from the part that it is of, whose outline depends on its place.
    std::vector<Vec2> outline;
    for (const RingPoint& point : inner.rim) outline.push_back(point.uv);
    const auto make = [&] {
        // With a ring of the surface around, which smoothing of the seam may bend.
        std::vector<double> height = max_around(part.mesh.topology(), heights_over_boundary(part));
        const double foot = kFoot * loop_radius(part.mesh, part.loop);
        for (double& h : height) h -= foot;
        return part_above(part, std::move(height), context);
    };
    try {
        PartTrial trial = inner;
        trial.moving = parts.inside(MovingParts::Boundary::foot, outline, make,
                                    paste_deformation(options.thesis), context);
        trial.rim = rim_within(trial.part(), inner);
        trial.plain = move(trial, context);
        if (settles) settle(trial, context);
        return trial;
    } catch (const Error& error) {
        if (error.code() != ErrorCode::boundary_conflict) throw;
        return std::nullopt;
    }
}

PartTrial PartTrials::along_inner(const Context& context) const {
    PartTrial trial = trial_of(inside(MovingParts::Boundary::inner, regions.inner, context),
                               fitted(regions.inner).similarity, context);
    trial.tight = true;
    return trial;
}

}  // namespace lissom
