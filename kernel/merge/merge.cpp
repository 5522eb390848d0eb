#include "kernel/merge/merge.h"

#include <string>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/merge/merge_state.h"
#include "kernel/merge/provenance.h"
#include "kernel/merge/verdict.h"

namespace lissom {

Merge::Merge(const Mesh& source, std::span<const Mesh* const> targets, std::vector<Join> joins,
             const MergeOptions& options, const Context& context) try
    : state_(std::make_unique<State>(source, targets, std::move(joins), options, context)) {
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

Merge::~Merge() = default;
Merge::Merge(Merge&&) noexcept = default;
Merge& Merge::operator=(Merge&&) noexcept = default;

void Merge::set_keys(Index join, std::vector<KeyPair> keys) {
    if (join < 0 || join >= static_cast<Index>(state_->joins.size())) {
        throw Error(ErrorCode::out_of_range, "there is no such join");
    }
    (void)state_->keys_of(static_cast<std::size_t>(join), keys);
    state_->joins[join].keys = std::move(keys);
}

std::size_t Merge::memory_bytes() const {
    std::size_t bytes = state_->source.mesh.memory_bytes() + state_->target.memory_bytes();
    for (const auto* deformer : {state_->deformer.get(), state_->featured.get()}) {
        if (deformer) bytes += deformer->stats().factor_bytes;
    }
    return bytes;
}

MergeResult Merge::solve(const Context& context) try {
    State& state = *state_;
    Progress progress(context, "merge");
    const auto start = MergeClock::now();
    MergeReport report = state.report;
    const std::vector<LoopPair> pairs = state.correspond(report, context);
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
    Sewn sewn = state.sew_sides(moved, pairs, thesis, report, context);
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
    const Verdict verdict = verdict_of(report, state.options.find_intersections);
    report.ok = verdict.good;
    report.verdict = verdict.text;
    report.solve_seconds = seconds_since(start);
    return {std::move(sewn.mesh), std::move(report), composed(sewn.map, origins),
            std::move(sewn.side_of_face), std::move(sewn.seams)};
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

}  // namespace lissom
