#include "kernel/merge/merge.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "kernel/deform/polar.h"
#include "kernel/deform/rest_directions.h"
#include "kernel/merge/automatic_keys.h"
#include "kernel/merge/fair_seam.h"
#include "kernel/merge/loop.h"
#include "kernel/merge/loop_values.h"
#include "kernel/merge/merge_side.h"
#include "kernel/merge/provenance.h"
#include "kernel/merge/thesis_merge.h"
#include "kernel/mesh/append.h"
#include "kernel/mesh/distances.h"
#include "kernel/mesh/measures.h"

namespace lissom {
namespace {

// Edges of the source's boundary this many times as long as those they meet are coarse.
constexpr double kCoarse = 1.5;
// Below this the guessed place of a join is as good as another.
constexpr double kCertain = 1.5;
// How far the source deforms in the fixed configuration, in radii of its largest boundary.
constexpr double kReach = 3.0;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string degrees(double radians) {
    char text[16];
    std::snprintf(text, sizeof text, "%.0f", radians * 180.0 / kPi);
    return text;
}

void require_options(const MergeOptions& options, std::size_t joins, std::size_t targets) {
    const auto require = [](bool holds, const char* message) {
        if (!holds) throw Error(ErrorCode::invalid_argument, message);
    };
    require(targets > 0, "a merge needs a target");
    require(joins > 0, "a merge needs at least one join of two boundaries");
    require(options.smooth >= 0, "the number of smoothing steps must not be negative");
    require(options.source_transition >= 0.0 && options.target_transition >= 0.0 &&
                std::isfinite(options.source_transition + options.target_transition),
            "widths of transition regions must be finite and not negative");
    require(!options.reach || *options.reach > 0.0, "the reach of a merge must be above 0");
    require(options.greatest_turn >= 0.0, "the greatest turn must not be negative");
    const bool stays = options.configuration == Configuration::fixed;
    require(stays || !options.reach,
            "a reach applies to the fixed configuration; in the free one all of the source moves");
    require(stays || options.turn_frames,
            "frames that keep their directions apply to the fixed configuration");
}

void require_distinct(const Mesh& source, std::span<const Mesh* const> targets) {
    for (std::size_t t = 0; t < targets.size(); ++t) {
        if (targets[t] == &source) {
            throw Error(ErrorCode::boundary_conflict,
                        "source and target are one mesh; merge a copy of it");
        }
        const auto earlier = targets.first(t);
        if (std::find(earlier.begin(), earlier.end(), targets[t]) != earlier.end()) {
            throw Error(ErrorCode::boundary_conflict,
                        "a mesh is given as a target twice; give it once, for all of its joins");
        }
    }
}

// Vertices of the parts of a mesh that the given loops bound.
Region joined_parts(const Mesh& mesh, const std::vector<std::vector<Index>>& loops) {
    const std::vector<Index>& part = mesh.topology().components();
    std::vector<char> joined(static_cast<std::size_t>(mesh.topology().component_count()), 0);
    for (const std::vector<Index>& loop : loops) joined[part[loop.front()]] = 1;
    std::vector<Index> vertices;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (joined[part[v]]) vertices.push_back(v);
    }
    return Region(mesh.shared_topology(), std::move(vertices));
}

Region region_of_loops(const Mesh& mesh, const std::vector<std::vector<Index>>& loops) {
    std::vector<Index> vertices;
    for (const std::vector<Index>& loop : loops) {
        vertices.insert(vertices.end(), loop.begin(), loop.end());
    }
    return Region(mesh.shared_topology(), std::move(vertices));
}

// The place of a boundary's vertices in the mesh that was given.
struct GivenLoop {
    std::vector<Index> vertices;
    std::vector<Vec3> points;
};

std::vector<GivenLoop> given_loops(const Mesh& mesh, const MergeSide& side) {
    std::vector<GivenLoop> result;
    for (const std::vector<Index>& loop : side.loops) {
        GivenLoop& given = result.emplace_back();
        given.vertices = loop;
        for (const Index v : loop) given.points.push_back(mesh.position(v));
    }
    return result;
}

// A key on the mesh that was given as a key on the loop that is worked with: where the boundary has
// been changed, the place nearest to it.
Key worked_key(const Key& key, const GivenLoop& given, const Loop& loop, std::size_t number,
               const char* side) {
    const Index* vertex = std::get_if<Index>(&key);
    if (!vertex) return key;
    const auto at = std::find(given.vertices.begin(), given.vertices.end(), *vertex);
    if (at != given.vertices.end()) {
        double distance = 0.0;
        const auto k = static_cast<std::size_t>(at - given.vertices.begin());
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

void require_apart(const Region& feature, const Region& others, const MergeSide& side,
                   const std::string& why) {
    const Region common = feature.intersected(others);
    if (common.empty()) return;
    Elements elements{ElementKind::vertex, 0, {}};
    for (const Index v : common.vertices()) elements.add(side.map.vertices.main_source(v));
    throw Error(ErrorCode::handle_overlap, "a fixed feature covers " + describe(elements) + why,
                elements);
}

// The similarity that moves a feature as the surface around it would have moved it.
BoundaryValue common_value(const Mesh& mesh, const Region& feature, const Region& region,
                           const BoundaryDeformation& free, Vec3& rest_center) {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    std::vector<std::size_t> rows;
    for (const Index v : feature.vertices()) {
        const auto& ids = region.vertices();
        rows.push_back(
            static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), v) - ids.begin()));
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
    // Where its points do not say how it turns, the mean of its gradients does.
    const double size = products.norm();
    if (size > 0.0) products /= size;
    products += 1e-3 * turn / turn.norm();
    rest_center = from;
    return {to, nearest_rotation(products), std::exp(logs / static_cast<double>(rows.size()))};
}

}  // namespace

