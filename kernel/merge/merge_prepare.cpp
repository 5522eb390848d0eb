// What a merge does once: sides, loops, features, factors.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "kernel/merge/loop/loop_values.h"
#include "kernel/merge/merge_state.h"
#include "kernel/merge/provenance.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/query/distances.h"

namespace lissom {
namespace {

// Edges of the source's boundary this many times as long as those they meet are coarse.
constexpr double kCoarse = 1.5;
// How far the source deforms in the fixed configuration, in radii of its largest boundary.
constexpr double kReach = 3.0;

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
    for (const DirectionPair& pair : options.directions) {
        require(pair.source.allFinite() && pair.target.allFinite() &&
                    pair.source.stableNorm() > 0.0 && pair.target.stableNorm() > 0.0,
                "directions that belong together must be finite and have a length above 0");
    }
    const bool widths = options.source_transition > 0.0 || options.target_transition > 0.0;
    require(!(options.suit_transition && widths),
            "the widths of a transition are either given or chosen");
    require(!(options.suit_transition && options.thesis),
            "the thesis's transition needs its widths: it does not choose them");
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

std::vector<GivenLoop> given_loops(const Mesh& mesh, const MergeSide& side) {
    std::vector<GivenLoop> result;
    for (const std::vector<Index>& loop : side.loops) {
        GivenLoop& given = result.emplace_back();
        given.vertices = loop;
        for (const Index v : loop) given.points.push_back(mesh.position(v));
    }
    return result;
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

}  // namespace

Merge::State::State(const Mesh& given_source, std::span<const Mesh* const> given_targets,
                    std::vector<Join> asked, const MergeOptions& chosen, const Context& context)
    : options(chosen), joins(std::move(asked)) {
    Progress progress(context, "merge: prepare");
    const auto start = MergeClock::now();
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
    note_loose_parts();
    report.source_rim = seam_quality(source.mesh, source.loops);
    report.target_rim = seam_quality(target, target_loops);
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

// In the fixed configuration they stay where they are, as they do without a merge.
void Merge::State::note_loose_parts() {
    const Topology& topology = source.mesh.topology();
    std::vector<char> joined(static_cast<std::size_t>(topology.component_count()), 0),
        seen = joined;
    for (const std::vector<Index>& loop : source.loops) joined[topology.components()[loop[0]]] = 1;
    Index vertices = 0;
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        const Index part = topology.components()[v];
        if (joined[part] || topology.is_isolated(v)) continue;
        report.loose_parts += seen[part] ? 0 : 1;
        seen[part] = 1;
        ++vertices;
    }
    if (report.loose_parts == 0 || options.configuration == Configuration::fixed) return;
    const bool one = report.loose_parts == 1;
    report.warnings.push_back(
        std::to_string(report.loose_parts) + (one ? " part" : " parts") + " of the source (" +
        std::to_string(vertices) + " vertices) " + (one ? "has" : "have") +
        " no boundary that is joined and " + (one ? "moves" : "move") +
        " along with what is nearest; take what does not belong to it out of the source first");
}

// Which boundaries of each target are joined.
TargetPaths Merge::State::target_paths(std::size_t targets) const {
    TargetPaths result{std::vector<std::vector<Path>>(targets), {}};
    for (const Join& join : joins) {
        if (join.target_mesh < 0 || join.target_mesh >= static_cast<Index>(targets)) {
            throw Error(ErrorCode::out_of_range, "a join names a target that does not exist");
        }
        result.place.push_back(result.paths[join.target_mesh].size());
        result.paths[join.target_mesh].push_back(join.target);
    }
    return result;
}

void Merge::State::make_source(const Mesh& given, const Context& context) {
    std::vector<Path> paths;
    for (const Join& join : joins) paths.push_back(join.source);
    source = make_side(given, paths, "source");
    given_source_loops = given_loops(given, source);
    orient(source, context);
    report.source_flipped = source.flipped;
}

std::vector<MergeSide> Merge::State::make_targets(std::span<const Mesh* const> given,
                                                  const TargetPaths& paths,
                                                  const Context& context) {
    std::vector<MergeSide> sides;
    given_target_loops.resize(joins.size());
    for (std::size_t t = 0; t < given.size(); ++t) {
        MergeSide& side = sides.emplace_back(make_side(*given[t], paths.paths[t], "target"));
        const std::vector<GivenLoop> loops = given_loops(*given[t], side);
        for (std::size_t j = 0; j < joins.size(); ++j) {
            if (joins[j].target_mesh == static_cast<Index>(t)) {
                given_target_loops[j] = loops[paths.place[j]];
            }
        }
        orient(side, context);
        if (side.flipped) report.targets_flipped.push_back(static_cast<Index>(t));
    }
    return sides;
}

void Merge::State::trim_sides(std::vector<MergeSide>& sides, const TargetPaths& paths,
                              const Context& context) {
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
        join.target_turn = side.turns[paths.place[j]];
        join.target_trimmed = side.trimmed[paths.place[j]] != 0;
    }
}

// With the numbers that vertices have where all targets are one mesh.
void Merge::State::take_target_loops(const std::vector<MergeSide>& sides,
                                     const TargetPaths& paths) {
    for (std::size_t j = 0; j < joins.size(); ++j) {
        Index shift = 0;
        for (Index t = 0; t < joins[j].target_mesh; ++t) shift += sides[t].mesh.vertex_count();
        std::vector<Index> loop = sides[joins[j].target_mesh].loops[paths.place[j]];
        for (Index& v : loop) v += shift;
        target_loops.push_back(std::move(loop));
    }
}

void Merge::State::make_sides(const Mesh& given_source, std::span<const Mesh* const> given_targets,
                              const Context& context) {
    report.joins.resize(joins.size());
    const TargetPaths paths = target_paths(given_targets.size());
    make_source(given_source, context);
    std::vector<MergeSide> sides = make_targets(given_targets, paths, context);
    note_flips();
    trim_sides(sides, paths, context);
    combine(given_targets, sides, context);
    take_target_loops(sides, paths);
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

}  // namespace lissom
