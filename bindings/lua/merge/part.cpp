// lissom.part: files of features to paste.
#include "kernel/io/part_file.h"

#include <memory>
#include <utility>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/mesh/mesh_object.h"

namespace lissom::lua {
namespace {

int save_part_file(Call& call) {
    const char* path = call.string("path");
    const auto mesh = call.object<MeshObject>("mesh");
    const auto region = call.object<RegionObject>("region");
    const bool done = call.attempt([&] {
        Part part{mesh->mesh, region->current(), std::nullopt};
        if (call.has("feature")) {
            part.feature = call.object<RegionObject>("feature")->current();
        }
        PartFrame frame;
        if (call.has("up")) frame.up = call.vector("up");
        if (call.has("front")) frame.front = call.vector("front");
        save_part(part, frame, call.file(path, FileUse::write), call.context());
    });
    return done ? call.push(true) : call.fail();
}

// Contents of a file of a part, until they are pushed.
struct PartObjects {
    std::shared_ptr<MeshObject> mesh;
    std::shared_ptr<RegionObject> region, feature;
};

PartObjects part_objects(Part part) {
    PartObjects objects;
    objects.mesh = std::make_shared<MeshObject>(std::move(part.mesh));
    objects.region = std::make_shared<RegionObject>(objects.mesh, std::move(part.region));
    if (part.feature) {
        objects.feature = std::make_shared<RegionObject>(objects.mesh, std::move(*part.feature));
    }
    return objects;
}

void push_axis(const Call& call, const char* name, const Vec3& axis) {
    call.push_vector(axis);
    call.set_field(name);
}

int load_part_file(Call& call) {
    const char* path = call.string("path");
    auto& objects = call.hold<PartObjects>();
    lua_createtable(call.lua(), 0, 5);
    const auto mesh = call.create<MeshObject>();
    const bool done = call.attempt([&] {
        objects = part_objects(load_part(call.file(path, FileUse::read), call.context()));
        mesh.set(objects.mesh);
    });
    if (!done) return call.fail();
    call.remember(objects.mesh.get());
    call.charge(mesh);
    call.set_field("mesh");
    const auto region = call.create<RegionObject>();
    call.set_field("region");
    if (!call.attempt_quick([&] { region.set(objects.region); })) return call.fail();
    if (objects.feature) {
        const auto feature = call.create<RegionObject>();
        call.set_field("feature");
        if (!call.attempt_quick([&] { feature.set(objects.feature); })) return call.fail();
    }
    push_axis(call, "up", Vec3::UnitY());
    push_axis(call, "front", Vec3::UnitZ());
    return 1;
}

constexpr const char* kHornPart = R"(local ball = lissom.shapes.sphere{ segments = 24 }
for i = 1, ball:vertex_count() do
    local x, y, z = ball:position(i)
    if y > 0 then ball:set_position(i, x, y + 0.8 * math.exp(-12 * (x * x + z * z)), z) end
end
local path = os.tmpname() .. ".glb"
assert(lissom.part.save(path, { mesh = ball,
    region = ball:region{ sphere = { center = { 0, 1.3, 0 }, radius = 0.95 } },
    up = "z", front = "y" }))
local horn = assert(lissom.part.load(path))
os.remove(path)
)";

}  // namespace

std::vector<Function> part_functions() {
    const std::string horn = kHornPart;
    const std::vector<ErrorCode> file_errors = {
        ErrorCode::unsupported,       ErrorCode::region_empty, ErrorCode::unknown_format,
        ErrorCode::file_is_directory, ErrorCode::not_finite,   ErrorCode::memory_limit,
        ErrorCode::cancelled};
    std::vector<ErrorCode> save_errors = file_errors, load_errors = file_errors;
    save_errors.insert(
        save_errors.end(),
        {ErrorCode::topology_mismatch, ErrorCode::invalid_argument, ErrorCode::file_write_failed});
    load_errors.insert(load_errors.end(), {ErrorCode::file_not_found, ErrorCode::file_empty,
                                           ErrorCode::file_unreadable, ErrorCode::file_syntax,
                                           ErrorCode::file_truncated, ErrorCode::file_too_large,
                                           ErrorCode::face_index, ErrorCode::unsafe_path});
    return {
        {.name = "part.save",
         .body = save_part_file,
         .summary =
             "Keeps a feature for later pastes in a .glb or .gltf file: the surface of its region "
             "and three rings of faces around it, with all they carry, turned upright. Such a file "
             "opens as any other model; its regions are called \"region\" and \"feature\".",
         .arguments = {string("path", "The file.")},
         .options =
             {object("mesh", "lissom.Mesh", "The mesh that has the feature."),
              object("region", "lissom.Region", "Part of the mesh around the feature."),
              object("feature", "lissom.Region", "The feature, a part of the region.")
                  .optional("the core of the region"),
              axis("up", "The way that is up on the part: along y in the file.").optional("y"),
              axis("front",
                   "The way that it looks, at an angle to `up`: along z in the "
                   "file.")
                  .optional("z")},
         .results = {{"boolean", "done", "true."}},
         .errors = save_errors,
         .example = horn + "assert(#horn.region > 0 and horn.feature == nil)"},
        {.name = "part.load",
         .body = load_part_file,
         .summary = "Reads a feature that part.save has kept, or any .glb or .gltf file with a "
                    "region called \"region\".",
         .arguments = {string("path", "The file.")},
         .results = {{"lissom.Part", "part", "The part for lissom.paste and lissom.scatter."}},
         .errors = load_errors,
         .example = horn + R"(local paste = lissom.paste{ source = horn.mesh, region = horn.region,
    target = lissom.shapes.sphere{ radius = 2 }, placement = { at = { 2, 0, 0 }, up = horn.up } }
assert(paste:merge():is_closed()))"}};
}

std::vector<Record> part_records() {
    return {{"lissom.Part",
             "A feature to paste.",
             {{"lissom.Mesh", "mesh", "Its surface and some of that around it."},
              {"lissom.Region", "region", "The region around it."},
              {"lissom.Region|nil", "feature", "The feature, if it was given."},
              {"lissom.Vector", "up", "The way that is up on it: y."},
              {"lissom.Vector", "front", "The way that it looks: z."}}}};
}

}  // namespace lissom::lua
