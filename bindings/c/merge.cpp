// Cutting, merging and pasting.
#include "kernel/merge/merge.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>

#include "bindings/c/data.h"
#include "bindings/c/origins.h"
#include "bindings/c/thesis_parts.h"
#include "kernel/merge/merge_once.h"
#include "kernel/merge/paste/erase/erase_feature.h"
#include "kernel/merge/paste/paste.h"
#include "kernel/mesh/cut/cut.h"

namespace lissom::c {
namespace {

CutOptions cut_options(const lissom_cut_options* given) {
    const auto taken = take_options(given, lissom_default_cut_options());
    CutOptions options;
    if (taken.all_lines) options.loops = CutLoops::all;
    options.slide = taken.slide;
    return options;
}

// Keeps both parts of a cut, or none.
void add_cut(lissom_context& context, Cut&& cut, bool with_rest, JobResult& result) {
    for (const CutWarning& warning : cut.report.warnings) {
        context.kernel.log(LogLevel::warning, warning.message);
    }
    const std::uint64_t first = context.add_mesh(std::move(cut.kept.mesh));
    try {
        if (with_rest) result.objects[1] = context.add_mesh(std::move(cut.rest.mesh));
    } catch (...) {
        context.objects.release(first);
        throw;
    }
    result.objects[0] = first;
}

void keep_cut(lissom_context& context, Cut&& cut, lissom_mesh* kept, lissom_mesh* rest) {
    JobResult result;
    add_cut(context, std::move(cut), rest != nullptr, result);
    kept->id = result.objects[0];
    if (rest) rest->id = result.objects[1];
}

template <typename Line>
void begin_cut(lissom_context& context, lissom_mesh mesh, Line line, const CutOptions& options,
               lissom_job* job) {
    const auto made = std::make_shared<std::optional<Cut>>();
    begin_job(context,
              {{},
               [own = mesh_for_job(context, mesh), line = std::move(line), options,
                made](const Context& inner) { *made = cut(*own, line, options, inner); },
               [&context, made](JobResult& result) {
                   add_cut(context, std::move(**made), true, result);
               }},
              job);
}

CutPlane plane_of(const lissom_context& context, const double point[3], const double normal[3]) {
    require_given(point, "point");
    require_given(normal, "normal");
    CutPlane plane;
    plane.point = context.space.to_kernel(point);
    plane.normal = context.space.to_kernel(normal);
    return plane;
}

Path boundary_of(const Mesh& mesh, Index number, const char* side) {
    auto loops = boundaries(mesh);
    if (number < 0 || number >= count_of(loops)) {
        throw Error(ErrorCode::out_of_range, std::string("the ") + side + " has " +
                                                 std::to_string(loops.size()) +
                                                 " boundaries, numbered from 0");
    }
    return std::move(loops[at(number)]);
}

std::vector<KeyPair> keys_of(const lissom_context& context, const double* source,
                             const double* target, Index count) {
    require(count >= 0, "key_count is negative");
    require(count == 0 || (source && target), "source_keys or target_keys is NULL");
    std::vector<KeyPair> keys(at(count));
    for (std::size_t i = 0; i < keys.size(); ++i) {
        keys[i].source = context.space.to_kernel(source + 3 * i);
        keys[i].target = context.space.to_kernel(target + 3 * i);
    }
    return keys;
}

Join join_of(const lissom_context& context, const lissom_join& given, const Mesh& source,
             std::span<const Mesh* const> targets) {
    if (given.target < 0 || given.target >= count_of(targets)) {
        throw Error(ErrorCode::out_of_range, "a join is with target " +
                                                 std::to_string(given.target) + ", and there are " +
                                                 std::to_string(targets.size()));
    }
    return {boundary_of(source, given.source_boundary, "source"),
            boundary_of(*targets[at(given.target)], given.target_boundary, "target"), given.target,
            keys_of(context, given.source_keys, given.target_keys, given.key_count)};
}

// Without joins each target meets the source at their nearest boundaries.
std::vector<Join> joins_of(const lissom_context& context, const lissom_join* joins, Index count,
                           const Mesh& source, std::span<const Mesh* const> targets) {
    require(count >= 0, "join_count is negative");
    require(count == 0 || joins, "joins is NULL");
    std::vector<Join> all;
    for (Index i = 0; i < count; ++i) all.push_back(join_of(context, joins[i], source, targets));
    if (count > 0) return all;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        all.push_back(nearest_join(source, *targets[i], context.kernel));
        all.back().target_mesh = index_of(i);
    }
    return all;
}

MergeOptions merge_options(const lissom_merge_options* given) {
    const auto taken = take_options(given, lissom_default_merge_options());
    MergeOptions options;
    if (taken.fixed_configuration) options.configuration = Configuration::fixed;
    options.smooth = taken.smooth;
    options.collar = taken.collar;
    options.auto_transition = taken.transition;
    options.find_intersections = taken.find_intersections;
    if (taken.thesis) options.thesis = &literal_formulas();
    return options;
}

InputCounts counts_of(const Mesh& source, std::span<const Mesh* const> targets) {
    InputCounts counts;
    for (const Mesh* target : targets) counts.add(*target);
    counts.add(source);
    return counts;
}

std::uint64_t add_merged(lissom_context& context, MergeResult&& merged, const InputCounts& inputs) {
    auto origins = origins_of(merged.mesh, merged.provenance, inputs);
    const std::uint64_t id = context.add_mesh(std::move(merged.mesh));
    context.objects.find(id, Kind::mesh)->beside = std::move(origins);
    return id;
}

std::uint64_t add_erased(lissom_context& context, ErasedFeature&& erased, const Mesh& from) {
    InputCounts counts;
    counts.add(from);
    auto origins = origins_of(erased.mesh, erased.map, counts);
    const std::uint64_t id = context.add_mesh(std::move(erased.mesh));
    context.objects.find(id, Kind::mesh)->beside = std::move(origins);
    return id;
}

// Adds an object with the numbers of its inputs.
template <typename T>
std::uint64_t add_with_inputs(lissom_context& context, Kind kind, std::shared_ptr<T> made,
                              InputCounts counts) {
    auto kept = std::make_shared<InputCounts>(std::move(counts));
    const std::uint64_t id = context.add(kind, std::move(made));
    context.objects.find(id, kind)->beside = std::move(kept);
    return id;
}

// The texts of a report are kept before its mesh is: after an error there is neither.
lissom_merge_report told_report(lissom_context& context, const MergeReport& found) {
    auto told = lissom_default_merge_report();
    told.ok = found.ok;
    told.scale = found.joins.empty() ? 1.0 : found.joins.front().scale;
    told.max_dihedral = found.seam.after.max_dihedral;
    told.intersections = count_of(found.intersections);
    context.text = found.verdict;
    context.more_text.clear();
    for (const std::string& warning : found.warnings) context.more_text += warning + "\n";
    told.verdict = context.text.c_str();
    told.warnings = context.more_text.c_str();
    return told;
}

void give_merged(lissom_context& context, MergeResult&& merged, std::optional<double> scale,
                 const InputCounts& inputs, lissom_mesh* mesh, lissom_merge_report* report) {
    auto told = told_report(context, merged.report);
    if (scale) told.scale = *scale;
    mesh->id = add_merged(context, std::move(merged), inputs);
    if (!report) return;
    told.struct_size = report->struct_size;
    std::memcpy(report, &told, std::min(report->struct_size, sizeof told));
}

// The inputs of a merger or a paste, kept beside it.
const InputCounts& inputs_of(lissom_context& context, std::uint64_t id, Kind kind) {
    return *static_cast<const InputCounts*>(context.objects.find(id, kind)->beside.get());
}

void take_merged(lissom_context& context, MergeResult&& merged, std::optional<double> scale,
                 const InputCounts& inputs, JobResult& result) {
    auto told = told_report(context, merged.report);
    if (scale) told.scale = *scale;
    result.objects[0] = add_merged(context, std::move(merged), inputs);
    result.report = told;
}

Merger& merger_of(lissom_context& context, lissom_merger merger) {
    return context.content<Merger>(merger.id, Kind::merger);
}

Paste& paste_of(lissom_context& context, lissom_paste paste) {
    return context.content<Paste>(paste.id, Kind::paste);
}

PastePlacement placement_of(const lissom_context& context, const lissom_placement* given) {
    const auto taken = take_options(given, lissom_default_placement());
    PastePlacement placement;
    placement.at = context.space.to_kernel(taken.at);
    const Vec3 toward = context.space.to_kernel(taken.toward),
               up = context.space.to_kernel(taken.up);
    if (!toward.isZero(0.0)) placement.toward = toward;
    if (!up.isZero(0.0)) placement.up = up;
    if (!std::isnan(taken.angle)) placement.angle = taken.angle;
    placement.scale = taken.scale;
    return placement;
}

std::optional<Region> region_if_given(lissom_context& context, lissom_region region) {
    if (region.id == 0) return std::nullopt;
    return region_of(context, region);
}

}  // namespace
}  // namespace lissom::c

