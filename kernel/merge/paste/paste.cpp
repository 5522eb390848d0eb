#include "kernel/merge/paste/paste.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/clock.h"
#include "kernel/core/memory_error.h"
#include "kernel/merge/merge_stages.h"
#include "kernel/merge/paste/cleared_target.h"
#include "kernel/merge/paste/loop_search.h"
#include "kernel/merge/paste/opened_target.h"
#include "kernel/merge/paste/paste_energy.h"
#include "kernel/merge/paste/paste_map.h"
#include "kernel/merge/paste/paste_part.h"
#include "kernel/merge/paste/paste_regions.h"
#include "kernel/merge/provenance.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/merge/verdict.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

constexpr int kAngles = 12;
// Another angle than that of the base direction must fit this much better.
constexpr double kClearlyBetterAngle = 0.95;
// The disk of the target is this many times as wide as the ring on it. Ways along edges are up to
// 1.4 times as long as the surface is wide, so that one that does not cover the ring is widened.
constexpr double kRoom = 1.5, kMoreRoom = 2.1;
constexpr int kClosestRounds = 4;
constexpr Index kWarmIterations = 3;
// A seam without a collar must be this much better than one with it.
constexpr double kPlainBetter = 0.9;
constexpr double kSteepSeam = 20.0 * kDegree;

ParameterizeMethod method_for(const PasteOptions& options) {
    return options.thesis ? ParameterizeMethod::lscm : ParameterizeMethod::arap;
}

EnergyOptions energy_for(const PasteOptions& options, Index iterations) {
    EnergyOptions energy;
    energy.thesis = options.thesis;
    energy.normals = options.thesis ? 0.0 : options.normals;
    energy.iterations = iterations;
    return energy;
}

void require_options(const PasteOptions& options) {
    require(options.normals >= 0.0 && std::isfinite(options.normals),
            "the weight of the normals must be 0 or more");
    require(options.share > 0.0 && options.share < 1.0,
            "the ring's share must lie between 0 and 1");
}

void require_faces(const Mesh& mesh) {
    if (mesh.face_count() > 0) return;
    throw Error(ErrorCode::mesh_empty, "a mesh without faces cannot be pasted");
}

// One placement and the loop that belongs to it.
struct Placed {
    PastePlacement placement;
    double angle = 0.0;
    bool angle_chosen = false;
    std::vector<ImagePoint> images;
    PasteLoop loop;
};

}  // namespace

struct Paste::State {
    Mesh source, target;
    PasteOptions options;
    PasteRegions regions;
    PasteChart source_map;
    std::shared_ptr<const LoopSearch> ring;
    std::unique_ptr<PasteMap> map;
    /// Whether the target's region was chosen here.
    bool own_disk = false;
    bool optimized = false;
    /// Where features of the target are removed: the target as given, its region for parts, and
    /// where the elements of `target` come from.
    Mesh given;
    std::optional<Region> onto;
    std::optional<MeshMap> cleared;
    Placed placed;

    std::unique_ptr<PasteMap> map_around(const PastePlacement& placement, double room,
                                         const Context& context) const;
    void place_on_disk(const PastePlacement& placement, std::span<const Index> start,
                       Index iterations, const Context& context);
    bool clears() const { return options.clear || options.cleared.has_value(); }
    void prepare(const Mesh& new_source, const Region& region, const std::optional<Region>& feature,
                 const PasteOptions& wanted, const Context& context);
    void move_to(const PastePlacement& placement, Index iterations, const Context& context);
    void begin_on(const Mesh& new_target, const std::optional<Region>& region,
                  const PastePlacement& placement, const Context& context);
    Region region_to_clear(const PastePlacement& placement, const Context& context) const;
    void place_on_cleared(const PastePlacement& placement, std::span<const Index> start,
                          Index iterations, const Context& context);
    double misfit_at(const PasteMap& on, const std::vector<ImagePoint>& images) const;
    void choose_angle(const PasteMap& on, Placed& place, const Context& context) const;
    Placed place(const PasteMap& on, const PastePlacement& placement, std::span<const Index> start,
                 Index iterations, const Context& context) const;
    void draw_closer(const PasteMap& on, Placed& place, const Context& context) const;
    bool covers(const Placed& place) const;
    LoopImage loop_image(std::span<const Index> loop) const;
    MovedPart deformed(const PastePart& part, std::span<const Index> loop, double scale,
                       const PasteSimilarity& similarity, const Context& context) const;
};

