// deformer:contacts: faces of the deformed surface that run through one another.
#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <utility>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/deform/deform_object.h"
#include "kernel/deform/contact/contacts.h"

namespace lissom::lua {
namespace {

std::vector<Index> faces_of(std::span<const FacePair> pairs) {
    std::vector<Index> faces;
    for (const FacePair& pair : pairs) {
        faces.push_back(pair.first);
        faces.push_back(pair.second);
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

Region vertices_of(const std::shared_ptr<const Topology>& topology, std::span<const Index> faces) {
    std::vector<Index> vertices;
    for (const Index f : faces) {
        const auto corners = topology->face(f);
        vertices.insert(vertices.end(), corners.begin(), corners.end());
    }
    return {topology, std::move(vertices)};
}

int contacts(Call& call) {
    const auto edit = call.self<DeformObject>();
    auto& pairs = call.hold<std::vector<FacePair>>();
    const bool done = call.attempt(
        [&] { pairs = contacts_of(edit->deformer(), edit->mesh->mesh, call.context()); });
    if (!done) return call.fail();
    push_contacts(call, *edit, pairs);
    return 1;
}

}  // namespace

void push_contacts(Call& call, const DeformObject& edit, const std::vector<FacePair>& pairs) {
    auto& faces = call.hold<std::vector<Index>>();
    const auto region = call.create<RegionObject>();
    const bool done = call.attempt_quick([&] {
        faces = faces_of(pairs);
        region.set(std::make_shared<RegionObject>(edit.mesh, vertices_of(edit.topology, faces)));
    });
    if (!done) call.fail();
    call.charge(region);
    lua_State* L = call.lua();
    push_list(call, pairs, [&](const FacePair& pair) {
        call.push_ids(std::array<Index, 2>{pair.first, pair.second});
    });
    call.set_field("faces", call.push_ids(faces));
    lua_pushvalue(L, -2);
    lua_setfield(L, -2, "region");
    lua_remove(L, -2);
}

std::vector<Function> contact_methods() {
    return {
        {.name = "contacts",
         .body = contacts,
         .summary =
             "The pairs of faces that intersect in the last result, and did not at rest. Quick "
             "enough to follow a drag: boxes around the faces are made once, and fitted to each "
             "result.",
         .results = {{"lissom.Contacts", "contacts", "The pairs; none if the list is empty."}},
         .errors = {ErrorCode::handle_removed, ErrorCode::topology_mismatch, ErrorCode::not_finite,
                    ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = R"(local bar = lissom.shapes.bar{ across = 4, along = 24 }
local deformer = lissom.deformer(bar):pin(bar:region("bottom"))
local top = deformer:add_handle(bar:region("top"))
top:rotate("z", 170):translate(0.4, -4.5, 0)
deformer:solve()
local found = deformer:contacts()
print(#found, found[1][1], found[1][2])
bar:set_region("contacts", found.region)
assert(#found > 0 and #found.faces > 1))"}};
}

}  // namespace lissom::lua
