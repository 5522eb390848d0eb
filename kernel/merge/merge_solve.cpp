// Steps of every solve of a merge: correspondence, deformation of the source.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "kernel/deform/rotation/polar.h"
#include "kernel/merge/fitting.h"
#include "kernel/merge/loop/loop_fit.h"
#include "kernel/merge/loop/loop_values.h"
#include "kernel/merge/merge_stages.h"
#include "kernel/merge/turned.h"

namespace lissom {
namespace {

// Converts a key on the given mesh to one on the loop in use: on a changed boundary, the place
// nearest to it.
Key worked_key(const Key& key, const GivenLoop& given, const Loop& loop, std::size_t number,
               const char* side) {
    const Index* vertex = std::get_if<Index>(&key);
    if (!vertex) return key;
    const auto at = std::find(given.vertices.begin(), given.vertices.end(), *vertex);
    if (at != given.vertices.end()) {
        double distance = 0.0;
        const std::size_t k = at - given.vertices.begin();
        return point_of(loop.points(), loop.nearest(given.points[k], distance));
    }
    Elements elements{ElementKind::vertex, 0, {}};
    elements.add(*vertex);
    throw Error(ErrorCode::key_conflict,
                "key " + std::to_string(number + 1) + " is " + describe(elements) +
                    ", which is not on the " + side +
                    "'s boundary; choose one of its vertices, or give a point",
                elements);
}

// Number of the vertex nearest to a parameter of a loop.
Index nearest_vertex(const Loop& loop, double parameter) {
    const LoopPoint at = loop.place_at(parameter);
    return (at.segment + (at.t > 0.5 ? 1 : 0)) % loop.size();
}

// Keys of one join on its loops, and, for overlapping regions, the vertex of the target's boundary
// at the first.
struct PlacedKeys {
    std::vector<ParameterPair> parameters;
    Index start = 0;
};

// The cut of the target's region carries the first key to the far end, and arc length the others.
void carry_to_end(const OverlapTransition& transition, const Overlap& overlap, const Loop& end,
                  std::size_t join, PlacedKeys& keys) {
    const Loop& loop = overlap.curves[join];
    const OverlapTarget& whole = overlap.target;
    keys.start = nearest_vertex(loop, keys.parameters.front().target);
    const Index at = transition.cut_from(whole, loop.vertices(), keys.start);
    const std::vector<Index>& ends = whole.ends[join];
    const std::size_t place = std::find(ends.begin(), ends.end(), at) - ends.begin();
    const double shift = end.parameters()[place] - loop.parameters()[keys.start];
    for (ParameterPair& key : keys.parameters) {
        key.target += shift - std::floor(key.target + shift);
    }
}

PlacedKeys placed_keys(const GivenMeshes& meshes, const Boundaries& from, const MergeMethod& method,
                       std::size_t join, std::span<const KeyPair> given) {
    const Loop& source = from.source_curves[join];
    const Loop& target = from.overlap ? from.overlap->curves[join] : from.target_curves[join];
    std::vector<KeyPair> keys;
    for (std::size_t k = 0; k < given.size(); ++k) {
        keys.push_back(
            {worked_key(given[k].source, meshes.source_loops[join], source, k, "source"),
             worked_key(given[k].target, meshes.target_loops[join], target, k, "target")});
    }
    PlacedKeys placed{key_parameters(source, target, keys), 0};
    if (from.overlap && !keys.empty()) {
        carry_to_end(*method.overlap, *from.overlap, from.target_curves[join], join, placed);
    }
    return placed;
}

// The similarity that moves a feature as the surface around it would have moved it.
BoundaryValue common_value(const Mesh& mesh, const Region& feature, const Region& region,
                           const BoundaryDeformation& free, Vec3& rest_center) {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    std::vector<std::size_t> rows;
    for (const Index v : feature.vertices()) {
        const auto& ids = region.vertices();
        rows.push_back(at(std::lower_bound(ids.begin(), ids.end(), v) - ids.begin()));
        from += mesh.position(v) / feature.size();
        to += free.positions[rows.back()] / feature.size();
    }
    Mat3 products = Mat3::Zero(), turn = Mat3::Zero();
    double logs = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Vec3 a = mesh.position(feature.vertices()[i]) - from;
        products += (free.positions[rows[i]] - to) * a.transpose();
        turn += free.transforms[rows[i]];
        logs += std::log(uniform_scale(free.transforms[rows[i]]));
    }
    // If its points leave the rotation open, the mean of its gradients gives it.
    const double size = products.norm();
    if (size > 0.0) products /= size;
    products += 1e-3 * turn / turn.norm();
    rest_center = from;
    return {to, nearest_rotation(products), std::exp(logs / rows.size())};
}

// Tells how a join without keys was placed.
void note_place(Place place, const FoundPlaces& found, std::size_t j, JoinReport& join,
                std::vector<std::string>& warnings) {
    join.placed = found.by;
    join.certainty = found.certainty[j];
    join.any_turn = found.any_turn;
    join.guessed = found.by == Placing::shape || join.certainty < kCertain;
    const std::string name = "join " + std::to_string(j + 1) + ": ";
    if (found.by == Placing::shape && place == Place::as_placed) {
        warnings.push_back(name +
                           "the source must be turned over to meet the target, so that how it lies "
                           "does not say which way it belongs; the shapes decide");
    }
    if (found.off_shape > 0.0) {
        char angle[64];
        std::snprintf(angle, sizeof angle, "%.0f degrees from the turn", found.off_shape / kDegree);
        warnings.push_back(name + "as it lies, the source is " + angle +
                           " that the shapes of both parts suggest, so that it may look the wrong "
                           "way; turn it round, give a key, or use place = \"shape\"");
    }
    if (join.any_turn) {
        warnings.push_back(name + "the parts are round, any turn fits; give a key to choose one");
    } else if (join.certainty < kCertain) {
        warnings.push_back(name +
                           "the match of the boundaries is a guess; give it one key, or say which "
                           "directions of both models belong together");
    }
}

KeyPair key_of(const Loop& source, const Loop& target, const ParameterPair& key) {
    return {point_of(source.points(), source.place_at(key.source)),
            point_of(target.points(), target.place_at(key.target))};
}

Vec3 rotation_vector(const Mat3& rotation) {
    const Eigen::AngleAxisd turn(rotation);
    return turn.angle() * turn.axis();
}

void turn_as(const CurveFit& fit, std::vector<BoundaryValue>& values) {
    for (BoundaryValue& value : values) {
        value.rotation = fit.map.rotation;
        value.scale = fit.map.scale;
    }
}

// One value a held vertex; those not on a loop stay as they are.
std::vector<BoundaryValue> values_of(const Boundaries& from, const LoopValueOptions& options,
                                     std::span<const LoopPair> pairs,
                                     std::span<const std::optional<CurveFit>> fits,
                                     const Region& held) {
    const std::vector<Index>& ids = held.vertices();
    std::vector<BoundaryValue> values;
    for (const Index v : ids) {
        values.push_back({from.source.mesh.position(v), Mat3::Identity(), 1.0});
    }
    for (std::size_t j = 0; j < pairs.size(); ++j) {
        const LoopPair& pair = pairs[j];
        std::vector<BoundaryValue> loop =
            loop_values(from.source_curves[j], from.target_curves[j], pair, options);
        if (!fits.empty() && fits[j]) turn_as(*fits[j], loop);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            values[std::lower_bound(ids.begin(), ids.end(), pair.source[i]) - ids.begin()] =
                loop[i];
        }
    }
    return values;
}

