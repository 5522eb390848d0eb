// mesh:report(): findings from loading the mesh.
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/mesh/mesh_object.h"

namespace lissom::lua {
namespace {

// Ids from 1; an edge is a pair of vertex ids.
void push_finding_ids(const Call& call, const Finding& finding) {
    if (finding.element != ElementKind::edge) {
        call.push_ids(finding.ids);
        return;
    }
    const std::size_t count = finding.ids.size() / 2;
    lua_createtable(call.lua(), index_of(count), 0);
    for (std::size_t i = 0; i < count; ++i) {
        call.push_ids({finding.ids.data() + 2 * i, 2});
        lua_rawseti(call.lua(), -2, index_of(i) + 1);
    }
}

void push_finding(const Call& call, const Finding& finding, const std::string& summary) {
    lua_createtable(call.lua(), 0, 7);
    call.set_field("kind", call.push(finding_name(finding.kind)));
    call.set_field("count", call.push_count(finding.count));
    call.set_field("summary", call.push(summary));
    if (!finding.message.empty()) call.set_field("message", call.push(finding.message));
    if (finding.element == ElementKind::none) return;
    call.set_field("element", call.push(kind_name(finding.element)));
    call.set_field("of", call.push(finding.in_file ? "file" : "mesh"));
    push_finding_ids(call, finding);
    call.set_field("ids");
}

// A list that also holds each finding under the name of its kind.
int mesh_report(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const std::vector<Finding>& findings = mesh->mesh.report().findings();
    auto& summaries = call.hold<std::vector<std::string>>();
    const bool done = call.attempt_quick([&] {
        for (const Finding& finding : findings) summaries.push_back(describe(finding));
    });
    if (!done) return call.fail();
    const auto count = count_of(findings);
    lua_createtable(call.lua(), count, count);
    for (int i = 0; i < count; ++i) {
        push_finding(call, findings[i], summaries[i]);
        lua_pushvalue(call.lua(), -1);
        lua_rawseti(call.lua(), -3, i + 1);
        call.set_field(finding_name(findings[i].kind).data());
    }
    return 1;
}

}  // namespace

std::vector<Function> mesh_report_methods() {
    return {{.name = "report",
             .body = mesh_report,
             .summary =
                 "Elements that were welded, split, dropped, flagged or left out when the mesh was "
                 "loaded: a list of findings, each also under the name of its kind. Empty for a "
                 "mesh that was made otherwise.",
             .results = {{"lissom.Report", "report", "The findings."}},
             .example = R"(local mesh = lissom.mesh{
    positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 5, 5, 5 } },
    faces = { { 1, 2, 3 } },
    repair = true,
}
local dropped = mesh:report().vertices_unreferenced
assert(dropped.count == 1 and dropped.ids[1] == 4))"}};
}

}  // namespace lissom::lua
