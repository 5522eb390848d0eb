#include "bindings/lua/core/old_names.h"

#include <algorithm>

namespace lissom::lua {
namespace {

constexpr OldName kOldNames[] = {
    {OldKind::type, "lissom", "Deformation", "Deformer", "lissom.Deformer"},
    {OldKind::type, "lissom", "Merging", "Merger", "lissom.Merger"},
    {OldKind::function, "lissom", "deform", "deformer", "lissom.deformer(mesh, {...})"},
    {OldKind::function, "lissom", "merging", "merger", "lissom.merger(source, target, {...})"},
    {OldKind::method, "lissom.Deformer", "handle", "add_handle", "deformer:add_handle(region)"},
    {OldKind::method, "lissom.Deformer", "apply", "rebase", "deformer:rebase()"},
    {OldKind::method, "lissom.Deformer", "refined_mesh", "subdivided_mesh",
     "deformer:subdivided_mesh()"},
    {OldKind::method, "lissom.Hairstyle", "stream", "add_stream", "style:add_stream(points)"},
    {OldKind::method, "lissom.Hairstyle", "dividing", "add_dividing", "style:add_dividing(points)"},
    {OldKind::method, "lissom.Hairstyle", "ponytail", "add_ponytail", "style:add_ponytail(spine)"},
    {OldKind::option, "deformer", "refine_borders", "subdivide_borders",
     "subdivide_borders = false"},
    {OldKind::option, "merge", "refine", "subdivide", "subdivide = false"},
    {OldKind::option, "merger", "refine", "subdivide", "subdivide = false"},
    {OldKind::option, "fill", "refine", "subdivide", "subdivide = false"},
    {OldKind::value, "merge.fidelity", "lissom", "default", "fidelity = \"default\""},
    {OldKind::value, "merger.fidelity", "lissom", "default", "fidelity = \"default\""},
    {OldKind::value, "paste.fidelity", "lissom", "default", "fidelity = \"default\""},
    {OldKind::field, "lissom.DeformStats", "refined_vertices", "subdivided_vertices",
     "deformer:stats().subdivided_vertices"},
    {OldKind::field, "lissom.JoinReport", "refined", "subdivided", "report.joins[1].subdivided"},
    {OldKind::field, "lissom.JoinReport", "target_refined", "target_subdivided",
     "report.joins[1].target_subdivided"},
    {OldKind::option, "grow", "least_speed", "min_speed", "min_speed = 0.05"},
    {OldKind::option, "grow", "greatest_turn", "max_turn", "max_turn = 88"},
    {OldKind::option, "grow", "most_segments", "max_segments", "max_segments = 400"},
    {OldKind::option, "merge", "greatest_turn", "max_turn", "max_turn = 20"},
    {OldKind::option, "merger", "greatest_turn", "max_turn", "max_turn = 20"},
    {OldKind::option, "feed_braid", "least_run", "min_run", "min_run = 0.06"},
    {OldKind::option, "feed_braid", "most_run", "max_run", "max_run = 0.12"},
    {OldKind::field, "lissom.SeamQuality", "greatest_dihedral", "max_dihedral",
     "quality.max_dihedral"},
    {OldKind::field, "lissom.SeamQuality", "greatest_near", "max_near", "quality.max_near"},
    {OldKind::field, "lissom.BandQuality", "greatest_bend", "max_bend", "band.max_bend"},
    {OldKind::field, "lissom.BandQuality", "rest_greatest_bend", "rest_max_bend",
     "band.rest_max_bend"},
    {OldKind::field, "lissom.EraseReport", "greatest_around", "max_around", "report.max_around"},
    {OldKind::field, "lissom.ParameterizeReport", "least_scale", "min_scale", "report.min_scale"},
    {OldKind::field, "lissom.ParameterizeReport", "greatest_scale", "max_scale",
     "report.max_scale"},
    {OldKind::field, "lissom.StrandStats", "least_points", "min_points", "hair:stats().min_points"},
    {OldKind::field, "lissom.StrandStats", "most_points", "max_points", "hair:stats().max_points"},
    {OldKind::field, "lissom.StrandStats", "least_length", "min_length", "hair:stats().min_length"},
    {OldKind::field, "lissom.StrandStats", "most_length", "max_length", "hair:stats().max_length"},
    {OldKind::field, "lissom.StrandStats", "greatest_turn", "max_turn", "hair:stats().max_turn"},
    {OldKind::field, "lissom.StrandStats", "greatest_turn_strand", "max_turn_strand",
     "hair:stats().max_turn_strand"},
};

}  // namespace

std::span<const OldName> old_names() {
    return kOldNames;
}

const OldName* find_old_name(OldKind kind, std::string_view owner, std::string_view name) {
    const auto found =
        std::find_if(std::begin(kOldNames), std::end(kOldNames), [&](const OldName& one) {
            return one.kind == kind && one.owner == owner && one.old_name == name;
        });
    return found == std::end(kOldNames) ? nullptr : found;
}

std::string old_name_hint(OldKind kind, std::string_view owner, std::string_view name) {
    const OldName* found = find_old_name(kind, owner, name);
    return found ? "; since version 0.2 write " + std::string(found->usage) : "";
}

}  // namespace lissom::lua