// All of the region under one similarity.
BoundaryDeformation laid(const Mesh& mesh, const Region& region, const CurveFit& fit) {
    BoundaryDeformation result;
    for (const Index v : region.vertices()) {
        result.positions.push_back(fit(mesh.position(v)));
    }
    result.transforms.assign(result.positions.size(), fit.map.scale * fit.map.rotation);
    return result;
}

// Vertices of the source with their positions, and rotation and scale of the surface there.
struct SourceMotion {
    Region region;
    BoundaryDeformation deformed;
};

// A part of the source without a join goes as a whole with the row that is nearest to its middle.
void follow(const Mesh& mesh, const Region& moved, const BoundaryDeformation& deformed,
            const std::vector<Index>& part, BoundaryDeformation& whole) {
    Vec3 center = Vec3::Zero();
    for (const Index v : part) center += mesh.position(v) / count_of(part);
    const std::vector<Index>& ids = moved.vertices();
    std::size_t nearest = 0;
    const auto distance = [&](std::size_t row) {
        return (mesh.position(ids[row]) - center).squaredNorm();
    };
    for (std::size_t row = 1; row < ids.size(); ++row) {
        if (distance(row) < distance(nearest)) nearest = row;
    }
    const Vec3& from = mesh.position(ids[nearest]);
    const Mat3& transform = deformed.transforms[nearest];
    for (const Index v : part) {
        whole.positions[at(v)] =
            deformed.positions[nearest] + transform * (mesh.position(v) - from);
        whole.transforms[at(v)] = transform;
    }
}

