#include "kernel/merge/paste/laid_part.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/core/rotation.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/merge/paste/part/draped_part.h"
#include "kernel/merge/paste/part/target_bite.h"
#include "kernel/merge/paste/placement/plane_line.h"
#include "kernel/merge/sew/seam_loop.h"
#include "kernel/merge/sew/sew.h"

namespace lissom {
namespace {

void lay_on_hole(const PartTrials& trials, LaidPart& laid, const Context& context) {
    const Loop hole(laid.opened.mesh, laid.opened.loop, LoopMeasure::robust, context);
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
    const PartTrials marked{
        trials.options, trials.regions,    mapped,         trials.ring,    trials.placed,
        trials.parts,   trials.lock_scale, trials.refines, trials.settles, trials.sharp};
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
        PartTrial inner = smooth ? *std::move(smooth) : mapped.along_inner(context);
        if (edges) return inner;
        std::optional<PartTrial> foot = mapped.along_foot(inner, context);
        return foot ? *std::move(foot) : std::move(inner);
    });
}

namespace {

// In radii of the feature's boundary: lines of sharp edges that are shorter are grain; the length
// of edges under it that counts; the deepest that a foot goes.
constexpr double kEdgeLine = 0.5, kEdgesUnder = 0.3, kDeepestFoot = 1.5;
// A point of an edge is looked at every so many radii.
constexpr double kEdgeStep = 0.1;
// How often a part turns toward the steepest side until its boundary is seen, and how far.
constexpr int kLayTurns = 5;
constexpr double kMoreTurn = 0.3;

std::vector<ImagePoint> inner_images(const PartTrials& trials) {
    const PasteChart& chart = trials.surface.map().source();
    std::vector<ImagePoint> images;
    for (const Index v : trials.regions.inner) {
        images.push_back(trials.placed.mapped[at(chart.place_of(v))]);
    }
    return images;
}

double image_radius(const std::vector<ImagePoint>& images) {
    Vec3 middle = Vec3::Zero();
    const double count = static_cast<double>(images.size());
    for (const ImagePoint& image : images) middle += image.position / count;
    double radius = 0.0;
    for (const ImagePoint& image : images) radius += (image.position - middle).norm() / count;
    return radius;
}

// Points in the plane along edges, each standing for `step`.
std::vector<Vec2> edge_points(const PartTrials& trials, double radius, double step) {
    const std::vector<Vec2>& uv = trials.surface.map().target().map.uv;
    std::vector<Vec2> points;
    for (const SharpEdge& edge : trials.sharp) {
        if (edge.line < kEdgeLine * radius) continue;
        const Vec2 &from = uv[at(edge.first)], &to = uv[at(edge.second)];
        const double count = std::ceil((edge.to - edge.from).norm() / step);
        for (double k = 0.5; k < count; k += 1.0) points.push_back(from + k / count * (to - from));
    }
    return points;
}

// Whether sharp edges of the target lie under the feature.
bool stands_on_edges(const PartTrials& trials) {
    if (trials.sharp.empty()) return false;
    const std::vector<ImagePoint> images = inner_images(trials);
    std::vector<Vec2> outline;
    for (const ImagePoint& image : images) {
        if (!image.inside) return false;
        outline.push_back(image.uv);
    }
    const double radius = image_radius(images), step = kEdgeStep * radius;
    if (!(radius > 0.0)) return false;
    const std::vector<char> inside = lie_inside(edge_points(trials, radius, step), outline);
    const auto count = std::count(inside.begin(), inside.end(), 1);
    return static_cast<double>(count) * step > kEdgesUnder * radius;
}

// The mean of the target's normals along a boundary: the similarity of that fits best the side of
// an edge on which most of it lies.
Vec3 mean_normal(std::span<const RingPoint> rim) {
    Vec3 normal = Vec3::Zero();
    for (std::size_t k = 0; k < rim.size(); ++k) {
        const ImagePoint &image = rim[k].image, &next = rim[(k + 1) % rim.size()].image;
        normal += (next.position - image.position).norm() * (image.normal + next.normal);
    }
    return normal.stableNormalized();
}

// Turned toward the normal that differs from it most.
Vec3 turned_to_steepest(const Vec3& axis, std::span<const RingPoint> rim) {
    const auto most = std::min_element(rim.begin(), rim.end(), [&](const auto& a, const auto& b) {
        return a.image.normal.dot(axis) < b.image.normal.dot(axis);
    });
    return (axis + kMoreTurn * most->image.normal).stableNormalized();
}

void turn_to(const Vec3& normal, PartTrial& trial) {
    const Vec3 axis = trial.similarity.rotation * loop_axis(trial.part());
    trial.similarity.rotation =
        min_rotation(axis, normal).toRotationMatrix() * trial.similarity.rotation;
}

// Moves the boundary to where the part's axis meets the target. False where it does not, or not
// everywhere along a simple line, or too deep.
bool look_along_axis(const PasteMap& map, PartTrial& trial) {
    std::vector<Vec3> images;
    for (const RingPoint& point : trial.rim) images.push_back(point.image.position);
    const Drape drape(trial.part(), images, trial.similarity, trial.scale);
    std::vector<Vec2> outline;
    for (std::size_t k = 0; k < trial.rim.size(); ++k) {
        const Vec3 from = drape.stood(trial.rim[k].position);
        const std::optional<ImagePoint> image = map.along(from, drape.axis(), images[k]);
        if (!image) return false;
        trial.rim[k].image = *image;
        images[k] = image->position;
        outline.push_back(image->uv);
    }
    const Drape drawn(trial.part(), images, trial.similarity, trial.scale);
    return !crosses_itself(outline) && drawn.depth() <= kDeepestFoot * drape.radius();
}

// The part with its boundary where its axis meets the target, turned until all of that is seen.
std::optional<PartTrial> seen_along_axis(const PasteMap& map, const PartTrial& trial) {
    const std::vector<RingPoint> rim = trial.rim;
    Vec3 axis = mean_normal(rim);
    for (int turn = 0; turn < kLayTurns; ++turn, axis = turned_to_steepest(axis, rim)) {
        if (!(axis.norm() > 0.0)) return std::nullopt;
        PartTrial next = trial;
        turn_to(axis, next);
        if (look_along_axis(map, next)) return next;
    }
    return std::nullopt;
}

}  // namespace

std::optional<PartTrial> draped_trial(const PartTrials& trials, const Context& context) try {
    if (trials.options.thesis || !stands_on_edges(trials)) return std::nullopt;
    PartTrials plain = trials;
    plain.refines = plain.settles = false;
    PartTrial trial = tight_trial(plain, context);
    std::optional<PartTrial> looking = seen_along_axis(trials.surface.map(), trial);
    if (!looking) return std::nullopt;
    trial = std::move(*looking);
    trial.draped = true;
    trial.plain = trials.move(trial, context);
    return trial;
} catch (const Error& error) {
    // There is no room for that boundary.
    if (error.code() != ErrorCode::boundary_conflict) throw;
    return std::nullopt;
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