struct Merge::State {
    State(const Mesh& given_source, std::span<const Mesh* const> given_targets,
          std::vector<Join> asked, const MergeOptions& chosen, const Context& context);

    void make_sides(const Mesh& given_source, std::span<const Mesh* const> given_targets,
                    const Context& context);
    void note_flips();
    void note_trims(const MergeSide& side, const char* name);
    void combine(std::span<const Mesh* const> given_targets, std::vector<MergeSide>& sides,
                 const Context& context);
    void make_loops();
    void refine_coarse(const Context& context);
    void carry_features();
    Region deforming() const;
    void prepare(const Context& context);

    std::vector<ParameterPair> keys_of(std::size_t join) const;
    std::vector<LoopPair> correspond(MergeReport& now) const;
    std::vector<BoundaryValue> values_of(const std::vector<LoopPair>& pairs,
                                         const Region& held) const;
    BoundaryDeformation deform(const std::vector<LoopPair>& pairs, const Context& context);
    std::vector<Vec3> all_positions(const BoundaryDeformation& deformed) const;
    void follow(const BoundaryDeformation& deformed, std::vector<Vec3>& positions) const;
    SewOptions sewing() const;
    std::vector<FacePair> new_intersections(const Sewn& sewn, const Context& context) const;
    FacePair origin_of(const Sewn& sewn, const FacePair& pair) const;
    std::vector<FacePair> own_intersections(const Sewn& sewn, const std::vector<FacePair>& pairs,
                                            const Context& context) const;
    std::optional<ThesisMerge> thesis_merge(const std::vector<LoopPair>& pairs,
                                            const MergeReport& now, const Context& context) const;
    void finish_seams(Sewn& sewn, const std::optional<ThesisMerge>& thesis, MergeReport& now,
                      const Context& context) const;
    void turn_directions(const BoundaryDeformation& deformed, Mesh& moved) const;

    MergeOptions options;
    std::vector<Join> joins;
    /// Boundaries as given, by join; the source's side, and the targets appended to one mesh.
    std::vector<GivenLoop> given_source_loops, given_target_loops;
    MergeSide source;
    Mesh target;
    MeshMap target_map;
    /// Counts of the elements of the targets as given, together.
    std::shared_ptr<const Topology> given_target_topology;
    std::vector<std::vector<Index>> target_loops;
    /// Loops by join, the source's run the other way so that both run the same way.
    std::vector<Loop> source_curves, target_curves;
    std::vector<Region> features;
    MergeReport report;
    std::unique_ptr<BoundaryDeformer> deformer;
    /// With the features of a free configuration held as well.
    std::unique_ptr<BoundaryDeformer> featured;
};

