#include "kernel/merge/merge.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "kernel/core/clock.h"
#include "kernel/core/memory_error.h"
#include "kernel/merge/crossings.h"
#include "kernel/merge/merge_stages.h"
#include "kernel/merge/provenance.h"
#include "kernel/merge/verdict.h"

namespace lissom {
namespace {

// Loose parts stay in the fixed configuration, as they do without a merge.
void note_loose_parts(const LooseParts& loose, Configuration configuration,
                      std::vector<std::string>& warnings) {
    if (loose.parts == 0 || configuration == Configuration::fixed) return;
    const bool one = loose.parts == 1;
    warnings.push_back(
        std::to_string(loose.parts) + (one ? " part" : " parts") + " of the source (" +
        std::to_string(loose.vertices) + " vertices) " + (one ? "has" : "have") +
        " no boundary that is joined and " + (one ? "moves" : "move") +
        " along with the nearest joined part; remove parts that do not belong to it from the "
        "source first");
}

}  // namespace

struct Merger::State {
    MergePreparation preparation;
    /// By join.
    std::vector<std::vector<KeyPair>> keys;
};

Merger::Merger(const Mesh& source, std::span<const Mesh* const> targets, std::vector<Join> joins,
               const MergeOptions& options, const Context& context) try
    : state_(std::make_unique<State>(
          State{prepare_merge(source, targets, joins, options, context), {}})) {
    for (Join& join : joins) state_->keys.push_back(std::move(join.keys));
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

Merger::Merger(const Mesh& source, const Mesh& target, std::vector<Join> joins,
               const MergeOptions& options, const Context& context)
    : Merger(source, std::array<const Mesh*, 1>{&target}, std::move(joins), options, context) {}

Merger::~Merger() = default;
Merger::Merger(Merger&&) noexcept = default;
Merger& Merger::operator=(Merger&&) noexcept = default;

void Merger::set_keys(Index join, std::vector<KeyPair> keys) try {
    if (join < 0 || join >= count_of(state_->keys)) {
        throw Error(ErrorCode::out_of_range, "there is no such join");
    }
    const MergePreparation& made = state_->preparation;
    (void)parameters_of(made.given, made.boundaries, made.method, join, keys);
    state_->keys[join] = std::move(keys);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

const std::vector<std::string>& Merger::warnings() const {
    return state_->preparation.report.sides.warnings;
}

std::size_t Merger::memory_bytes() const {
    const MergePreparation& made = state_->preparation;
    std::size_t bytes =
        made.boundaries.source.mesh.memory_bytes() + made.boundaries.target.memory_bytes();
    for (const auto* deformer : {made.system.deformer.get(), made.system.featured.get()}) {
        if (deformer) bytes += deformer->stats().factor_bytes;
    }
    return bytes;
}

namespace {

// The surface around one seam, against the parts as they were joined.
BandQuality band_of(const Boundaries& from, Configuration configuration, const Sewn& sewn,
                    const JoinReport& join, std::size_t j, const Context& context) {
    const std::vector<Index>& seam = sewn.seams[j];
    const std::vector<Index> of_target = faces_on(sewn.side_of_face, SeamSide::target);
    const std::vector<Index> of_source = faces_on(sewn.side_of_face, SeamSide::source);
    const std::vector<Vec3> rest =
        places_on_second(sewn.map, from.source.mesh, from.target.vertex_count());
    const std::vector<Vec3> target_rest = places_on_first(sewn.map, from.target);
    return band_quality({&sewn.mesh, of_target, seam, false, target_rest},
                        {&sewn.mesh, of_source, seam, false, rest},
                        {&from.target, {}, from.target_loops[j]},
                        {&from.source.mesh, {}, from.source.loops[j]}, join.scale,
                        configuration == Configuration::fixed, context);
}

// Options of a merge that the caller could still change.
OpenOptions open_options(const MergeOptions& options, const Matching& matching,
                         const MergeReport& report) {
    const bool blends = options.auto_transition || options.source_transition > 0.0 ||
                        options.target_transition > 0.0;
    OpenOptions open;
    open.sought = options.find_intersections;
    open.keys = std::any_of(matching.joins.begin(), matching.joins.end(),
                            [](const JoinReport& join) { return join.placed != Placing::keys; });
    open.fair = options.seam != SeamKind::fair && !blends && !options.thesis;
    open.transition = !blends;
    open.no_transition = blends && report.transition.kept > 0.0;
    open.smooth = report.seam.smoothed >= options.smooth;
    open.collar = !options.collar && !options.thesis;
    open.fixed = options.fixed.empty();
    open.free = options.configuration == Configuration::fixed;
    open.moves = open.free;
    return open;
}

}  // namespace

MergeReport report_of(const PreparationReport& prepared, const Boundaries& boundaries,
                      const MergeOptions& options, const Matching& matching,
                      const DeformedSource& moved, const MergedSides& merged,
                      const Context& context) {
    MergeReport report;
    report.source_rim = prepared.source_rim;
    report.target_rim = prepared.target_rim;
    report.loose_parts = prepared.loose.parts;
    report.joins = matching.joins;
    report.source_flipped = prepared.sides.source_flipped;
    report.targets_flipped = prepared.sides.targets_flipped;
    report.warnings = prepared.sides.warnings;
    note_loose_parts(prepared.loose, options.configuration, report.warnings);
    for (const auto* told : {&matching.warnings, &merged.warnings}) {
        report.warnings.insert(report.warnings.end(), told->begin(), told->end());
    }
    if (!merged.intersections.empty()) {
        report.warnings.push_back(std::to_string(merged.intersections.size()) +
                                  " pairs of faces run through one another that did not "
                                  "before; see the report's intersections");
    }
    report.deform = prepared.stats;
    report.deform_seconds = moved.seconds;
    report.seam = merged.sewn.report;
    report.transition = merged.transition;
    report.intersections = merged.intersections;
    report.known_intersections = merged.known_intersections;
    report.crossings = crossing_groups(merged.sewn, merged.intersections, context);
    report.prepare_seconds = prepared.seconds;
    for (std::size_t j = 0; j < report.joins.size(); ++j) {
        report.joins[j].band =
            band_of(boundaries, options.configuration, merged.sewn, report.joins[j], j, context);
    }
    judge(report, open_options(options, matching, report));
    return report;
}

MergeResult Merger::solve(const Context& context) try {
    const MergePreparation& made = state_->preparation;
    Progress progress(context, "merge");
    const Boundaries& sides = made.boundaries;
    const MemoryCharge working = context.charge(
        3 * (sides.source.mesh.memory_bytes() + sides.target.memory_bytes()), "merging");
    const auto start = Clock::now();
    const auto find = [&] {
        return find_places(sides, *made.parts, made.system, made.options, context);
    };
    const Matching matching = match_boundaries(made.given, sides, made.options,
                                               made.report.sides.joins, state_->keys, find);
    progress.step(0.5);
    const DeformedSource moved = deform_source(sides, made.system, made.options, matching, context);
    progress.step(0.5);
    auto [merged, report] =
        judged_sides(made.report, sides, made.options, matching, moved, context);
    report.solve_seconds = seconds_since(start);
    const MeshMap origins =
        appended_map(sides.target_map, sides.source.map, *made.given.target_topology.back());
    Sewn& sewn = merged.sewn;
    return {std::move(sewn.mesh), std::move(report), composed(sewn.map, origins),
            std::move(sewn.side_of_face), std::move(sewn.seams)};
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

}  // namespace lissom
