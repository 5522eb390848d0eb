#include "kernel/merge/paste/paste.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/merge/paste/part_trial.h"
#include "kernel/merge/paste/paste_state.h"
#include "kernel/merge/paste/placement/plane_line.h"
#include "kernel/merge/sew/seam_skin.h"

namespace lissom {
namespace {

constexpr int kAngles = 12;
// Another angle than that of the base direction must fit this much better.
constexpr double kClearlyBetterAngle = 0.95;
// The disk of the target is this many times as wide as the ring on it. Ways along edges are up to
// 1.4 times as long as the surface is wide, so that one that does not cover the ring is widened.
constexpr double kRoom = 1.5, kMoreRoom = 2.1;
// At corners they are longer still: such a disk is made if the feature lies outside that one. And
// rings that are tubes, as around joined outlines, get a larger size in the plane than their reach
// tells: then disks of twice and four times that width.
constexpr double kMaxRoom = 3.0;
constexpr int kClosestRounds = 4;
constexpr Index kWarmIterations = 3;

ParameterizeMethod method_for(const PasteOptions& options) {
    return options.thesis ? ParameterizeMethod::lscm : ParameterizeMethod::arap;
}

void require_options(const PasteOptions& options) {
    require(options.normals >= 0.0 && std::isfinite(options.normals),
            "the weight of the normals must be 0 or more");
    require(options.crease >= 0.0 && options.crease <= kPi,
            "the crease of a paste must lie between 0 and 180 degrees");
    require(options.share > 0.0 && options.share < 1.0,
            "the ring's share must lie between 0 and 1");
}

double longest_edge_of(const Mesh& mesh) {
    double square = 0.0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const std::span<const Index> face = mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Vec3 side = mesh.position(face[(k + 1) % face.size()]) - mesh.position(face[k]);
            square = std::max(square, side.squaredNorm());
        }
    }
    return std::sqrt(square);
}

std::string reach_text(double reach) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", reach);
    return text;
}

void require_faces(const Mesh& mesh) {
    if (mesh.face_count() > 0) return;
    throw Error(ErrorCode::mesh_empty, "a mesh without faces cannot be pasted");
}

}  // namespace

EnergyOptions energy_for(const PasteOptions& options, Index iterations) {
    EnergyOptions energy;
    energy.thesis = options.thesis != nullptr;
    energy.normals = options.thesis ? 0.0 : options.normals;
    energy.iterations = iterations;
    return energy;
}

std::unique_ptr<PasteMap> Paste::State::map_of(std::span<const Index> target_faces,
                                               const PastePlacement& placement,
                                               const Context& context) const {
    auto map = std::make_unique<PasteMap>(
        *surfaces, source_map, target_chart(target, target_faces, method_for(options), context),
        options.correspondence == PasteCorrespondence::closest || clears());
    if (clears() && altered) map->set_relief(relief_of(map->target(), placement, context));
    return map;
}

std::unique_ptr<PasteMap> Paste::State::map_around(const PastePlacement& placement, double room,
                                                   const Context& context) const {
    require(placement.scale > 0.0 && std::isfinite(placement.scale),
            "the scale of a placement must be above 0");
    if (!placement.at.allFinite()) {
        throw Error(ErrorCode::not_finite, "the point of a placement is NaN or infinite");
    }
    const SurfacePoint point = surfaces->target_tree.nearest(placement.at);
    const double radius = room * placement.scale * source_map.length_ratio * source_map.reach +
                          placement.offset.norm();
    return map_of(disk_around(target, point, radius, context), placement, context);
}

void Paste::State::use_map(std::unique_ptr<PasteMap> on) {
    used = std::make_unique<TargetOnMap>(TargetOnMap{std::move(on)});
}

const TargetPiece& Paste::State::target_piece(const Context& context) {
    std::optional<TargetPiece>& piece = used->piece;
    if (piece) return *piece;
    const PasteChart& chart = used->map->target();
    // Weights of a part alone go on over all of the target.
    const bool global = skinned_side(target, source) == SeamSide::source;
    if (global) {
        piece = TargetPiece::whole(target, chart);
    } else {
        piece.emplace(target, chart, context);
    }
    return *piece;
}

const PasteGround& Paste::State::ground(const Context& context) {
    std::optional<PasteGround>& ground = used->ground;
    return ground ? *ground : ground.emplace(target, used->map->target(), context);
}

std::span<const SharpEdge> Paste::State::edges_to_stand_on(const Context& context) {
    if (bound_to_boundary()) return {};
    std::optional<std::vector<SharpEdge>>& edges = used->edges;
    if (edges) return *edges;
    return edges.emplace(sharp_edges(chart_mesh(target, used->map->target()), context));
}