Merge::State::State(const Mesh& given_source, std::span<const Mesh* const> given_targets,
                    std::vector<Join> asked, const MergeOptions& chosen, const Context& context)
    : options(chosen), joins(std::move(asked)) {
    Progress progress(context, "merge: prepare");
    const auto start = Clock::now();
    require_options(options, joins.size(), given_targets.size());
    require_distinct(given_source, given_targets);
    for (const Region& feature : options.fixed) {
        require_same_topology(given_source, feature.topology(), "a fixed feature of the source");
    }
    make_sides(given_source, given_targets, context);
    progress.step(0.3);
    make_loops();
    refine_coarse(context);
    carry_features();
    progress.step(0.7);
    prepare(context);
    report.prepare_seconds = seconds_since(start);
}

void Merge::State::note_flips() {
    if (report.source_flipped) {
        report.warnings.push_back("the source was inside out and has been turned over");
    }
    for (const Index t : report.targets_flipped) {
        report.warnings.push_back("target " + std::to_string(t + 1) +
                                  " was inside out and has been turned over");
    }
}

void Merge::State::note_trims(const MergeSide& side, const char* name) {
    for (std::size_t k = 0; k < side.loops.size(); ++k) {
        if (!side.trimmed[k]) continue;
        report.warnings.push_back(std::string("a boundary of the ") + name + " was jagged (" +
                                  degrees(side.turns[k]) +
                                  " degrees at each vertex) and has been trimmed");
    }
    for (const std::string& reason : side.untrimmed) {
        report.warnings.push_back(std::string("a boundary of the ") + name +
                                  " is jagged and could not be trimmed: " + reason);
    }
}

void Merge::State::make_sides(const Mesh& given_source, std::span<const Mesh* const> given_targets,
                              const Context& context) {
    report.joins.resize(joins.size());
    std::vector<Path> source_paths;
    std::vector<std::vector<Path>> target_paths(given_targets.size());
    std::vector<std::size_t> place;
    for (const Join& join : joins) {
        if (join.target_mesh < 0 || join.target_mesh >= static_cast<Index>(given_targets.size())) {
            throw Error(ErrorCode::out_of_range, "a join names a target that does not exist");
        }
        source_paths.push_back(join.source);
        place.push_back(target_paths[join.target_mesh].size());
        target_paths[join.target_mesh].push_back(join.target);
    }
    source = make_side(given_source, source_paths, "source");
    given_source_loops = given_loops(given_source, source);
    orient(source, context);
    report.source_flipped = source.flipped;
    std::vector<MergeSide> sides;
    given_target_loops.resize(joins.size());
    for (std::size_t t = 0; t < given_targets.size(); ++t) {
        MergeSide& side =
            sides.emplace_back(make_side(*given_targets[t], target_paths[t], "target"));
        const std::vector<GivenLoop> given = given_loops(*given_targets[t], side);
        for (std::size_t j = 0; j < joins.size(); ++j) {
            if (joins[j].target_mesh == static_cast<Index>(t)) {
                given_target_loops[j] = given[place[j]];
            }
        }
        orient(side, context);
        if (side.flipped) report.targets_flipped.push_back(static_cast<Index>(t));
    }
    note_flips();
    for (MergeSide& side : sides) {
        if (options.trim) trim_jagged(side, options.greatest_turn, context);
        note_trims(side, "target");
    }
    if (options.trim) trim_jagged(source, options.greatest_turn, context);
    note_trims(source, "source");
    for (std::size_t j = 0; j < joins.size(); ++j) {
        JoinReport& join = report.joins[j];
        const MergeSide& side = sides[joins[j].target_mesh];
        join.source_turn = source.turns[j];
        join.source_trimmed = source.trimmed[j] != 0;
        join.target_turn = side.turns[place[j]];
        join.target_trimmed = side.trimmed[place[j]] != 0;
    }
    combine(given_targets, sides, context);
    for (std::size_t j = 0; j < joins.size(); ++j) {
        Index shift = 0;
        for (Index t = 0; t < joins[j].target_mesh; ++t) shift += sides[t].mesh.vertex_count();
        std::vector<Index> loop = sides[joins[j].target_mesh].loops[place[j]];
        for (Index& v : loop) v += shift;
        target_loops.push_back(std::move(loop));
    }
}

