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
    {OldKind::field, "lissom.DeformStats", "refined_vertices", "subdivided_vertices",
     "deformer:stats().subdivided_vertices"},
    {OldKind::field, "lissom.JoinReport", "refined", "subdivided", "report.joins[1].subdivided"},
    {OldKind::field, "lissom.JoinReport", "target_refined", "target_subdivided",
     "report.joins[1].target_subdivided"},
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