// Parts without a join move along; in the fixed configuration they stay.
SourceMotion motion_of(const Mesh& mesh, const Region& region, Configuration configuration,
                       BoundaryDeformation deformed) {
    const bool stays = configuration == Configuration::fixed;
    if (stays || region.size() == mesh.vertex_count()) return {region, std::move(deformed)};
    SourceMotion motion{Region::all(mesh.shared_topology()), {}};
    BoundaryDeformation& whole = motion.deformed;
    whole.positions.assign(mesh.positions().begin(), mesh.positions().end());
    whole.transforms.assign(whole.positions.size(), Mat3::Identity());
    for (std::size_t row = 0; row < region.vertices().size(); ++row) {
        whole.positions[at(region.vertices()[row])] = deformed.positions[row];
        whole.transforms[at(region.vertices()[row])] = deformed.transforms[row];
    }
    std::map<Index, std::vector<Index>> loose;
    for (const Index v : region.inverted().vertices()) {
        loose[mesh.topology().components()[at(v)]].push_back(v);
    }
    for (const auto& entry : loose) follow(mesh, region, deformed, entry.second, whole);
    return motion;
}

// The thesis's transition, if it is asked for.
std::shared_ptr<OverlapMerge> overlap_merge(const Boundaries& from, const MergeOptions& options,
                                            const Matching& matching, const Context& context) {
    const OverlapTransition* overlap = method_of(options).overlap;
    if (!overlap) return nullptr;
    const bool scales = options.configuration == Configuration::free;
    std::vector<OverlapJoin> joins;
    for (std::size_t j = 0; j < matching.pairs.size(); ++j) {
        joins.push_back({matching.pairs[j], matching.starts[j], matching.overlap_starts[j],
                         scales ? matching.joins[j].scale : 1.0, options.source_transition});
    }
    return overlap->begin(from.overlap->target, from.target, from.source.mesh, std::move(joins),
                          options.transition_weight, context);
}

}  // namespace

std::vector<ParameterPair> parameters_of(const GivenMeshes& given, const Boundaries& boundaries,
                                         const MergeMethod& method, std::size_t join,
                                         std::span<const KeyPair> keys) {
    return placed_keys(given, boundaries, method, join, keys).parameters;
}

namespace {

// Keys of one join, and how its parts fit.
struct MatchedKeys {
    std::vector<ParameterPair> keys;
    std::optional<CurveFit> fit;
};

// How the parts of a join fit with its keys, or near a place that was found.
std::optional<CurveFit> fit_of(const Boundaries& from, const MergeOptions& options, std::size_t j,
                               std::span<const ParameterPair> keys, const FoundPlaces* found) {
    if (options.thesis) return std::nullopt;
    const FitSides sides{from.source.mesh, from.target, from.source_curves[j],
                         from.target_curves[j]};
    const Configuration configuration = options.configuration;
    if (!found) return part_fit(sides, keys, configuration);
    if (configuration == Configuration::fixed) return std::nullopt;
    if (found->by == Placing::shape) {
        if (auto fit = only_part_fit(sides)) return fit;
    }
    return part_fit_near(sides, found->keys[j]);
}

// The key that says how a fit turns the source.
ParameterPair key_of(const CurveFit& fit, const Loop& source, const Loop& target) {
    return {source.parameters().front(), target.parameter_of(fit.pair.on_target.front())};
}

// Parts that fit as they lie need no place; `find` is called if keys are missing.
template <typename Find>
MatchedKeys matched_keys(const Boundaries& from, const MergeOptions& options, std::size_t j,
                         std::vector<ParameterPair> keys, const Find& find, Matching& matching) {
    JoinReport& join = matching.joins[j];
    MatchedKeys matched{std::move(keys), {}};
    matched.fit = fit_of(from, options, j, matched.keys, nullptr);
    if (!matched.keys.empty()) return matched;
    join.placed = Placing::as_placed;
    if (!matched.fit) {
        const FoundPlaces& found = find();
        matched.fit = fit_of(from, options, j, {}, &found);
        matched.keys = {found.keys[j]};
        note_place(options.place, found, j, join, matching.warnings);
    }
    if (matched.fit) {
        matched.keys = {key_of(*matched.fit, from.source_curves[j], from.target_curves[j])};
    }
    return matched;
}

// Returns one pair of loops, and fills in its report.
LoopPair matched_loops(const Boundaries& from, LoopMeasure measure, std::size_t j,
                       const MatchedKeys& matched, JoinReport& join) {
    const Loop &source = from.source_curves[j], &target = from.target_curves[j];
    join.subdivided = from.refined[j] != 0;
    join.target_subdivided = from.target_refined[j] != 0;
    join.source_size = source.size();
    join.target_size = target.size();
    join.fits = matched.fit.has_value();
    join.scale = matched.fit ? matched.fit->map.scale : loop_scale(source, target);
    LoopPair pair =
        matched.fit ? matched.fit->pair
                    : corresponding(source, target, matched.keys, measure == LoopMeasure::robust);
    if (!from.overlap) join.key = key_of(source, target, matched.keys.front());
    join.turn = rotation_vector(similarity_of(source, target, pair).rotation);
    return pair;
}

// Only the fixed configuration can do nothing about it.
void note_same_side(const Boundaries& from, const GivenLoop& given, std::size_t j,
                    Matching& matching) {
    JoinReport& join = matching.joins[j];
    join.same_side =
        !join.fits && on_same_side(from.source_curves[j], from.target_curves[j], matching.pairs[j]);
    if (!join.same_side) return;
    Elements elements{ElementKind::vertex, 0, {}};
    for (const Index v : given.vertices) elements.add(v);
    matching.warnings.push_back(
        "join " + std::to_string(j + 1) + ": the source's boundary at " + describe(elements) +
        " has the source on the same side as the target, so that the source turns over to meet "
        "it; turn the source round, move it to the other side, or use the free configuration");
}

}  // namespace

