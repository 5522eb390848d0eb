// lissom.transfer: another mesh takes the pose of a mesh.
#include "kernel/deform/poses/transfer.h"

#include <span>
#include <vector>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/mesh/mesh_object.h"

namespace lissom::lua {
namespace {

// A pair of a script, as plain data.
struct PairSpec {
    const RegionObject *from, *to;
};

std::span<const PairSpec> read_pairs(Call& call) {
    if (!call.has("pairs")) return {};
    const auto count = raw_length(call.lua(), call.stack_index("pairs"));
    auto* pairs = call.scratch<PairSpec>(count);
    for (std::size_t i = 0; i < count; ++i) {
        call.select_item("pairs", index_of(i) + 1);
        pairs[i] = {call.object<RegionObject>("pairs.from").get(),
                    call.object<RegionObject>("pairs.to").get()};
    }
    return {pairs, count};
}

int transfer(Call& call) {
    const auto from = call.object<MeshObject>("from");
    const auto posed = call.object<MeshObject>("from_posed");
    const auto to = call.object<MeshObject>("to");
    const std::span<const PairSpec> specs = read_pairs(call);
    const auto names =
        call.has("regions") ? call.strings("regions") : std::span<const char* const>{};
    return new_mesh(call, [&] {
        std::vector<TransferPair> pairs;
        for (const PairSpec& spec : specs) {
            pairs.push_back({spec.from->current(), spec.to->current()});
        }
        for (const char* name : names) {
            pairs.push_back({from->mesh.region(name), to->mesh.region(name)});
        }
        return transferred(from->mesh, posed->mesh, to->mesh, pairs, call.context());
    });
}

}  // namespace

std::vector<Function> transfer_functions() {
    return {
        {.name = "transfer",
         .body = transfer,
         .summary =
             "Another mesh takes the pose of a mesh: each of its triangles deforms as the "
             "corresponding part of the posed mesh does (Sumner and Popovic 2004). Both meshes "
             "stand alike at rest; sizes and places may differ. Without pairs and regions their "
             "faces correspond one to one. Else points correspond by harmonic functions of the "
             "pairs: some at the ends of limbs and at the trunk serve best. Parts that the pose "
             "does not move stay.",
         .options = {object("from", "lissom.Mesh", "The mesh at rest whose pose it is."),
                     object("from_posed", "lissom.Mesh", "The same mesh posed."),
                     object("to", "lissom.Mesh", "The mesh that takes the pose, at rest."),
                     option_list("pairs",
                                 {object("from", "lissom.Region", "A part of the posed mesh."),
                                  object("to", "lissom.Region", "The part that corresponds.")},
                                 "Parts of both meshes that correspond, such as their heads.")
                         .optional("none"),
                     strings("regions",
                             "Names of regions that both meshes have and that "
                             "correspond.")
                         .optional("none")},
         .results = {{"lissom.Mesh", "mesh", "A copy of `to` in the pose."}},
         .errors = {ErrorCode::mesh_empty, ErrorCode::topology_mismatch, ErrorCode::region_empty,
                    ErrorCode::invalid_argument, ErrorCode::out_of_range, ErrorCode::unconstrained,
                    ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = R"(local bar = lissom.shapes.bar{ across = 2, along = 20 }
local bent = lissom.deform(bar:copy(), {
    pin = bar:region("bottom"),
    handles = { { region = bar:region("top"), rotate = { axis = "z", angle = 90 } } },
})
local pipe = lissom.shapes.cylinder{ radius = 0.3, height = 5 }
local posed = lissom.transfer{ from = bar, from_posed = bent, to = pipe, regions = { "top", "bottom" } }
assert(math.abs(posed:volume() / pipe:volume() - 1) < 0.1))"}};
}

}  // namespace lissom::lua