using namespace lissom;
using namespace lissom::c;

extern "C" {

lissom_cut_options lissom_default_cut_options(void) {
    lissom_cut_options options{};
    options.struct_size = sizeof options;
    options.slide = CutOptions().slide;
    return options;
}

lissom_status lissom_cut_by_plane(lissom_context* context, lissom_mesh mesh, const double point[3],
                                  const double normal[3], const lissom_cut_options* options,
                                  lissom_mesh* kept, lissom_mesh* rest) {
    return run(context, [&] {
        require_given(kept, "kept");
        keep_cut(*context,
                 cut(mesh_of(*context, mesh), plane_of(*context, point, normal),
                     cut_options(options), context->kernel),
                 kept, rest);
    });
}

lissom_status lissom_cut_by_region(lissom_context* context, lissom_mesh mesh, lissom_region region,
                                   const lissom_cut_options* options, lissom_mesh* kept,
                                   lissom_mesh* rest) {
    return run(context, [&] {
        require_given(kept, "kept");
        keep_cut(*context,
                 cut(mesh_of(*context, mesh), CutRegion{region_of(*context, region)},
                     cut_options(options), context->kernel),
                 kept, rest);
    });
}

lissom_status lissom_cut_begin_by_plane(lissom_context* context, lissom_mesh mesh,
                                        const double point[3], const double normal[3],
                                        const lissom_cut_options* options, lissom_job* job) {
    return run(context, [&] {
        begin_cut(*context, mesh, plane_of(*context, point, normal), cut_options(options), job);
    });
}

lissom_status lissom_cut_begin_by_region(lissom_context* context, lissom_mesh mesh,
                                         lissom_region region, const lissom_cut_options* options,
                                         lissom_job* job) {
    return run(context, [&] {
        begin_cut(*context, mesh, CutRegion{region_of(*context, region)}, cut_options(options),
                  job);
    });
}

lissom_merge_options lissom_default_merge_options(void) {
    const MergeOptions kernel;
    lissom_merge_options options{};
    options.struct_size = sizeof options;
    options.smooth = kernel.smooth;
    options.collar = kernel.collar;
    options.find_intersections = kernel.find_intersections;
    return options;
}

lissom_merge_report lissom_default_merge_report(void) {
    lissom_merge_report report{};
    report.struct_size = sizeof report;
    report.verdict = "";
    report.warnings = "";
    return report;
}

lissom_status lissom_merger_create(lissom_context* context, lissom_mesh source,
                                   const lissom_mesh* targets, int32_t target_count,
                                   const lissom_join* joins, int32_t join_count,
                                   const lissom_merge_options* options, lissom_merger* merger) {
    return run(context, [&] {
        require_given(merger, "merger");
        require(target_count >= 1 && targets, "there is no target");
        const Mesh& own = mesh_of(*context, source);
        std::vector<const Mesh*> others;
        for (Index i = 0; i < target_count; ++i) others.push_back(&mesh_of(*context, targets[i]));
        auto made = std::make_shared<Merger>(own, others,
                                             joins_of(*context, joins, join_count, own, others),
                                             merge_options(options), context->kernel);
        merger->id =
            add_with_inputs(*context, Kind::merger, std::move(made), counts_of(own, others));
    });
}

lissom_status lissom_merge(lissom_context* context, lissom_mesh source, lissom_mesh target,
                           const lissom_join* joins, int32_t join_count,
                           const lissom_merge_options* options, lissom_mesh* mesh,
                           lissom_merge_report* report) {
    return run(context, [&] {
        require_given(mesh, "mesh");
        if (report) take_options(report, lissom_default_merge_report());
        const Mesh& own = mesh_of(*context, source);
        const Mesh* other = &mesh_of(*context, target);
        MergeResult result =
            merge(own, *other, joins_of(*context, joins, join_count, own, {&other, 1}),
                  merge_options(options), context->kernel);
        give_merged(*context, std::move(result), std::nullopt, counts_of(own, {&other, 1}), mesh,
                    report);
    });
}

lissom_status lissom_begin_merge(lissom_context* context, lissom_mesh source, lissom_mesh target,
                                 const lissom_join* joins, int32_t join_count,
                                 const lissom_merge_options* options, lissom_job* job) {
    return run(context, [&] {
        const auto own = mesh_for_job(*context, source), other = mesh_for_job(*context, target);
        const Mesh* const targets[] = {other.get()};
        const auto made = std::make_shared<MergeResult>();
        begin_job(*context,
                  {{},
                   [own, other, made, wanted = merge_options(options),
                    all = joins_of(*context, joins, join_count, *own, targets)](
                       const Context& inner) { *made = merge(*own, *other, all, wanted, inner); },
                   [context, made, inputs = counts_of(*own, targets)](JobResult& result) {
                       take_merged(*context, std::move(*made), std::nullopt, inputs, result);
                   }},
                  job);
    });
}

lissom_status lissom_merger_set_keys(lissom_context* context, lissom_merger merger, int32_t join,
                                     const double* source_keys, const double* target_keys,
                                     int32_t key_count) {
    return run(context, [&] {
        merger_of(*context, merger)
            .set_keys(join, keys_of(*context, source_keys, target_keys, key_count));
    });
}

lissom_status lissom_merger_solve(lissom_context* context, lissom_merger merger, lissom_mesh* mesh,
                                  lissom_merge_report* report) {
    return run(context, [&] {
        require_given(mesh, "mesh");
        if (report) take_options(report, lissom_default_merge_report());
        MergeResult result = merger_of(*context, merger).solve(context->kernel);
        give_merged(*context, std::move(result), std::nullopt,
                    inputs_of(*context, merger.id, Kind::merger), mesh, report);
    });
}

lissom_status lissom_merger_begin_solve(lissom_context* context, lissom_merger merger,
                                        lissom_job* job) {
    return run(context, [&] {
        require_given(job, "job");
        const auto own = context->share<Merger>(merger.id, Kind::merger);
        const auto made = std::make_shared<MergeResult>();
        begin_job(*context,
                  {{{merger.id, Kind::merger}},
                   [own, made](const Context& inner) { *made = own->solve(inner); },
                   [context, made,
                    inputs = inputs_of(*context, merger.id, Kind::merger)](JobResult& result) {
                       take_merged(*context, std::move(*made), std::nullopt, inputs, result);
                   }},
                  job);
    });
}

lissom_placement lissom_default_placement(void) {
    lissom_placement placement{};
    placement.struct_size = sizeof placement;
    placement.angle = NAN;
    placement.scale = 1.0;
    return placement;
}

lissom_status lissom_paste_create(lissom_context* context, lissom_mesh source, lissom_mesh target,
                                  lissom_region region, lissom_region feature, lissom_region onto,
                                  const lissom_placement* placement, lissom_paste* paste) {
    return run(context, [&] {
        require_given(paste, "paste");
        const Mesh &own = mesh_of(*context, source), *other = &mesh_of(*context, target);
        auto made = std::make_shared<Paste>(
            own, *other, region_of(*context, region), region_if_given(*context, feature),
            region_if_given(*context, onto), placement_of(*context, placement), PasteOptions(),
            context->kernel);
        paste->id =
            add_with_inputs(*context, Kind::paste, std::move(made), counts_of(own, {&other, 1}));
    });
}

lissom_status lissom_paste_optimize(lissom_context* context, lissom_paste paste,
                                    int32_t iterations) {
    return run(context, [&] { paste_of(*context, paste).optimize(iterations, context->kernel); });
}

lissom_status lissom_paste_move(lissom_context* context, lissom_paste paste,
                                const lissom_placement* placement) {
    return run(context, [&] {
        paste_of(*context, paste).move(placement_of(*context, placement), context->kernel);
    });
}

lissom_status lissom_paste_merge(lissom_context* context, lissom_paste paste, lissom_mesh* mesh,
                                 lissom_merge_report* report) {
    return run(context, [&] {
        require_given(mesh, "mesh");
        if (report) take_options(report, lissom_default_merge_report());
        PasteResult result = paste_of(*context, paste).merge({}, context->kernel);
        give_merged(*context, std::move(result.merged), result.report.scale,
                    inputs_of(*context, paste.id, Kind::paste), mesh, report);
    });
}

lissom_status lissom_paste_begin_create(lissom_context* context, lissom_mesh source,
                                        lissom_mesh target, lissom_region region,
                                        lissom_region feature, lissom_region onto,
                                        const lissom_placement* placement, lissom_job* job) {
    return run(context, [&] {
        const auto own = mesh_for_job(*context, source), other = mesh_for_job(*context, target);
        const Mesh* const targets[] = {other.get()};
        const auto made = std::make_shared<std::shared_ptr<Paste>>();
        begin_job(
            *context,
            {{},
             [own, other, made, whole = region_of(*context, region),
              part = region_if_given(*context, feature), place = region_if_given(*context, onto),
              where = placement_of(*context, placement)](const Context& inner) {
                 *made = std::make_shared<Paste>(*own, *other, whole, part, place, where,
                                                 PasteOptions(), inner);
             },
             [context, made, counts = counts_of(*own, targets)](JobResult& result) {
                 result.objects[0] =
                     add_with_inputs(*context, Kind::paste, std::move(*made), counts);
             }},
            job);
    });
}

lissom_status lissom_paste_begin_optimize(lissom_context* context, lissom_paste paste,
                                          int32_t iterations, lissom_job* job) {
    return run(context, [&] {
        const auto own = context->share<Paste>(paste.id, Kind::paste);
        begin_job(*context,
                  {{{paste.id, Kind::paste}},
                   [own, iterations](const Context& inner) { own->optimize(iterations, inner); }},
                  job);
    });
}

lissom_status lissom_paste_begin_merge(lissom_context* context, lissom_paste paste,
                                       lissom_job* job) {
    return run(context, [&] {
        const auto own = context->share<Paste>(paste.id, Kind::paste);
        const auto made = std::make_shared<PasteResult>();
        begin_job(*context,
                  {{{paste.id, Kind::paste}},
                   [own, made](const Context& inner) { *made = own->merge({}, inner); },
                   [context, made,
                    inputs = inputs_of(*context, paste.id, Kind::paste)](JobResult& result) {
                       take_merged(*context, std::move(made->merged), made->report.scale, inputs,
                                   result);
                   }},
                  job);
    });
}

lissom_status lissom_erase(lissom_context* context, lissom_mesh mesh, lissom_region region,
                           lissom_mesh* erased) {
    return run(context, [&] {
        require_given(erased, "erased");
        const Mesh& own = mesh_of(*context, mesh);
        erased->id = add_erased(
            *context, erase_feature(own, region_of(*context, region), {}, context->kernel), own);
    });
}

lissom_status lissom_begin_erase(lissom_context* context, lissom_mesh mesh, lissom_region region,
                                 lissom_job* job) {
    return run(context, [&] {
        const auto own = mesh_for_job(*context, mesh);
        const auto made = std::make_shared<std::optional<ErasedFeature>>();
        begin_job(*context,
                  {{},
                   [own, made, place = region_of(*context, region)](const Context& inner) {
                       *made = erase_feature(*own, place, {}, inner);
                   },
                   [context, own, made](JobResult& result) {
                       result.objects[0] = add_erased(*context, std::move(**made), *own);
                   }},
                  job);
    });
}

}  // extern "C"