Matching match_boundaries(const GivenMeshes& given, const Boundaries& boundaries,
                          const MergeOptions& options, std::vector<JoinReport> joins,
                          std::span<const std::vector<KeyPair>> keys,
                          const std::function<FoundPlaces()>& find) {
    std::optional<FoundPlaces> found;
    const auto find_once = [&]() -> const FoundPlaces& {
        if (!found) found = find();
        return *found;
    };
    const MergeMethod method = method_of(options);
    Matching result;
    result.joins = std::move(joins);
    for (std::size_t j = 0; j < keys.size(); ++j) {
        PlacedKeys placed = placed_keys(given, boundaries, method, j, keys[j]);
        result.overlap_starts.push_back(placed.start);
        const Loop& source = boundaries.source_curves[j];
        result.starts.push_back(placed.parameters.empty()
                                    ? 0
                                    : nearest_vertex(source, placed.parameters.front().source));
        MatchedKeys matched =
            matched_keys(boundaries, options, j, std::move(placed.parameters), find_once, result);
        result.pairs.push_back(
            matched_loops(boundaries, method.loops, j, matched, result.joins[j]));
        result.fits.push_back(std::move(matched.fit));
        if (options.configuration == Configuration::fixed) {
            note_same_side(boundaries, given.source_loops[j], j, result);
        }
    }
    return result;
}

BoundaryDeformation deformed_by(const Boundaries& from, const SourceSystem& system,
                                const LoopValueOptions& how, std::span<const LoopPair> pairs,
                                std::span<const std::optional<CurveFit>> fits,
                                const Context& context) {
    if (const auto fit = common_fit(fits, from.source_curves, from.target_curves)) {
        return laid(from.source.mesh, system.deformer->region(), *fit);
    }
    BoundaryDeformer& deformer = *system.deformer;
    BoundaryDeformation deformed =
        deformer.solve(values_of(from, how, pairs, fits, deformer.held()), context);
    if (!system.featured) return deformed;
    BoundaryDeformer& featured = *system.featured;
    const Mesh& mesh = from.source.mesh;
    std::vector<BoundaryValue> values = values_of(from, how, pairs, fits, featured.held());
    const std::vector<Index>& ids = featured.held().vertices();
    for (const Region& feature : system.features) {
        Vec3 center;
        const BoundaryValue move = common_value(mesh, feature, featured.region(), deformed, center);
        for (const Index v : feature.vertices()) {
            const Vec3 arm = mesh.position(v) - center;
            values[std::lower_bound(ids.begin(), ids.end(), v) - ids.begin()] = {
                move.position + move.scale * (move.rotation * arm), move.rotation, move.scale};
        }
    }
    BoundaryDeformation result = featured.solve(values, context);
    result.seconds.first += deformed.seconds.first;
    result.seconds.polar += deformed.seconds.polar;
    result.seconds.second += deformed.seconds.second;
    return result;
}

DeformedSource deform_source(const Boundaries& boundaries, const SourceSystem& system,
                             const MergeOptions& options, const Matching& matching,
                             const Context& context) {
    const Mesh& rest = boundaries.source.mesh;
    const Region& region = system.deformer->region();
    BoundaryDeformation deformed = deformed_by(boundaries, system, method_of(options).values,
                                               matching.pairs, matching.fits, context);
    DeformedSource result{rest, deformed.seconds,
                          overlap_merge(boundaries, options, matching, context)};
    if (result.overlap) {
        deformed = result.overlap->deform(region, *system.kept, deformed, context);
    }
    const SourceMotion motion = motion_of(rest, region, options.configuration, std::move(deformed));
    std::vector<Vec3> positions(rest.positions().begin(), rest.positions().end());
    for (std::size_t row = 0; row < motion.deformed.positions.size(); ++row) {
        positions[at(motion.region.vertices()[row])] = motion.deformed.positions[row];
    }
    result.source.set_positions(std::move(positions));
    turn_directions(rest, motion.region, motion.deformed, result.source);
    return result;
}

}  // namespace lissom