// How well the outlines fit, a missing image counting as a full edge.
double Paste::State::misfit_at(const PasteMap& on, const std::vector<ImagePoint>& images) const {
    PasteEnergy energy(ring_edges(on, *ring, images), energy_for(options, 1));
    double sum = 0.0;
    for (const std::vector<Index>* loop : {&regions.outer, &regions.inner}) {
        const std::vector<Index> edges = energy.edges_of(*ring, *loop);
        sum += edges.empty() ? 1.0 : energy.misfit(edges, energy.start(edges));
    }
    return sum;
}

void Paste::State::choose_angle(const PasteMap& on, PlacedFeature& place,
                                const Context& context) const {
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

// The size of the images of both outlines, over that on the source; nothing if they have none.
std::optional<double> Paste::State::size_of(const PasteMap& on,
                                            const std::vector<ImagePoint>& images) const {
    PasteEnergy energy(ring_edges(on, *ring, images), energy_for(options, 1));
    double product = 1.0;
    int count = 0;
    for (const std::vector<Index>* loop : {&regions.outer, &regions.inner}) {
        const std::vector<Index> edges = energy.edges_of(*ring, *loop);
        if (edges.empty()) continue;
        product *= energy.start(edges).scale;
        ++count;
    }
    if (count == 0) return std::nullopt;
    return std::pow(product, 1.0 / count);
}

// Images at the places where they are on another target.
std::vector<ImagePoint> Paste::State::images_like(const PasteMap& on,
                                                  const PlacedFeature& former) const {
    std::vector<ImagePoint> images;
    images.reserve(former.images.size());
    for (const ImagePoint& image : former.images) {
        images.push_back(image.inside ? on.nearest(image.position) : ImagePoint{});
    }
    return images;
}

// A ring that is a tube lies in the plane with another size than on the surface: the size that is
// wanted is that of the outlines.
std::vector<ImagePoint> Paste::State::images_of(const PasteMap& on, const PastePlacement& placement,
                                                double angle, const PlacedFeature* like) const {
    if (like) return images_like(on, *like);
    PlanarMap plane = on.planar(placement, angle);
    std::vector<ImagePoint> images = on.images(plane);
    if (options.thesis) return images;
    const std::optional<double> size = size_of(on, images);
    if (!size) return images;
    plane.factor *= placement.scale / *size;
    return on.images(plane);
}

PlacedFeature Paste::State::place(const PasteMap& on, const PastePlacement& placement,
                                  std::span<const Index> start, const PasteEffort& effort,
                                  const Context& context) {
    PlacedFeature place;
    place.placement = placement;
    place.angle = placement.angle.value_or(0.0);
    if (!placement.angle && !placement.toward) {
        place.upright = on.planar(placement, 0.0).clear;
        if (!place.upright) choose_angle(on, place, context);
    }
    place.images = images_of(on, placement, place.angle, effort.like);
    place.mapped = place.images;
    place.loop = search_boundary(on, regions, *ring, place.images, start,
                                 energy_for(options, effort.iterations), context);
    const bool closer = options.correspondence == PasteCorrespondence::closest && !options.thesis;
    if (closer && effort.closest) draw_closer(on, place, context);
    const bool smooth = options.loop == PasteBoundary::smooth && !options.thesis;
    if (smooth && effort.iterations > 0) free_boundary(on, place, context);
    const bool stays = std::equal(place.loop.vertices.begin(), place.loop.vertices.end(),
                                  start.begin(), start.end());
    if (smooth && effort.iterations == 0 && effort.line && stays) {
        keep_line(on, place, *effort.line);
    }
    return place;
}

void Paste::State::free_boundary(const PasteMap& on, PlacedFeature& place,
                                 const Context& context) const {
    const RingSurface surface(on, *triangles, place.images);
    place.line = free_loop(surface, place.loop, energy_for(options, 1), context);
    note_line(place);
}

// Keeps the line of another placement, if it lies on the target here.
void Paste::State::keep_line(const PasteMap& on, PlacedFeature& place, const FreeLoop& line) const {
    const RingSurface surface(on, *triangles, place.images);
    place.line = carried_loop(surface, line, place.loop, energy_for(options, 1));
    note_line(place);
}

void Paste::State::note_line(PlacedFeature& place) const {
    if (!place.line) return;
    place.loop.report.smooth_energy = place.line->energy;
    place.loop.report.smooth_misfit = place.line->misfit;
    place.loop.report.scale = place.line->similarity.scale;
}

// Images of the vertices once they are drawn to the points of the target nearest to them.
std::vector<ImagePoint> Paste::State::nearest_images(const PasteMap& on,
                                                     const PlacedFeature& place) const {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    const double count = static_cast<double>(place.loop.vertices.size());
    for (const Index v : place.loop.vertices) {
        from += source.position(v) / count;
        to += place.images[at(source_map.place_of(v))].position / count;
    }
    const PasteSimilarity& fit = place.loop.similarity;
    std::vector<ImagePoint> images;
    images.reserve(source_map.map.vertex.size());
    for (const Index v : source_map.map.vertex) {
        images.push_back(on.nearest(to + fit.scale * (fit.rotation * (source.position(v) - from))));
    }
    return images;
}

// One round. False if the energy does not fall or the boundary crosses itself.
bool Paste::State::draw_once(const PasteMap& on, PlacedFeature& place,
                             const Context& context) const {
    std::vector<ImagePoint> images = nearest_images(on, place);
    EnergyOptions how = energy_for(options, 2);
    how.first_scale = place.loop.first_scale;
    PasteLoop loop = search_boundary(on, regions, *ring, images, place.loop.vertices, how, context);
    std::vector<Vec2> outline;
    for (const Index v : loop.vertices) outline.push_back(images[at(source_map.place_of(v))].uv);
    PasteSearch& report = place.loop.report;
    if (!(loop.energy < place.loop.energy) || crosses_itself(outline)) return false;
    report.energy.push_back(loop.energy);
    report.misfit.push_back(loop.misfit);
    report.scale = loop.report.scale;
    report.loop_size = loop.report.loop_size;
    ++report.closest_rounds;
    report.kept_outline = loop.report.kept_outline;
    loop.report = std::move(report);
    place.images = std::move(images);
    place.loop = std::move(loop);
    return true;
}

double Paste::State::energy_near(const PasteMap& on, const PlacedFeature& place,
                                 const Context& context) {
    const RingSurface surface(on, *triangles, place.images);
    const PartTrials trials{options, regions, surface, *ring, place, parts};
    return trials.along_loop(context).near.energy;
}

// Rounds of nearest points, kept if they leave the surface near the boundary less distorted.
void Paste::State::draw_closer(const PasteMap& on, PlacedFeature& place, const Context& context) {
    PlacedFeature closer = place;
    for (int round = 0; round < kClosestRounds; ++round) {
        context.checkpoint();
        if (!draw_once(on, closer, context)) break;
    }
    if (closer.loop.report.closest_rounds == 0) return;
    if (energy_near(on, closer, context) < energy_near(on, place, context)) {
        place = std::move(closer);
    }
}

[[noreturn]] void Paste::State::refuse_room(const PastePlacement& placement) const {
    const SurfacePoint point = surfaces->target_tree.nearest(placement.at);
    Elements elements{ElementKind::face, 0, {}};
    elements.add(point.face);
    throw Error(ErrorCode::boundary_conflict,
                "there is no room for the part around " + describe(elements) +
                    " of the target: within the part's reach, " + reach_text(reach_of(placement)) +
                    ", the surface ends or comes back to itself, as at a border, at a hole or "
                    "around a thin limb; make the scale smaller, or move the placement away from "
                    "there",
                elements);
}

// The part on a disk of the target of so many reaches; nothing if there is none that is large
// enough for the feature.
std::optional<Paste::State::PlacedOn> Paste::State::placed_within(const PastePlacement& placement,
                                                                  double room,
                                                                  std::span<const Index> start,
                                                                  const PasteEffort& effort,
                                                                  const Context& context) {
    try {
        PlacedOn made{map_around(placement, room, context), {}};
        made.place = place(*made.map, placement, start, effort, context);
        return made;
    } catch (const Error& error) {
        const ErrorCode code = error.code();
        if (code != ErrorCode::boundary_conflict && code != ErrorCode::not_a_disk) throw;
        return std::nullopt;
    }
}

// Lays a disk of the target out and places the part there; a wider one if that holds more.
void Paste::State::place_on_disk(const PastePlacement& placement, std::span<const Index> start,
                                 const PasteEffort& effort, const Context& context) {
    std::optional<PlacedOn> found;
    // On an edge a boundary that looks along the part reaches farther.
    const bool wide = !options.thesis && has_edges_near(placement);
    for (const double room : {wide ? kMoreRoom : kRoom, wide ? kRoom : kMoreRoom, kMaxRoom,
                              2.0 * kMaxRoom, 4.0 * kMaxRoom}) {
        if (found && (covers(found->place) || room >= kMaxRoom)) break;
        std::optional<PlacedOn> next = placed_within(placement, room, start, effort, context);
        if (next && (!found || covers(next->place))) found = std::move(next);
    }
    if (!found) refuse_room(placement);
    use_map(std::move(found->map));
    placed = std::move(found->place);
}

// Prepares the part of the paste that depends on the source alone.
void Paste::State::prepare(const Mesh& new_source, const Region& region,
                           const std::optional<Region>& feature, const PasteOptions& wanted,
                           const Context& context) {
    require_options(wanted);
    require_faces(new_source);
    source = new_source;
    options = wanted;
    regions = paste_regions(source, {region, feature, options.share, true}, context);
    ring = std::make_shared<LoopSearch>(source, regions, context);
    source_map = source_chart(source, regions, method_for(options), context);
    triangles = std::make_shared<RingTriangles>(source_map, regions);
}

// Lays a target out and places the part on it.
void Paste::State::begin_on(const Mesh& new_target, const std::optional<Region>& region,
                            const PastePlacement& placement, const Context& context) {
    target = new_target;
    onto = region;
    own_disk = !region.has_value();
    longest_edge = longest_edge_of(target);
    surfaces = std::make_unique<PasteSurfaces>(source, target);
    if (needs_another(placement)) return place_on_altered(placement, {}, {}, context);
    place_here(onto, placement, {}, {}, context);
}

bool Paste::State::covers(const PlacedFeature& place) const {
    return std::all_of(regions.outer.begin(), regions.outer.end(),
                       [&](Index v) { return place.mapped[at(source_map.place_of(v))].inside; });
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
    state->triangles = state_->triangles;
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
    PlacedFeature placed = state.place(*state.used->map, fixed, {}, {iterations, true}, context);
    placed.placement = state.placed.placement;
    placed.angle_chosen = state.placed.angle_chosen;
    placed.upright = state.placed.upright;
    state.placed = std::move(placed);
    state.optimized = true;
    if (state.options.clear && !state.options.cleared) {
        state.clear_under_boundary({iterations, true}, context);
    }
    return loop();
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

const PasteSearch& Paste::search() const {
    return state_->placed.loop.report;
}

Path Paste::loop() const {
    const PlacedFeature& placed = state_->placed;
    if (!placed.line) return {state_->source.shared_topology(), placed.loop.vertices, true};
    std::vector<Vec3> points;
    for (const RingPoint& point : placed.line->points) points.push_back(point.position);
    return {std::move(points), true};
}

Path Paste::image() const {
    const PlacedFeature& placed = state_->placed;
    std::vector<Vec3> points;
    if (placed.line) {
        for (const RingPoint& point : placed.line->points) points.push_back(point.image.position);
    } else {
        for (const Index v : placed.loop.vertices) {
            points.push_back(placed.images[at(state_->source_map.place_of(v))].position);
        }
    }
    return {std::move(points), true};
}

std::optional<Region> Paste::cleared() const {
    return state_->gone;
}

std::optional<PasteClearing> Paste::clearing() const {
    return state_->clearing;
}

const PastePlacement& Paste::placement() const {
    return state_->placed.placement;
}

std::size_t Paste::memory_bytes() const {
    return 2 * (state_->source.memory_bytes() + state_->target.memory_bytes());
}

void Paste::State::move_to(const PastePlacement& placement, const PasteEffort& effort,
                           const Context& context) {
    const std::vector<Index> start = optimized ? placed.loop.vertices : std::vector<Index>();
    if (altered || needs_another(placement)) {
        return place_on_altered(placement, start, effort, context);
    }
    if (!own_disk) {
        placed = place(*used->map, placement, start, effort, context);
        return;
    }
    try {
        PlacedFeature next = place(*used->map, placement, start, effort, context);
        if (covers(next)) {
            placed = std::move(next);
            return;
        }
    } catch (const Error& error) {
        if (error.code() != ErrorCode::boundary_conflict) throw;
    }
    // The region that was laid out does not reach there.
    place_on_disk(placement, start, effort, context);
}

void Paste::move(const PastePlacement& placement, const Context& context) try {
    state_->move_to(placement, {state_->optimized ? kWarmIterations : 0, false}, context);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

void Paste::slide(const PastePlacement& placement, const Context& context) try {
    // The former line: a place that fails to move keeps it, one that moves makes another.
    const std::optional<FreeLoop> line = state_->placed.line;
    state_->move_to(placement, {0, false, line ? &*line : nullptr}, context);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

}  // namespace lissom
