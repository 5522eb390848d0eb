// The target that a part is placed on: as given, or finer under the part if it is coarse there, and
// without the features to be removed.
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/merge/paste/erase/cleared_target.h"
#include "kernel/merge/paste/paste_state.h"
#include "kernel/merge/paste/placement/plane_line.h"
#include "kernel/merge/provenance.h"
#include "kernel/mesh/edit/finer_near.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

// Edges under a part that are longer than this part of its reach are halved, until none is longer
// than the other one.
constexpr double kCoarsePart = 0.6, kFinePart = 0.3;
// The first beside sharp edges, in lines of at least half a reach, on which a part stands along its
// feature's outline.
constexpr double kCoarseOnEdges = 0.35, kEdgesNear = 0.5;

// Parts of a part's reach within which features are looked for.
constexpr double kBaseReaches[] = {1.0, 1.2, 0.8, 0.64, 0.5};

// A feature that is as high as a part's reach counts, to a line that cuts through it, as much as
// surfaces whose normals differ by this.
constexpr double kHeightOfRelief = 5.0;

// A point lies on a surface within this part of a part's reach.
constexpr double kOnSurface = 1e-6;

// An edge lies on a surface if its ends do, within this part of its length.
constexpr double kOnPiece = 1e-6;

// A region of a mesh on one that was made of it: the vertices that come from its vertices alone.
Region carried(const Region& region, const Mesh& mesh, const MeshMap& map) {
    const std::vector<char> inside = region.mask();
    std::vector<Index> vertices;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const auto sources = map.vertices[v];
        if (std::all_of(sources.begin(), sources.end(),
                        [&](const auto& source) { return inside[at(source.element)] != 0; })) {
            vertices.push_back(v);
        }
    }
    return {mesh.shared_topology(), std::move(vertices)};
}

// The target without its cleared part.
AlteredTarget after(const AlteredTarget& ground, ClearedTarget next) {
    MeshMap map = ground.map ? composed(next.map, *ground.map) : std::move(next.map);
    return {std::move(next.mesh), std::move(map), std::move(next.onto)};
}

// Its vertices that the target as given has: the first ones.
Region on_given(const Region& region, const Mesh& given) {
    std::vector<Index> vertices = region.vertices();
    std::erase_if(vertices, [&](Index v) { return v >= given.vertex_count(); });
    return {given.shared_topology(), std::move(vertices)};
}

}  // namespace

double Paste::State::reach_of(const PastePlacement& placement) const {
    require(placement.scale > 0.0 && std::isfinite(placement.scale),
            "the scale of a placement must be above 0");
    if (!placement.at.allFinite() || !placement.offset.allFinite()) {
        throw Error(ErrorCode::not_finite, "the point of a placement is NaN or infinite");
    }
    return placement.scale * source_map.length_ratio * source_map.reach;
}

bool Paste::State::has_edges_near(const PastePlacement& placement) const {
    if (!given_edges) given_edges = sharp_edges(as_given(), {});
    if (given_edges->empty()) return false;
    const double reach = reach_of(placement);
    const Vec3 at = surfaces ? surfaces->target_tree.nearest(placement.at).position
                             : SpatialTree(as_given()).nearest(placement.at).position;
    return std::any_of(given_edges->begin(), given_edges->end(), [&](const SharpEdge& edge) {
        return edge.line >= kEdgesNear * reach && (nearest_point_of(edge, at) - at).norm() < reach;
    });
}

// The longest edge that a target may have under a part.
double Paste::State::coarse_edge(const PastePlacement& placement) const {
    const double reach = reach_of(placement);
    const bool fine = longest_edge <= kCoarseOnEdges * reach;
    return (fine || !has_edges_near(placement) ? kCoarsePart : kCoarseOnEdges) * reach;
}

bool Paste::State::needs_another(const PastePlacement& placement) const {
    return clears() || longest_edge > coarse_edge(placement);
}

AlteredTarget Paste::State::roomy(const PastePlacement& placement, const Context& context) const {
    const Mesh& mesh = as_given();
    const double reach = reach_of(placement), coarse = coarse_edge(placement);
    if (!(longest_edge > coarse)) return {mesh, std::nullopt, onto};
    const SurfacePoint point = SpatialTree(mesh, context).nearest(placement.at);
    const FinePlace place{point.face, point.position, reach + placement.offset.norm(), coarse,
                          kFinePart * reach};
    std::optional<FinerMesh> finer = finer_near(mesh, {&place, 1}, context);
    if (!finer) return {mesh, std::nullopt, onto};
    if (onto) require_same_topology(mesh, onto->topology(), "the target's region");
    std::optional<Region> region;
    if (onto) region = carried(*onto, finer->mesh, finer->map);
    return {std::move(finer->mesh), std::move(finer->map), std::move(region)};
}