// All targets as one mesh. Sides keep their numbers of elements.
void Merge::State::combine(std::span<const Mesh* const> given_targets,
                           std::vector<MergeSide>& sides, const Context& context) {
    target = sides.front().mesh;
    target_map = sides.front().map;
    Mesh given = *given_targets.front();
    for (std::size_t t = 1; t < sides.size(); ++t) {
        target_map = appended_map(target_map, sides[t].map, given.topology());
        append(target, sides[t].mesh, context);
        append(given, *given_targets[t], context);
    }
    given_target_topology = given.shared_topology();
}

void Merge::State::make_loops() {
    source_curves.clear();
    target_curves.clear();
    for (std::size_t j = 0; j < joins.size(); ++j) {
        std::vector<Index> reversed(source.loops[j].rbegin(), source.loops[j].rend());
        source_curves.emplace_back(source.mesh, std::move(reversed));
        target_curves.emplace_back(target, target_loops[j]);
    }
}

void Merge::State::refine_coarse(const Context& context) {
    if (!options.refine) return;
    for (std::size_t j = 0; j < joins.size(); ++j) {
        const Loop &from = source_curves[j], &to = target_curves[j];
        const double scale = loop_scale(from, to);
        const double edge = scale * from.length() / from.size(), other = to.length() / to.size();
        if (edge <= kCoarse * other) continue;
        refine_loop(source, j, context);
        report.joins[j].refined = true;
    }
    make_loops();
}

// Features on parts without a join need no care: these go as a whole, or stay.
void Merge::State::carry_features() {
    const Region loops = region_of_loops(source.mesh, source.loops);
    const Region parts = joined_parts(source.mesh, source.loops);
    Region taken = Region::none(source.mesh.shared_topology());
    for (const Region& given : options.fixed) {
        const Region feature = source.carried(given).intersected(parts);
        require_apart(feature, loops, source,
                      " of a boundary that is joined; take these vertices out of it");
        if (options.configuration == Configuration::free) {
            require_apart(feature, taken, source,
                          " of another, and each moves on its own; make them one feature");
        }
        taken = taken.united(feature);
        if (!feature.empty()) features.push_back(feature);
    }
}

// The part of the source that moves, with what holds it.
Region Merge::State::deforming() const {
    const Region parts = joined_parts(source.mesh, source.loops);
    if (options.configuration == Configuration::free) return parts;
    double reach = options.reach.value_or(0.0);
    if (!options.reach) {
        if (!features.empty()) return parts;
        for (const Loop& loop : source_curves) reach = std::max(reach, kReach * loop.radius());
    }
    const Region loops = region_of_loops(source.mesh, source.loops);
    const std::vector<double> distance = edge_distances(source.mesh, loops.vertices(), reach);
    std::vector<Index> near;
    for (const Index v : parts.vertices()) {
        if (distance[v] <= reach) near.push_back(v);
    }
    return Region(source.mesh.shared_topology(), std::move(near));
}

void Merge::State::prepare(const Context& context) {
    const BoundaryDeformOptions how =
        options.thesis ? BoundaryDeformOptions::thesis() : BoundaryDeformOptions{};
    const Region region = deforming();
    const Region loops = region_of_loops(source.mesh, source.loops);
    Region held = loops, with_features = loops;
    for (const Region& feature : features) {
        with_features = with_features.united(feature.intersected(region));
    }
    if (options.configuration == Configuration::fixed) held = with_features;
    deformer = std::make_unique<BoundaryDeformer>(source.mesh, region, held, how, context);
    if (options.configuration == Configuration::free && !features.empty()) {
        featured =
            std::make_unique<BoundaryDeformer>(source.mesh, region, with_features, how, context);
    }
    report.deform = deformer->stats();
}

