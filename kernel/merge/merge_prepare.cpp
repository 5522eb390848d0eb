// Steps that a merge does once: sides, loops, features, factors.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "kernel/core/clock.h"
#include "kernel/merge/fitting.h"
#include "kernel/merge/loop/loop_fit.h"
#include "kernel/merge/loop/loop_values.h"
#include "kernel/merge/merge_stages.h"
#include "kernel/merge/provenance.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/joined_content.h"
#include "kernel/mesh/edit/joined_morphs.h"
#include "kernel/mesh/query/distances.h"

namespace lissom {
namespace {

// Edges of the source's boundary this many times as long as those they meet are coarse.
constexpr double kCoarse = 1.5;
// And those this many times as long as edges of its region are few; so often it is split for them.
constexpr double kFew = 3.0;
constexpr int kMaxLevels = 4;
// Edges of a region are looked at about so many of its vertices.
constexpr Index kSampledVertices = 1000;
// Outlines whose lengths in widths differ by more than this factor do not suit each other.
constexpr double kThinOutline = 3.0;
// How far the source deforms in the fixed configuration, in radii of its largest boundary.
constexpr double kReach = 3.0;
// Factor on the usual limit of slender faces, for systems without a solution under it.
constexpr double kSlenderFaces = 1e3;

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
    require(!(options.auto_transition && widths),
            "the widths of a transition are either given or chosen");
    require(options.smooth >= 0, "the number of smoothing steps must not be negative");
    require(options.source_transition >= 0.0 && options.target_transition >= 0.0 &&
                std::isfinite(options.source_transition + options.target_transition),
            "widths of transition regions must be finite and not negative");
    require(!(options.thesis && options.auto_transition),
            "the thesis's transition needs its widths: it does not choose them");
    const bool both = options.source_transition > 0.0 && options.target_transition > 0.0;
    require(!options.thesis || both || !widths,
            "the thesis's transition needs a region on both sides: give widths above 0 for source "
            "and target");
    require(!options.reach || *options.reach > 0.0, "the reach of a merge must be above 0");
    require(options.max_turn >= 0.0, "the greatest turn must not be negative");
    const bool stays = options.configuration == Configuration::fixed;
    require(stays || !options.reach,
            "a reach applies to the fixed configuration; in the free one all of the source moves");
    require(!stays || options.place == Place::as_placed,
            "a source that stays has its place; place = shape applies to the free configuration");
    require(stays || options.turn_frames,
            "frames that keep their directions apply to the fixed configuration");
}

void require_distinct(const Mesh& source, std::span<const Mesh* const> targets) {
    for (std::size_t t = 0; t < targets.size(); ++t) {
        if (targets[t] == &source) {
            throw Error(ErrorCode::boundary_conflict,
                        "source and target are one mesh; join its boundaries by a bridge, or "
                        "merge a copy of it");
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
    std::vector<char> joined(mesh.topology().component_count(), 0);
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

// Boundaries of the targets: those of each target, and for every join its place among them.
struct TargetPaths {
    std::vector<std::vector<Path>> paths;
    std::vector<std::size_t> place;
};

TargetPaths target_paths(std::span<const Join> joins, std::size_t targets) {
    TargetPaths result{std::vector<std::vector<Path>>(targets), {}};
    for (const Join& join : joins) {
        if (join.target_mesh < 0 || join.target_mesh >= index_of(targets)) {
            throw Error(ErrorCode::out_of_range, "a join names a target that does not exist");
        }
        result.place.push_back(result.paths[join.target_mesh].size());
        result.paths[join.target_mesh].push_back(join.target);
    }
    return result;
}

void make_source(const Mesh& given, std::span<const Join> joins, Sides& sides,
                 const Context& context) {
    std::vector<Path> paths;
    for (const Join& join : joins) paths.push_back(join.source);
    sides.source = make_side(given, paths, "source");
    sides.given.source_loops = given_loops(given, sides.source);
    orient(sides.source, context);
    sides.found.source_flipped = sides.source.flipped;
}

void make_targets(std::span<const Mesh* const> given, std::span<const Join> joins,
                  const TargetPaths& paths, Sides& sides, const Context& context) {
    sides.given.target_loops.resize(joins.size());
    for (std::size_t t = 0; t < given.size(); ++t) {
        MergeSide& side =
            sides.targets.emplace_back(make_side(*given[t], paths.paths[t], "target"));
        const std::vector<GivenLoop> loops = given_loops(*given[t], side);
        for (std::size_t j = 0; j < joins.size(); ++j) {
            if (joins[j].target_mesh == index_of(t)) {
                sides.given.target_loops[j] = loops[paths.place[j]];
            }
        }
        orient(side, context);
        if (side.flipped) sides.found.targets_flipped.push_back(index_of(t));
    }
}

void note_flips(SidesFound& found) {
    if (found.source_flipped) {
        found.warnings.push_back("the source was inside out and has been turned over");
    }
    for (const Index t : found.targets_flipped) {
        found.warnings.push_back("target " + std::to_string(t + 1) +
                                 " was inside out and has been turned over");
    }
}

// On one surface a morph target has one weight.
void note_morphs(Sides& sides) {
    std::vector<const Mesh*> meshes;
    for (const MergeSide& side : sides.targets) meshes.push_back(&side.mesh);
    meshes.push_back(&sides.source.mesh);
    for (std::size_t k = 1; k < meshes.size(); ++k) {
        for (std::string& text : morph_conflicts(*meshes.front(), *meshes[k])) {
            sides.found.warnings.push_back(std::move(text));
        }
    }
}

void note_trims(const MergeSide& side, const char* name, std::vector<std::string>& warnings) {
    for (std::size_t k = 0; k < side.loops.size(); ++k) {
        if (!side.trimmed[k]) continue;
        warnings.push_back(std::string("a boundary of the ") + name + " was jagged (" +
                           degrees(side.turns[k]) +
                           " degrees at each vertex) and has been trimmed");
    }
    for (const std::string& reason : side.untrimmed) {
        warnings.push_back(std::string("a boundary of the ") + name +
                           " is jagged and could not be trimmed: " + reason);
    }
}

// Whether a join's parts fit with its keys. Keys that cannot be are told when they are used.
bool fits_as_given(const FitSides& sides, const Join& join, Configuration configuration) {
    if (join.keys.empty()) return parts_may_fit(sides, configuration);
    try {
        const auto keys = key_parameters(sides.source_loop, sides.target_loop, join.keys);
        return part_fit(sides, keys, configuration).has_value();
    } catch (const Error& error) {
        if (error.code() != ErrorCode::key_conflict) throw;
        return false;
    }
}

// Marks the loops of parts that fit as given: they are not to be changed.
void find_fits(std::span<const Join> joins, const MergeOptions& options, Sides& sides,
               const Context& context) {
    sides.source.fits.assign(joins.size(), 0);
    for (MergeSide& side : sides.targets) side.fits.assign(side.loops.size(), 0);
    if (options.thesis) return;
    for (std::size_t j = 0; j < joins.size(); ++j) {
        MergeSide& target = sides.targets[joins[j].target_mesh];
        const std::size_t place = sides.place[j];
        const std::vector<Index>& loop = sides.source.loops[j];
        const Loop from(sides.source.mesh, {loop.rbegin(), loop.rend()}, LoopMeasure::robust,
                        context);
        const Loop to(target.mesh, target.loops[place], LoopMeasure::robust, context);
        const bool fits = fits_as_given({sides.source.mesh, target.mesh, from, to}, joins[j],
                                        options.configuration);
        sides.source.fits[j] = target.fits[place] = fits ? 1 : 0;
    }
}

void note_absent_values(Sides& sides) {
    std::vector<NamedSide> named{{"the source", &sides.source.mesh}};
    const bool one = sides.targets.size() == 1;
    for (std::size_t t = 0; t < sides.targets.size(); ++t) {
        named.push_back(
            {one ? "the target" : "target " + std::to_string(t + 1), &sides.targets[t].mesh});
    }
    for (std::string& warning : absence_warnings(named)) {
        sides.found.warnings.push_back(std::move(warning));
    }
}

void trim_sides(std::span<const Join> joins, const MergeOptions& options, Sides& sides,
                const Context& context) {
    for (MergeSide& side : sides.targets) {
        if (options.trim) trim_jagged(side, options.max_turn, context);
        note_trims(side, "target", sides.found.warnings);
    }
    if (options.trim) trim_jagged(sides.source, options.max_turn, context);
    note_trims(sides.source, "source", sides.found.warnings);
    note_absent_values(sides);
    for (std::size_t j = 0; j < joins.size(); ++j) {
        JoinReport& join = sides.found.joins.emplace_back();
        const MergeSide& side = sides.targets[joins[j].target_mesh];
        join.source_turn = sides.source.turns[j];
        join.source_trimmed = sides.source.trimmed[j] != 0;
        join.target_turn = side.turns[sides.place[j]];
        join.target_trimmed = side.trimmed[sides.place[j]] != 0;
    }
}

// Topologies of the first target as given, of the first two as one mesh, and so on.
std::vector<std::shared_ptr<const Topology>> topologies_together(
    std::span<const Mesh* const> targets, const Context& context) {
    Mesh all = *targets.front();
    std::vector<std::shared_ptr<const Topology>> result{all.shared_topology()};
    for (const Mesh* mesh : targets.subspan(1)) {
        append(all, *mesh, context);
        result.push_back(all.shared_topology());
    }
    return result;
}

// Loops with the numbers of vertices of all targets as one mesh.
std::vector<std::vector<Index>> all_target_loops(const Sides& sides, std::span<const Join> joins) {
    std::vector<std::vector<Index>> loops;
    for (std::size_t j = 0; j < joins.size(); ++j) {
        Index shift = 0;
        for (Index t = 0; t < joins[j].target_mesh; ++t) {
            shift += sides.targets[t].mesh.vertex_count();
        }
        std::vector<Index> loop = sides.targets[joins[j].target_mesh].loops[sides.place[j]];
        for (Index& v : loop) v += shift;
        loops.push_back(std::move(loop));
    }
    return loops;
}

// All targets as one mesh. Sides keep their numbers of elements.
void combine_targets(std::vector<MergeSide>& sides, const GivenMeshes& given, Boundaries& result,
                     const Context& context) {
    result.target = std::move(sides.front().mesh);
    result.target_map = std::move(sides.front().map);
    for (std::size_t t = 1; t < sides.size(); ++t) {
        result.target_map =
            appended_map(result.target_map, sides[t].map, *given.target_topology[t - 1]);
        append(result.target, sides[t].mesh, context);
    }
}

void make_loops(Boundaries& boundaries, LoopMeasure measure) {
    boundaries.source_curves.clear();
    boundaries.target_curves.clear();
    for (std::size_t j = 0; j < boundaries.target_loops.size(); ++j) {
        const std::vector<Index>& loop = boundaries.source.loops[j];
        boundaries.source_curves.emplace_back(
            boundaries.source.mesh, std::vector<Index>(loop.rbegin(), loop.rend()), measure);
        boundaries.target_curves.emplace_back(boundaries.target, boundaries.target_loops[j],
                                              measure);
    }
}

double loop_edge(const Loop& loop) {
    return loop.length() / loop.size();
}

// Returns the median length of edges inside the part of a mesh that a loop bounds, of some that lie
// evenly among them; 0 if there are none.
double inner_edge(const Mesh& mesh, const Loop& loop) {
    const Topology& topology = mesh.topology();
    const Index part = topology.components()[loop.vertices().front()];
    const Index stride = std::max(1, mesh.vertex_count() / kSampledVertices);
    std::vector<double> lengths;
    for (Index v = 0; v < mesh.vertex_count(); v += stride) {
        if (topology.components()[v] != part || topology.is_boundary(v)) continue;
        for (const Index n : topology.neighbors(v)) {
            if (topology.is_boundary(n)) continue;
            lengths.push_back((mesh.position(v) - mesh.position(n)).norm());
        }
    }
    if (lengths.empty()) return 0.0;
    const auto middle = lengths.begin() + std::ssize(lengths) / 2;
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
}

void refine_source(Boundaries& boundaries, std::size_t join, LoopMeasure measure,
                   const Context& context) {
    refine_loop(boundaries.source, join, context);
    boundaries.refined[join] = 1;
    make_loops(boundaries, measure);
}

// New vertices and faces of the targets come after those of all of them.
void refine_target(Boundaries& boundaries, std::size_t join, LoopMeasure measure,
                   const Context& context) {
    MergeSide side{std::move(boundaries.target),
                   std::move(boundaries.target_map),
                   std::move(boundaries.target_loops),
                   {},
                   {},
                   {},
                   false};
    refine_loop(side, join, context);
    boundaries.target = std::move(side.mesh);
    boundaries.target_map = std::move(side.map);
    boundaries.target_loops = std::move(side.loops);
    boundaries.target_refined[join] = 1;
    make_loops(boundaries, measure);
}

// Two coarse loops beside a dense source say too little about how it lies: a shake of one of their
// vertices would shake all of it (2.5). Both are split until they are as fine as they may be
// coarse.
void refine_few(Boundaries& boundaries, std::size_t join, LoopMeasure measure,
                const Context& context) {
    for (int level = 0; level < kMaxLevels; ++level) {
        const Loop& from = boundaries.source_curves[join];
        if (!(loop_edge(from) > kFew * inner_edge(boundaries.source.mesh, from))) break;
        if (inner_edge(boundaries.source.mesh, from) == 0.0) break;
        refine_source(boundaries, join, measure, context);
    }
    for (int level = 0; boundaries.refined[join] && level < kMaxLevels; ++level) {
        const Loop &from = boundaries.source_curves[join], &to = boundaries.target_curves[join];
        if (!(loop_edge(to) > kCoarse * loop_scale(from, to) * loop_edge(from))) break;
        refine_target(boundaries, join, measure, context);
    }
}

void refine_coarse(Boundaries& boundaries, LoopMeasure measure, const Context& context) {
    for (std::size_t j = 0; j < boundaries.refined.size(); ++j) {
        if (boundaries.source.fits[j]) continue;
        refine_few(boundaries, j, measure, context);
        const Loop &from = boundaries.source_curves[j], &to = boundaries.target_curves[j];
        if (loop_scale(from, to) * loop_edge(from) <= kCoarse * loop_edge(to)) continue;
        refine_source(boundaries, j, measure, context);
    }
}

// Takes the regions off the targets, which end at their far ends then.
void open_targets(const OverlapTransition& transition, double width, Boundaries& boundaries,
                  const Context& context) {
    OpenedForOverlap opened =
        transition.open(boundaries.target, boundaries.target_loops, width, context);
    boundaries.target_map = composed(opened.map, boundaries.target_map);
    boundaries.target = std::move(opened.mesh);
    boundaries.target_loops = std::move(opened.loops);
    boundaries.overlap.emplace(
        Overlap{std::move(opened.whole), std::move(boundaries.target_curves)});
    boundaries.target_curves.clear();
    const OverlapTarget& whole = boundaries.overlap->target;
    for (std::size_t j = 0; j < whole.ends.size(); ++j) {
        boundaries.target_curves.push_back(
            Loop(whole.mesh, whole.ends[j], LoopMeasure::raw, context)
                .renumbered(boundaries.target_loops[j]));
    }
}

std::string axes_text(double aspect) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f : 1", aspect);
    return text;
}

// A thin outline that meets a round one is spread to it, and the part beside it with it.
void note_thin_outlines(const Boundaries& boundaries, std::vector<std::string>& warnings) {
    for (std::size_t j = 0; j < boundaries.source_curves.size(); ++j) {
        const double source = loop_aspect(boundaries.source_curves[j]);
        const double target = loop_aspect(boundaries.target_curves[j]);
        const double ratio = std::max(source / target, target / source);
        if (!(ratio > kThinOutline)) continue;
        char spread[16];
        std::snprintf(spread, sizeof spread, "%.1f", std::sqrt(ratio));
        warnings.push_back(
            "join " + std::to_string(j + 1) + ": the source's outline (axes " + axes_text(source) +
            ") and the target's (" + axes_text(target) +
            ") differ so much that the source is widened " + spread +
            " times at the seam; cut the thin part at a rounder place, or open the target along "
            "an outline like the source's, as lissom.paste does");
    }
}

// Features on parts without a join need no care: these go as a whole, or stay.
std::vector<Region> carried_features(const MergeSide& source, const MergeOptions& options) {
    const Region loops = region_of_loops(source.mesh, source.loops);
    const Region parts = joined_parts(source.mesh, source.loops);
    Region taken = Region::none(source.mesh.shared_topology());
    std::vector<Region> features;
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
    return features;
}

LooseParts loose_parts(const MergeSide& source) {
    const Topology& topology = source.mesh.topology();
    std::vector<char> joined(topology.component_count(), 0), seen = joined;
    for (const std::vector<Index>& loop : source.loops) joined[topology.components()[loop[0]]] = 1;
    LooseParts result;
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        const Index part = topology.components()[v];
        if (joined[part] || topology.is_isolated(v)) continue;
        result.parts += seen[part] ? 0 : 1;
        seen[part] = 1;
        ++result.vertices;
    }
    return result;
}

// The part of the source that moves, with its constraints.
Region deforming(const MergePreparation& made) {
    const MergeSide& source = made.boundaries.source;
    const Region parts = joined_parts(source.mesh, source.loops);
    if (made.options.configuration == Configuration::free) return parts;
    double reach = made.options.reach.value_or(0.0);
    if (!made.options.reach) {
        if (!made.system.features.empty()) return parts;
        for (const Loop& loop : made.boundaries.source_curves) {
            reach = std::max(reach, kReach * loop.radius());
        }
    }
    const Region loops = region_of_loops(source.mesh, source.loops);
    const std::vector<double> distance = edge_distances(source.mesh, loops.vertices(), reach);
    std::vector<Index> near;
    for (const Index v : parts.vertices()) {
        if (distance[v] <= reach) near.push_back(v);
    }
    return Region(source.mesh.shared_topology(), std::move(near));
}

// Faces a hundred times as long as wide, as loops of thousands of vertices have, look flat to the
// usual threshold, all of them at once. Told apart from flat ones they have a solution.
std::unique_ptr<BoundaryDeformer> firm_deformer(const Mesh& mesh, const Region& region,
                                                const Region& held, BoundaryDeformOptions how,
                                                const Context& context) {
    try {
        return std::make_unique<BoundaryDeformer>(mesh, region, held, how, context);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::not_positive_definite) throw;
    }
    how.degenerate_threshold *= kSlenderFaces;
    return std::make_unique<BoundaryDeformer>(mesh, region, held, how, context);
}

void factor(MergePreparation& made, const Context& context) {
    const MergeSide& source = made.boundaries.source;
    const Region region = deforming(made);
    const Region loops = region_of_loops(source.mesh, source.loops);
    Region kept = loops;
    for (const Region& feature : made.system.features)
        kept = kept.united(feature.intersected(region));
    made.system.kept = kept;
    BoundaryDeformOptions how = made.method.deform;
    const auto deformer_with = [&](const Region& held) {
        return firm_deformer(source.mesh, region, held, how, context);
    };
    if (made.options.configuration == Configuration::fixed) {
        made.system.deformer = deformer_with(kept);
    } else if (made.options.feature_motion == FeatureMotion::fitted) {
        made.system.deformer = deformer_with(loops);
        if (!made.system.features.empty()) made.system.featured = deformer_with(kept);
    } else {
        how.features = made.system.features;
        made.system.deformer = deformer_with(loops);
    }
    made.report.stats = made.system.deformer->stats();
}

}  // namespace