std::unique_ptr<PasteMap> Paste::State::map_around(const PastePlacement& placement, double room,
                                                   const Context& context) const {
    require(placement.scale > 0.0 && std::isfinite(placement.scale),
            "the scale of a placement must be above 0");
    if (!placement.at.allFinite()) {
        throw Error(ErrorCode::not_finite, "the point of a placement is NaN or infinite");
    }
    const SurfacePoint point = SpatialTree(target, context).nearest(placement.at);
    const double radius = room * placement.scale * source_map.length_ratio * source_map.reach +
                          placement.offset.norm();
    const std::vector<Index> faces = disk_around(target, point, radius, context);
    return std::make_unique<PasteMap>(source, target, source_map,
                                      target_chart(target, faces, method_for(options), context));
}

// How well the outlines fit, a missing image counting as a full edge.
double Paste::State::misfit_at(const PasteMap& on, const std::vector<ImagePoint>& images) const {
    PasteEnergy energy(on, *ring, images, energy_for(options, 1));
    double sum = 0.0;
    for (const std::vector<Index>* loop : {&regions.outer, &regions.inner}) {
        const std::vector<Index> edges = energy.edges_of(*loop);
        sum += edges.empty() ? 1.0 : energy.misfit(edges, energy.start(edges));
    }
    return sum;
}

void Paste::State::choose_angle(const PasteMap& on, Placed& place, const Context& context) const {
    double least = 0.0;
    for (int k = 0; k < kAngles; ++k) {
        context.checkpoint();
        const double angle = std::remainder(2.0 * kPi * k / kAngles, 2.0 * kPi);
        const double found = misfit_at(on, on.images(on.planar(place.placement, angle)));
        if (k > 0 && found >= least * (place.angle == 0.0 ? kClearlyBetterAngle : 1.0)) continue;
        least = found;
        place.angle = angle;
    }
    place.angle_chosen = true;
}

Placed Paste::State::place(const PasteMap& on, const PastePlacement& placement,
                           std::span<const Index> start, Index iterations,
                           const Context& context) const {
    Placed place;
    place.placement = placement;
    place.angle = placement.angle.value_or(0.0);
    if (!placement.angle && !placement.toward) choose_angle(on, place, context);
    place.images = on.images(on.planar(placement, place.angle));
    place.loop = search_boundary(on, regions, *ring, place.images, start,
                                 energy_for(options, iterations), context);
    const bool closer = options.correspondence == PasteCorrespondence::closest && iterations > 0;
    if (closer) draw_closer(on, place, context);
    return place;
}

// Rounds of nearest points. One is kept where the misfit falls and the boundary stays simple.
void Paste::State::draw_closer(const PasteMap& on, Placed& place, const Context& context) const {
    for (int round = 0; round < kClosestRounds; ++round) {
        context.checkpoint();
        Vec3 from = Vec3::Zero(), to = Vec3::Zero();
        const double count = static_cast<double>(place.loop.vertices.size());
        for (const Index v : place.loop.vertices) {
            from += source.position(v) / count;
            to += place.images[at(source_map.place_of(v))].position / count;
        }
        const PasteSimilarity& fit = place.loop.similarity;
        std::vector<ImagePoint> images;
        for (const Index v : source_map.map.vertex) {
            images.push_back(
                on.nearest(to + fit.scale * (fit.rotation * (source.position(v) - from))));
        }
        PasteLoop loop = search_boundary(on, regions, *ring, images, place.loop.vertices,
                                         energy_for(options, 2), context);
        std::vector<Vec2> outline;
        for (const Index v : loop.vertices) {
            outline.push_back(images[at(source_map.place_of(v))].uv);
        }
        if (loop.report.misfit.back() >= place.loop.report.misfit.back()) return;
        if (crosses_itself(outline)) return;
        PasteSearch& report = place.loop.report;
        report.energy.push_back(loop.report.energy.back());
        report.misfit.push_back(loop.report.misfit.back());
        report.scale = loop.report.scale;
        report.loop_size = loop.report.loop_size;
        ++report.closest_rounds;
        report.kept_outline = loop.report.kept_outline;
        place.images = std::move(images);
        place.loop.vertices = std::move(loop.vertices);
        place.loop.similarity = loop.similarity;
    }
}