std::vector<ParameterPair> Merge::State::keys_of(std::size_t join) const {
    std::vector<KeyPair> keys;
    for (std::size_t k = 0; k < joins[join].keys.size(); ++k) {
        const KeyPair& key = joins[join].keys[k];
        keys.push_back(
            {worked_key(key.source, given_source_loops[join], source_curves[join], k, "source"),
             worked_key(key.target, given_target_loops[join], target_curves[join], k, "target")});
    }
    return key_parameters(source_curves[join], target_curves[join], keys);
}

std::vector<LoopPair> Merge::State::correspond(MergeReport& now) const {
    std::vector<OffsetGuess> guesses;
    const bool guess =
        std::any_of(joins.begin(), joins.end(), [](const Join& join) { return join.keys.empty(); });
    if (guess) {
        std::vector<LoopJoin> loops;
        for (std::size_t j = 0; j < joins.size(); ++j) {
            loops.push_back({&source_curves[j], &target_curves[j]});
        }
        guesses = guess_offsets(loops);
    }
    std::vector<LoopPair> pairs;
    for (std::size_t j = 0; j < joins.size(); ++j) {
        std::vector<ParameterPair> keys = keys_of(j);
        JoinReport& join = now.joins[j];
        if (keys.empty()) {
            keys.push_back(guesses[j].key);
            join.guessed = true;
            join.certainty = guesses[j].certainty;
            if (join.certainty < kCertain) {
                now.warnings.push_back("join " + std::to_string(j + 1) +
                                       ": where the boundaries meet is a guess; give it one key");
            }
        }
        pairs.push_back(corresponding(source_curves[j], target_curves[j], keys));
        join.source_size = source_curves[j].size();
        join.target_size = target_curves[j].size();
        join.scale = loop_scale(source_curves[j], target_curves[j]);
    }
    return pairs;
}

// One value a held vertex; those not on a loop stay as they are.
std::vector<BoundaryValue> Merge::State::values_of(const std::vector<LoopPair>& pairs,
                                                   const Region& held) const {
    std::vector<BoundaryValue> values;
    for (const Index v : held.vertices()) {
        values.push_back({source.mesh.position(v), Mat3::Identity(), 1.0});
    }
    LoopValueOptions how;
    how.turn =
        options.configuration == Configuration::free || (options.turn_frames && !options.thesis);
    if (options.thesis) {
        how.sigma = 0.0;
        how.tangent_scales = true;
    }
    const std::vector<Index>& ids = held.vertices();
    for (std::size_t j = 0; j < joins.size(); ++j) {
        const std::vector<BoundaryValue> loop =
            loop_values(source_curves[j], target_curves[j], pairs[j], how);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Index v = pairs[j].source[i];
            values[static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), v) -
                                            ids.begin())] = loop[i];
        }
    }
    return values;
}

BoundaryDeformation Merge::State::deform(const std::vector<LoopPair>& pairs,
                                         const Context& context) {
    BoundaryDeformation deformed = deformer->solve(values_of(pairs, deformer->held()), context);
    if (!featured) return deformed;
    std::vector<BoundaryValue> values = values_of(pairs, featured->held());
    const std::vector<Index>& ids = featured->held().vertices();
    for (const Region& feature : features) {
        Vec3 center;
        const BoundaryValue move =
            common_value(source.mesh, feature, featured->region(), deformed, center);
        for (const Index v : feature.vertices()) {
            const Vec3 arm = source.mesh.position(v) - center;
            values[static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), v) -
                                            ids.begin())] = {
                move.position + move.scale * (move.rotation * arm), move.rotation, move.scale};
        }
    }
    return featured->solve(values, context);
}