MergeMethod method_of(const MergeOptions& options) {
    MergeMethod method;
    method.values.turn = options.configuration == Configuration::free || options.turn_frames;
    if (!options.thesis) return method;
    method.deform = options.thesis->deform;
    method.values.sigma = 0.0;
    method.values.tangent_scales = true;
    method.loops = LoopMeasure::raw;
    method.guard = false;
    if (options.source_transition > 0.0 || options.target_transition > 0.0) {
        method.overlap = &options.thesis->overlap;
    }
    return method;
}

Sides make_sides(const Mesh& source, std::span<const Mesh* const> targets,
                 std::span<const Join> joins, const MergeOptions& options, const Context& context) {
    Sides sides;
    const TargetPaths paths = target_paths(joins, targets.size());
    sides.place = paths.place;
    make_source(source, joins, sides, context);
    make_targets(targets, joins, paths, sides, context);
    note_flips(sides.found);
    note_morphs(sides);
    find_fits(joins, options, sides, context);
    trim_sides(joins, options, sides, context);
    sides.given.target_topology = topologies_together(targets, context);
    return sides;
}

Boundaries find_boundaries(Sides sides, std::span<const Join> joins, const MergeOptions& options,
                           const Context& context) {
    Boundaries result;
    result.refined.assign(joins.size(), 0);
    result.target_refined = result.refined;
    result.target_loops = all_target_loops(sides, joins);
    combine_targets(sides.targets, sides.given, result, context);
    result.source = std::move(sides.source);
    const MergeMethod method = method_of(options);
    make_loops(result, method.loops);
    if (options.subdivide) refine_coarse(result, method.loops, context);
    if (method.overlap) open_targets(*method.overlap, options.target_transition, result, context);
    return result;
}