// Lays a disk of the target out and places the part there; the wider one where that holds more.
void Paste::State::place_on_disk(const PastePlacement& placement, std::span<const Index> start,
                                 Index iterations, const Context& context) {
    std::unique_ptr<PasteMap> on = map_around(placement, kRoom, context);
    std::optional<Placed> found;
    try {
        found = place(*on, placement, start, iterations, context);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::boundary_conflict) throw;
    }
    if (!found || !covers(*found)) {
        std::unique_ptr<PasteMap> wide = map_around(placement, kMoreRoom, context);
        Placed again = place(*wide, placement, start, iterations, context);
        if (!found || covers(again)) {
            on = std::move(wide);
            found = std::move(again);
        }
    }
    map = std::move(on);
    placed = std::move(*found);
}

Region Paste::State::region_to_clear(const PastePlacement& placement,
                                     const Context& context) const {
    if (options.cleared) return *options.cleared;
    const SurfacePoint point = SpatialTree(given, context).nearest(placement.at);
    const double reach = placement.scale * source_map.length_ratio * source_map.reach;
    return region_under(given, point, reach, context);
}

// Removes the target's features where the part goes, and places it there.
void Paste::State::place_on_cleared(const PastePlacement& placement, std::span<const Index> start,
                                    Index iterations, const Context& context) {
    ClearedTarget next = cleared_target(given, onto, region_to_clear(placement, context), context);
    std::swap(target, next.mesh);
    try {
        if (next.onto) {
            const std::vector<Index> faces = target_faces(target, *next.onto, context);
            auto on = std::make_unique<PasteMap>(
                source, target, source_map,
                target_chart(target, faces, method_for(options), context));
            placed = place(*on, placement, start, iterations, context);
            map = std::move(on);
        } else {
            place_on_disk(placement, start, iterations, context);
        }
    } catch (...) {
        std::swap(target, next.mesh);
        throw;
    }
    cleared = std::move(next.map);
}

// What depends on the source alone.
void Paste::State::prepare(const Mesh& new_source, const Region& region,
                           const std::optional<Region>& feature, const PasteOptions& wanted,
                           const Context& context) {
    require_options(wanted);
    require_faces(new_source);
    source = new_source;
    options = wanted;
    regions = paste_regions(source, region, feature, options.share, context);
    ring = std::make_shared<LoopSearch>(source, regions, context);
    source_map = source_chart(source, regions, method_for(options), context);
}

// Lays a target out and places the part on it.
void Paste::State::begin_on(const Mesh& new_target, const std::optional<Region>& region,
                            const PastePlacement& placement, const Context& context) {
    target = new_target;
    own_disk = !region.has_value();
    if (clears()) {
        given = target;
        onto = region;
        return place_on_cleared(placement, {}, 0, context);
    }
    if (own_disk) return place_on_disk(placement, {}, 0, context);
    const std::vector<Index> faces = target_faces(target, *region, context);
    map = std::make_unique<PasteMap>(source, target, source_map,
                                     target_chart(target, faces, method_for(options), context));
    placed = place(*map, placement, {}, 0, context);
}

// Whether all of the ring has an image.
bool Paste::State::covers(const Placed& place) const {
    return std::all_of(regions.outer.begin(), regions.outer.end(),
                       [&](Index v) { return place.images[at(source_map.place_of(v))].inside; });
}

LoopImage Paste::State::loop_image(std::span<const Index> loop) const {
    LoopImage image;
    for (const Index v : loop) {
        const ImagePoint& point = placed.images[at(source_map.place_of(v))];
        image.positions.push_back(point.position);
        image.normals.push_back(point.normal);
    }
    return image;
}

MovedPart Paste::State::deformed(const PastePart& part, std::span<const Index> loop, double scale,
                                 const PasteSimilarity& similarity, const Context& context) const {
    std::vector<Vec3> normals;
    for (const Index v : loop) normals.push_back(map->source_normals()[at(v)]);
    const auto how = options.thesis ? BoundaryDeformOptions::thesis() : BoundaryDeformOptions{};
    return moved_part(part, paste_values(normals, loop_image(loop), similarity, scale), how,
                      context);
}