// Parts of the source without a join go as a whole with what is nearest to them.
void Merge::State::follow(const BoundaryDeformation& deformed, std::vector<Vec3>& positions) const {
    const Topology& topology = source.mesh.topology();
    const Region& moved = deformer->region();
    if (options.configuration == Configuration::fixed || moved.size() == topology.vertex_count()) {
        return;
    }
    std::map<Index, std::vector<Index>> loose;
    for (const Index v : moved.inverted().vertices()) loose[topology.components()[v]].push_back(v);
    for (const auto& entry : loose) {
        Vec3 center = Vec3::Zero();
        for (const Index v : entry.second) {
            center += source.mesh.position(v) / static_cast<double>(entry.second.size());
        }
        std::size_t nearest = 0;
        const auto distance = [&](std::size_t row) {
            return (source.mesh.position(moved.vertices()[row]) - center).squaredNorm();
        };
        for (std::size_t row = 1; row < moved.vertices().size(); ++row) {
            if (distance(row) < distance(nearest)) nearest = row;
        }
        const Vec3& from = source.mesh.position(moved.vertices()[nearest]);
        const Mat3& transform = deformed.transforms[nearest];
        for (const Index v : entry.second) {
            positions[v] =
                deformed.positions[nearest] + transform * (source.mesh.position(v) - from);
        }
    }
}

std::vector<Vec3> Merge::State::all_positions(const BoundaryDeformation& deformed) const {
    std::vector<Vec3> positions(source.mesh.positions().begin(), source.mesh.positions().end());
    const std::vector<Index>& moved = deformer->region().vertices();
    for (std::size_t row = 0; row < moved.size(); ++row) {
        positions[moved[row]] = deformed.positions[row];
    }
    follow(deformed, positions);
    return positions;
}

SewOptions Merge::State::sewing() const {
    SewOptions how;
    how.kind = options.seam;
    how.smooth = options.smooth;
    return how;
}

// The thesis's transition, where it is asked for.
std::optional<ThesisMerge> Merge::State::thesis_merge(const std::vector<LoopPair>& pairs,
                                                      const MergeReport& now,
                                                      const Context& context) const {
    if (!options.thesis) return std::nullopt;
    if (!(options.source_transition > 0.0 || options.target_transition > 0.0)) return std::nullopt;
    std::vector<ThesisJoin> thesis;
    for (std::size_t j = 0; j < joins.size(); ++j) {
        const bool scales = options.configuration == Configuration::free;
        const std::vector<ParameterPair> keys = keys_of(j);
        const Index start =
            keys.empty() ? 0 : nearest_vertex(source_curves[j], keys.front().source);
        thesis.push_back({pairs[j], start, scales ? now.joins[j].scale : 1.0,
                          options.target_transition, options.source_transition});
    }
    return std::make_optional<ThesisMerge>(target, source.mesh, std::move(thesis),
                                           options.transition_weight, context);
}

void Merge::State::finish_seams(Sewn& sewn, const std::optional<ThesisMerge>& thesis,
                                MergeReport& now, const Context& context) const {
    const bool blends = options.source_transition > 0.0 || options.target_transition > 0.0;
    if (thesis) {
        now.transition = thesis->reconstruct(sewn, context);
    } else if (blends) {
        std::vector<TransitionWidths> widths;
        for (const JoinReport& join : now.joins) {
            widths.push_back({options.target_transition, options.source_transition * join.scale});
        }
        now.transition = blend_transition(sewn, widths, {}, context);
    } else if (options.seam == SeamKind::fair) {
        fair_seam(sewn.mesh, sewn.seams, {}, context);
    }
    if (blends || options.seam == SeamKind::fair) {
        sewn.report.after = seam_quality(sewn.mesh, sewn.seams);
    }
    now.seam = sewn.report;
}

std::vector<FacePair> Merge::State::new_intersections(const Sewn& sewn,
                                                      const Context& context) const {
    std::vector<Index> faces;
    for (Index f = 0; f < sewn.mesh.face_count(); ++f) {
        if (sewn.side_of_face[f] == SeamSide::source) faces.push_back(f);
    }
    std::vector<FacePair> pairs = self_intersections(sewn.mesh, {std::move(faces)}, context);
    const std::vector<FacePair> before = own_intersections(sewn, pairs, context);
    std::erase_if(pairs, [&](const FacePair& pair) {
        return std::binary_search(before.begin(), before.end(), origin_of(sewn, pair));
    });
    return pairs;
}

// The faces of the source that two of the result come from; negative for one of the target.
FacePair Merge::State::origin_of(const Sewn& sewn, const FacePair& pair) const {
    const Index a = sewn.map.faces.main_source(pair.first) - target.face_count();
    const Index b = sewn.map.faces.main_source(pair.second) - target.face_count();
    return {std::min(a, b), std::max(a, b)};
}