void Paste::State::place_here(const std::optional<Region>& region, const PastePlacement& placement,
                              std::span<const Index> start, const PasteEffort& effort,
                              const Context& context) {
    if (!region) return place_on_disk(placement, start, effort, context);
    std::unique_ptr<PasteMap> on =
        map_of(target_faces(target, *region, context), placement, context);
    placed = place(*on, placement, start, effort, context);
    use_map(std::move(on));
}

void Paste::State::place_on(AlteredTarget next, const PastePlacement& placement,
                            std::span<const Index> start, const PasteEffort& effort,
                            const Context& context) {
    used.reset();
    surfaces.reset();
    target = std::move(next.mesh);
    altered = std::move(next.map);
    surfaces = std::make_unique<PasteSurfaces>(source, target);
    place_here(next.onto, placement, start, effort, context);
}

// Runs a change of the target. After an error all is as before.
template <typename Work>
void Paste::State::all_or_nothing(const Work& work) {
    if (!altered) given = target;
    Mesh target_before = target, given_before = given;
    std::optional<MeshMap> altered_before = altered;
    std::optional<Region> gone_before = std::exchange(gone, std::nullopt);
    const std::optional<PasteClearing> clearing_before = std::exchange(clearing, std::nullopt);
    std::unique_ptr<PasteSurfaces> surfaces_before = std::move(surfaces);
    std::unique_ptr<TargetOnMap> used_before = std::move(used);
    PlacedFeature placed_before = placed;
    try {
        work();
    } catch (...) {
        used = std::move(used_before);
        surfaces = std::move(surfaces_before);
        target = std::move(target_before);
        given = std::move(given_before);
        altered = std::move(altered_before);
        gone = std::move(gone_before);
        clearing = clearing_before;
        placed = std::move(placed_before);
        throw;
    }
}

// On the surface that features stand on, or, if the part has no room there, on the features.
void Paste::State::place_clearing(const AlteredTarget& ground, const PastePlacement& placement,
                                  std::span<const Index> start, const PasteEffort& effort,
                                  const Context& context) {
    const auto place_over = [&](AlteredTarget base) {
        place_on(std::move(base), placement, start, effort, context);
        const Region under = under_boundary(ground, placement, context);
        place_on_cleared(ground, under, placement, start, effort, context);
    };
    try {
        return place_over(base_of(ground, placement, context));
    } catch (const Error& error) {
        const ErrorCode code = error.code();
        if (code != ErrorCode::boundary_conflict && code != ErrorCode::not_a_disk) throw;
    }
    gone.reset();
    clearing.reset();
    place_over(ground);
}

void Paste::State::place_on_altered(const PastePlacement& placement, std::span<const Index> start,
                                    const PasteEffort& effort, const Context& context) {
    const AlteredTarget ground = roomy(placement, context);
    all_or_nothing([&] {
        if (options.cleared) {
            place_on(without_cleared(ground, context), placement, start, effort, context);
        } else if (options.clear) {
            place_clearing(ground, placement, start, effort, context);
        } else {
            place_on(ground, placement, start, effort, context);
        }
    });
}

void Paste::State::note_cleared(const ClearedTarget& next) {
    gone = on_given(next.gone, given);
    clearing = next.found;
}

// The target without the features that it was asked to be cleared of.
AlteredTarget Paste::State::without_cleared(const AlteredTarget& ground, const Context& context) {
    require_same_topology(given, options.cleared->topology(), "the region to clear");
    const Region region =
        ground.map ? carried(*options.cleared, ground.mesh, *ground.map) : *options.cleared;
    ClearedTarget next = cleared_target(ground.mesh, ground.onto, region, context);
    note_cleared(next);
    return after(ground, std::move(next));
}

// The surface that features within the part's reach stand on, as far as it is known: of those that
// an erasure leaves, the first that is as even as the surface around, or the most even one.
AlteredTarget Paste::State::base_of(const AlteredTarget& ground, const PastePlacement& placement,
                                    const Context& context) const {
    const SurfacePoint point = SpatialTree(ground.mesh, context).nearest(placement.at);
    std::optional<ClearedTarget> best;
    for (const double part : kBaseReaches) {
        if (best && best->unevenness <= 1.0) break;
        std::optional<ClearedTarget> next =
            cleared_around(ground.mesh, ground.onto, point, part * reach_of(placement), context);
        if (next && (!best || next->unevenness < best->unevenness)) best = std::move(next);
    }
    return best ? after(ground, *std::move(best)) : ground;
}