Paste::Paste(const Mesh& source, const Mesh& target, const Region& region,
             const std::optional<Region>& feature, const std::optional<Region>& onto,
             const PastePlacement& placement, const PasteOptions& options,
             const Context& context) try
    : state_(std::make_unique<State>()) {
    require_faces(target);
    Progress progress(context, "paste: prepare");
    progress.step(0.6);
    state_->prepare(source, region, feature, options, context);
    progress.step(0.4);
    state_->begin_on(target, onto, placement, context);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

Paste::Paste(std::unique_ptr<State> state) : state_(std::move(state)) {}

PasteSource::PasteSource(const Mesh& source, const Region& region,
                         const std::optional<Region>& feature, const PasteOptions& options,
                         const Context& context) try
    : state_(std::make_unique<Paste::State>()) {
    state_->prepare(source, region, feature, options, context);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

PasteSource::~PasteSource() = default;
PasteSource::PasteSource(PasteSource&&) noexcept = default;
PasteSource& PasteSource::operator=(PasteSource&&) noexcept = default;

Paste PasteSource::on(const Mesh& target, const std::optional<Region>& onto,
                      const PastePlacement& placement, const Context& context) const try {
    require_faces(target);
    auto state = std::make_unique<Paste::State>();
    state->source = state_->source;
    state->options = state_->options;
    state->regions = state_->regions;
    state->ring = state_->ring;
    state->source_map = state_->source_map;
    state->begin_on(target, onto, placement, context);
    return Paste(std::move(state));
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

double PasteSource::reach(double scale) const {
    return scale * state_->source_map.length_ratio * state_->source_map.reach;
}

Paste::~Paste() = default;
Paste::Paste(Paste&&) noexcept = default;
Paste& Paste::operator=(Paste&&) noexcept = default;

Path Paste::optimize(Index iterations, const Context& context) try {
    require(iterations > 0, "a search takes at least one iteration");
    State& state = *state_;
    PastePlacement fixed = state.placed.placement;
    fixed.angle = state.placed.angle;
    Placed placed = state.place(*state.map, fixed, {}, iterations, context);
    placed.placement = state.placed.placement;
    placed.angle_chosen = state.placed.angle_chosen;
    state.placed = std::move(placed);
    state.optimized = true;
    return loop();
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

const PasteSearch& Paste::search() const {
    return state_->placed.loop.report;
}

Path Paste::loop() const {
    return Path(state_->source.shared_topology(), state_->placed.loop.vertices, true);
}

Path Paste::image() const {
    return Path(state_->loop_image(state_->placed.loop.vertices).positions, true);
}

const PastePlacement& Paste::placement() const {
    return state_->placed.placement;
}

std::size_t Paste::memory_bytes() const {
    return 2 * (state_->source.memory_bytes() + state_->target.memory_bytes());
}

void Paste::State::move_to(const PastePlacement& placement, Index iterations,
                           const Context& context) {
    const std::vector<Index> start = optimized ? placed.loop.vertices : std::vector<Index>();
    if (clears()) return place_on_cleared(placement, start, iterations, context);
    if (!own_disk) {
        placed = place(*map, placement, start, iterations, context);
        return;
    }
    try {
        Placed next = place(*map, placement, start, iterations, context);
        if (covers(next)) {
            placed = std::move(next);
            return;
        }
    } catch (const Error& error) {
        if (error.code() != ErrorCode::boundary_conflict) throw;
    }
    // The region that was laid out does not reach there.
    place_on_disk(placement, start, iterations, context);
}

void Paste::move(const PastePlacement& placement, const Context& context) try {
    state_->move_to(placement, state_->optimized ? kWarmIterations : 0, context);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

void Paste::slide(const PastePlacement& placement, const Context& context) try {
    state_->move_to(placement, 0, context);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

namespace {

struct PasteSides {
    PastePart part;
    MovedPart moved;
    OpenedTarget opened;
    LoopPair pair;
};

SewOptions paste_sewing(const PasteMergeOptions& options, bool collar) {
    SewOptions how;
    how.smooth = options.smooth;
    how.collar = collar;
    return how;
}

Sewn sewn_well(const PasteSides& sides, const PasteMergeOptions& options, const Context& context) {
    const auto sew_with = [&](bool collar) {
        const LoopPair pairs[] = {sides.pair};
        Sewn sewn =
            sew(sides.opened.mesh, sides.moved.mesh, pairs, paste_sewing(options, collar), context);
        require_sound(sewn, sides.opened.mesh, sides.moved.mesh, pairs);
        return sewn;
    };
    const auto angles = [](const Sewn& sewn) {
        return sewn.report.after.greatest_dihedral + sewn.report.after.greatest_near;
    };
    Sewn sewn = sew_with(options.collar);
    if (!(sewn.report.collar_added > 0 && sewn.report.after.greatest_dihedral > kSteepSeam)) {
        return sewn;
    }
    Sewn plain = sew_with(false);
    return angles(plain) <= kPlainBetter * angles(sewn) ? std::move(plain) : std::move(sewn);
}

MergeReport merge_report(const PasteSides& sides, const Sewn& sewn, double scale,
                         const PasteMergeOptions& options, const Context& context) {
    MergeReport report;
    const std::vector<Index> loops[] = {sides.part.loop, sides.opened.loop};
    report.source_rim = seam_quality(sides.part.mesh, {&loops[0], 1});
    report.target_rim = seam_quality(sides.opened.mesh, {&loops[1], 1});
    JoinReport join;
    join.source_size = count_of(sides.part.loop);
    join.target_size = count_of(sides.opened.loop);
    join.scale = scale;
    report.joins.push_back(join);
    report.deform = sides.moved.stats;
    report.seam = sewn.report;
    if (options.find_intersections) {
        report.intersections = new_intersections(sides.opened.mesh, sides.part.mesh, sewn, context);
    }
    const Verdict verdict = verdict_of(report, options.find_intersections);
    report.ok = verdict.good;
    report.verdict = verdict.text;
    return report;
}

}  // namespace

PasteResult Paste::merge(const PasteMergeOptions& options, const Context& context) try {
    const State& state = *state_;
    Progress progress(context, "paste");
    const auto start = Clock::now();
    const Placed& placed = state.placed;
    PasteReport report;
    report.search = placed.loop.report;
    report.source_map = state.source_map.quality();
    report.target_map = state.map->target().quality();
    report.angle = placed.angle;
    report.angle_chosen = placed.angle_chosen;
    const auto try_loop = [&](const std::vector<Index>& loop, double scale) {
        PasteSides sides;
        sides.part = part_inside(state.source, state.regions, loop, context);
        sides.moved = state.deformed(sides.part, loop, scale, placed.loop.similarity, context);
        return sides;
    };
    std::vector<Index> loop = placed.loop.vertices;
    const double own = placed.loop.similarity.scale;
    const double scale = options.lock_scale ? placed.placement.scale : own;
    progress.step(0.4);
    PasteSides sides = try_loop(loop, scale);
    report.near = near_distortion(sides.part, sides.moved.mesh, scale);
    if (options.compare && loop != state.regions.outer && state.covers(placed)) {
        PasteSides outline = try_loop(state.regions.outer, scale);
        report.outline_near = near_distortion(outline.part, outline.moved.mesh, scale);
        if (report.outline_near->energy < report.near.energy) {
            report.kept_outline = true;
            report.near = *report.outline_near;
            loop = state.regions.outer;
            sides = std::move(outline);
        }
    }
    progress.step(0.6);
    report.scale = scale;
    report.feature = feature_distortion(sides.part, sides.moved.mesh, scale, state.regions.feature);
    std::vector<Vec2> outline;
    for (const Index v : loop) {
        outline.push_back(placed.images[at(state.source_map.place_of(v))].uv);
    }
    sides.opened = open_target(state.target, state.map->target(), outline, context);
    sides.pair = paste_pair(sides.part, sides.opened, state.loop_image(loop).positions);
    // The part comes to lie on the boundary as it was cut.
    {
        const Loop hole(sides.opened.mesh, sides.opened.loop);
        LoopImage image = state.loop_image(loop);
        std::vector<Vec3> normals;
        const std::size_t n = loop.size();
        for (std::size_t k = 0; k < n; ++k) {
            image.positions[k] = point_of(hole.points(), sides.pair.on_target[n - 1 - k]);
            normals.push_back(state.map->source_normals()[at(loop[k])]);
        }
        const auto how =
            state.options.thesis ? BoundaryDeformOptions::thesis() : BoundaryDeformOptions{};
        sides.moved = moved_part(
            sides.part, paste_values(normals, image, placed.loop.similarity, scale), how, context);
    }
    Sewn sewn = sewn_well(sides, options, context);
    PasteResult result{{}, std::move(report)};
    result.merged.report = merge_report(sides, sewn, scale, options, context);
    result.merged.report.solve_seconds = seconds_since(start);
    const MeshMap target_map =
        state.cleared ? composed(sides.opened.map, *state.cleared) : sides.opened.map;
    const Topology& first = (state.cleared ? state.given : state.target).topology();
    const MeshMap origins = appended_map(target_map, sides.part.map, first);
    result.merged.provenance = composed(sewn.map, origins);
    result.report.euler_characteristic = euler_characteristic(sewn.mesh.topology());
    result.report.expected_characteristic = euler_characteristic(state.target.topology()) +
                                            euler_characteristic(sides.part.mesh.topology()) - 1;
    result.merged.mesh = std::move(sewn.mesh);
    result.merged.side_of_face = std::move(sewn.side_of_face);
    result.merged.seams = std::move(sewn.seams);
    return result;
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

}  // namespace lissom
