// deformer:attach and deformer:detach: meshes that follow the deformed surface.
#include <algorithm>
#include <memory>
#include <utility>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/deform/deform_object.h"

namespace lissom::lua {
namespace {

const char* const kSphereOnBar = R"(local bar = lissom.shapes.bar{ across = 2, along = 10 }
local deformer = lissom.deformer(bar):pin(bar:region("bottom"))
local button = lissom.shapes.sphere{ radius = 0.2 }:transform{ translate = { 0.6, 1, 0 } }
)";

void detach_mesh(DeformObject& edit, const MeshObject& mesh) {
    std::erase_if(edit.attached,
                  [&](const AttachedMesh& part) { return part.mesh.get() == &mesh; });
}

int attach(Call& call) {
    const auto edit = call.self<DeformObject>();
    const auto mesh = call.object<MeshObject>("mesh");
    const AttachmentOptions options{call.choice<AttachmentMode>("mode"), call.boolean("scale"),
                                    call.has("max_distance") ? call.number("max_distance") : 0.0};
    const bool done = call.attempt([&] {
        edit->deformer();
        require(mesh.share() != edit->mesh, "a mesh cannot be attached to itself");
        Attachment made(edit->mesh->mesh, mesh->mesh, options, call.context());
        detach_mesh(*edit, *mesh);
        edit->attached.push_back({mesh.share(), mesh->mesh.shared_topology(), std::move(made)});
    });
    if (!done) return call.fail();
    call.charge(edit);
    return call.push_argument();
}

int detach(Call& call) {
    const auto edit = call.self<DeformObject>();
    const auto mesh = call.object<MeshObject>("mesh");
    const bool done = call.attempt_quick([&] { detach_mesh(*edit, *mesh); });
    return done ? call.push_argument() : call.fail();
}

}  // namespace

std::vector<Function> attachment_methods() {
    const std::vector<Result> deformer = {{"lissom.Deformer", "deformer", "The deformer itself."}};
    return {
        {.name = "attach",
         .body = attach,
         .summary =
             "Attaches another mesh, such as buttons or clothes, to the surface as both are now. "
             "Each solve moves it along. Attached again, it takes its new place.",
         .arguments = {object("mesh", "lissom.Mesh", "The mesh that follows.")},
         .options =
             {choice("mode", {"components", "vertices"},
                     "Pieces that keep their shape: connected components, such as buttons and "
                     "eyes; or none, each vertex follows the surface nearest to it, as clothes do.")
                  .defaults("components"),
              boolean("scale", "Whether pieces grow and shrink with the surface below them.")
                  .defaults(false),
              number("max_distance",
                     "Greatest distance of a component from the surface; beyond it is an error.")
                  .above(0)
                  .in("mesh units")
                  .optional("the size of the surface")},
         .results = deformer,
         .errors = {ErrorCode::mesh_empty, ErrorCode::invalid_argument, ErrorCode::memory_limit,
                    ErrorCode::topology_mismatch, ErrorCode::cancelled},
         .example = std::string(kSphereOnBar) + R"(deformer:attach(button)
deformer:add_handle(bar:region("top")):rotate("z", 60)
deformer:solve()
local center = button:bounds().center
assert(bar:nearest(center).distance < 0.2))"},
        {.name = "detach",
         .body = detach,
         .summary = "Lets an attached mesh stay at its present place from now on.",
         .arguments = {object("mesh", "lissom.Mesh",
                              "The mesh; one that is not attached is "
                              "passed over.")},
         .results = deformer,
         .errors = {ErrorCode::handle_removed},
         .example = std::string(kSphereOnBar) + R"(deformer:attach(button)
deformer:detach(button)
deformer:add_handle(bar:region("top")):rotate("z", 60)
deformer:solve()
assert(math.abs(button:bounds().center[2] - 1) < 1e-9))"}};
}

}  // namespace lissom::lua