const PartShapes::Pair& PartShapes::of(const Boundaries& boundaries, const Context& context) const {
    std::call_once(once_, [&] {
        parts_ = {part_shape(boundaries.source.mesh, boundaries.source_curves.front(), context),
                  part_shape(boundaries.target, boundaries.target_curves.front(), context)};
    });
    return parts_;
}

MergePreparation prepare_merge(const Mesh& source, std::span<const Mesh* const> targets,
                               std::span<const Join> joins, const MergeOptions& options,
                               const Context& context) {
    Progress progress(context, "merge: prepare");
    const auto start = Clock::now();
    require_options(options, joins.size(), targets.size());
    require_distinct(source, targets);
    for (const Region& feature : options.fixed) {
        require_same_topology(source, feature.topology(), "a fixed feature of the source");
    }
    std::size_t given = source.memory_bytes();
    for (const Mesh* target : targets) given += target->memory_bytes();
    const MemoryCharge working = context.charge(2 * given, "preparing a merge");
    MergePreparation made;
    made.charge = context.charge(given, "a merge");
    made.options = options;
    made.method = method_of(options);
    Sides sides = make_sides(source, targets, joins, options, context);
    made.given = sides.given;
    made.report.sides = sides.found;
    progress.step(0.3);
    made.boundaries = find_boundaries(std::move(sides), joins, options, context);
    const Boundaries& from = made.boundaries;
    note_thin_outlines(from, made.report.sides.warnings);
    made.system.features = carried_features(from.source, options);
    made.report.loose = loose_parts(from.source);
    made.report.source_rim = seam_quality(from.source.mesh, from.source.loops);
    made.report.target_rim = seam_quality(from.target, from.target_loops);
    made.parts = std::make_unique<PartShapes>();
    progress.step(0.7);
    factor(made, context);
    made.report.seconds = seconds_since(start);
    return made;
}

}  // namespace lissom