// Those of the source as it is among the faces that `pairs` come from.
std::vector<FacePair> Merge::State::own_intersections(const Sewn& sewn,
                                                      const std::vector<FacePair>& pairs,
                                                      const Context& context) const {
    std::vector<Index> faces;
    for (const FacePair& pair : pairs) {
        const FacePair origin = origin_of(sewn, pair);
        if (origin.first < 0) continue;
        faces.push_back(origin.first);
        faces.push_back(origin.second);
    }
    if (faces.empty()) return {};
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return self_intersections(source.mesh, {faces, faces}, context);
}

// Normals and tangents turn with the surface; displacements of morph targets grow with it as well.
void Merge::State::turn_directions(const BoundaryDeformation& deformed, Mesh& moved) const {
    RestDirections(source.mesh, deformer->region()).apply_to(moved, deformed.transforms);
    std::vector<double> scale(static_cast<std::size_t>(moved.vertex_count()), 1.0);
    const std::vector<Index>& ids = deformer->region().vertices();
    for (std::size_t row = 0; row < ids.size(); ++row) {
        scale[ids[row]] = uniform_scale(deformed.transforms[row]);
    }
    for (Attribute& attribute : moved.attributes().all()) {
        if (role_of(attribute) != AttributeRole::morph_position) continue;
        for (Index i = 0; i < attribute.size(); ++i) {
            const Index v =
                attribute.domain == Domain::vertex ? i : moved.topology().faces().vertices[i];
            for (double& x : attribute.at(i)) x *= scale[v];
        }
    }
}

Merge::Merge(const Mesh& source, std::span<const Mesh* const> targets, std::vector<Join> joins,
             const MergeOptions& options, const Context& context)
    : state_(std::make_unique<State>(source, targets, std::move(joins), options, context)) {}

Merge::~Merge() = default;
Merge::Merge(Merge&&) noexcept = default;
Merge& Merge::operator=(Merge&&) noexcept = default;

void Merge::set_keys(Index join, std::vector<KeyPair> keys) {
    if (join < 0 || join >= static_cast<Index>(state_->joins.size())) {
        throw Error(ErrorCode::out_of_range, "there is no such join");
    }
    state_->joins[join].keys = std::move(keys);
}

std::size_t Merge::memory_bytes() const {
    std::size_t bytes = state_->source.mesh.memory_bytes() + state_->target.memory_bytes();
    for (const auto* deformer : {state_->deformer.get(), state_->featured.get()}) {
        if (deformer) bytes += deformer->stats().factor_bytes;
    }
    return bytes;
}

MergeResult Merge::solve(const Context& context) {
    State& state = *state_;
    Progress progress(context, "merge");
    const auto start = Clock::now();
    MergeReport report = state.report;
    const std::vector<LoopPair> pairs = state.correspond(report);
    progress.step(0.5);
    BoundaryDeformation deformed = state.deform(pairs, context);
    std::optional<ThesisMerge> thesis = state.thesis_merge(pairs, report, context);
    if (thesis) {
        const auto& by = state.featured ? *state.featured : *state.deformer;
        deformed = thesis->deform(by.region(), by.held(), deformed, context);
    }
    Mesh moved = state.source.mesh;
    moved.set_positions(state.all_positions(deformed));
    state.turn_directions(deformed, moved);
    progress.step(0.5);
    Sewn sewn = sew(state.target, moved, pairs, state.sewing(), context);
    state.finish_seams(sewn, thesis, report, context);
    if (state.options.find_intersections) {
        report.intersections = state.new_intersections(sewn, context);
        if (!report.intersections.empty()) {
            report.warnings.push_back(std::to_string(report.intersections.size()) +
                                      " pairs of faces run through one another that did not "
                                      "before; see the report's intersections");
        }
    }
    const MeshMap origins =
        appended_map(state.target_map, state.source.map, *state.given_target_topology);
    report.solve_seconds = seconds_since(start);
    return {std::move(sewn.mesh), std::move(report), composed(sewn.map, origins),
            std::move(sewn.side_of_face), std::move(sewn.seams)};
}

}  // namespace lissom