// A line over the patch in place of a removed feature would cut through that: by how much the
// feature's surface turns there, and how high it is.
std::vector<double> Paste::State::relief_of(const PasteChart& chart,
                                            const PastePlacement& placement,
                                            const Context& context) const {
    const SpatialTree standing(given, context);
    const std::vector<Vec3> normals = vertex_normals(given);
    const double reach = reach_of(placement);
    std::vector<double> relief;
    relief.reserve(chart.map.vertex.size());
    for (const Index v : chart.map.vertex) {
        const SurfacePoint found = standing.nearest(target.position(v));
        Vec3 normal = Vec3::Zero();
        for (int k = 0; k < 3; ++k) {
            normal += found.barycentric[k] * normals[at(found.triangle[at(k)])];
        }
        const double turn = (normal.normalized() - surfaces->target_normals[at(v)]).norm();
        const bool stays = found.distance <= kOnSurface * reach;
        relief.push_back(stays ? 0.0 : turn + kHeightOfRelief * found.distance / reach);
    }
    return relief;
}

std::optional<std::vector<SharpEdge>> Paste::State::edges_left(const Context& context) {
    if (!gone) return std::nullopt;
    if (!given_edges) given_edges = sharp_edges(given, context);
    const std::vector<char> cleared = gone->mask();
    const SpatialTree piece(target_piece(context).mesh(), context);
    const auto lies_on_piece = [&](const SharpEdge& edge) {
        const double least = kOnPiece * (edge.to - edge.from).norm();
        return piece.nearest(edge.from).distance <= least &&
               piece.nearest(edge.to).distance <= least;
    };
    std::vector<SharpEdge> left = *given_edges;
    std::erase_if(left, [&](const SharpEdge& edge) {
        return cleared[at(edge.first)] || cleared[at(edge.second)] || !lies_on_piece(edge);
    });
    return left;
}

std::vector<Vec2> Paste::State::boundary_in_plane() const {
    std::vector<Vec2> line;
    if (placed.line) {
        for (const RingPoint& point : placed.line->points) line.push_back(point.image.uv);
        return line;
    }
    for (const Index v : placed.loop.vertices) {
        line.push_back(placed.images[at(source_map.place_of(v))].uv);
    }
    return line;
}

// The part of a target under the present boundary.
Region Paste::State::under_boundary(const AlteredTarget& ground, const PastePlacement& placement,
                                    const Context& context) const {
    const SurfacePoint point = SpatialTree(ground.mesh, context).nearest(placement.at);
    return region_under_line(ground.mesh, point.face, *used->map, boundary_in_plane(), context);
}

void Paste::State::place_on_cleared(const AlteredTarget& ground, const Region& under,
                                    const PastePlacement& placement, std::span<const Index> start,
                                    const PasteEffort& effort, const Context& context) {
    std::optional<ClearedTarget> next = cleared_inside(ground.mesh, ground.onto, under, context);
    if (!next) return place_on(ground, placement, start, effort, context);
    note_cleared(*next);
    const PlacedFeature former = placed;
    // The boundary keeps its place: elsewhere it would run over features that stayed.
    PasteEffort there;
    there.line = former.line ? &*former.line : nullptr;
    there.like = &former;
    PastePlacement fixed = placement;
    fixed.angle = former.angle;
    const AlteredTarget cleared = after(ground, std::move(*next));
    place_on(cleared, fixed, former.loop.vertices, there, context);
    if (crosses_itself(boundary_in_plane())) place_on(cleared, fixed, start, effort, context);
    placed.placement = placement;
    placed.angle_chosen = former.angle_chosen;
    placed.upright = former.upright;
}

void Paste::State::clear_under_boundary(const PasteEffort& effort, const Context& context) {
    PastePlacement fixed = placed.placement;
    fixed.angle = placed.angle;
    const PlacedFeature before = placed;
    const AlteredTarget ground = roomy(fixed, context);
    const Region under = under_boundary(ground, fixed, context);
    try {
        all_or_nothing([&] { place_on_cleared(ground, under, fixed, {}, effort, context); });
    } catch (const Error& error) {
        // It stays cleared under the outline.
        const ErrorCode code = error.code();
        if (code == ErrorCode::cancelled || code == ErrorCode::memory_limit) throw;
        return;
    }
    placed.placement = before.placement;
    placed.angle_chosen = before.angle_chosen;
    placed.upright = before.upright;
}

}  // namespace lissom
