// lissom.Strands: files.
#include <filesystem>

#include "bindings/lua/core/up_option.h"
#include "bindings/lua/hair/strands_methods.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/io/strand_file.h"

namespace lissom::lua {
namespace {

int load_hair(Call& call) {
    const char* path = call.string("path");
    StrandLoadOptions options;
    options.up = up_axis(call);
    if (call.has("unit")) options.unit = call.number("unit");
    return new_strands(call, [&] {
        return load_strands(call.file(path, FileUse::read), options, call.context());
    });
}

void push_findings(const Call& call, const StrandReport& report) {
    lua_createtable(call.lua(), count_of(report.findings), 0);
    int i = 0;
    for (const StrandFinding& finding : report.findings) {
        lua_createtable(call.lua(), 0, 4);
        call.set_field("kind", call.push(strand_finding_name(finding.kind)));
        call.set_field("message", call.push(std::string_view(finding.message)));
        call.set_field("count", call.push_count(finding.elements.count));
        call.set_field("strands", call.push_ids(finding.elements.ids));
        lua_rawseti(call.lua(), -2, ++i);
    }
}

bool has_rib_scene(const Call& call, bool has_skeleton) {
    return (call.has("head") && !has_skeleton) || call.has("camera") || call.boolean("archive");
}

// Inside Call::attempt only.
RibScene rib_scene(const Call& call) {
    RibScene scene;
    scene.archive = call.boolean("archive");
    if (call.has("head")) scene.head = &call.object<MeshObject>("head")->mesh;
    if (call.has("camera")) {
        CameraOptions camera;
        camera.eye = call.vector("camera.eye");
        camera.target = call.vector("camera.target");
        camera.up = call.vector("camera.up");
        camera.fov = call.number("camera.fov") * kDegree;
        scene.camera = camera;
    }
    return scene;
}

int save_hair(Call& call) {
    const auto strands = call.self<StrandsObject>();
    const char* path = call.string("path");
    auto& report = call.hold<StrandReport>();
    const bool done = call.attempt([&] {
        StrandSaveOptions options;
        options.up = up_axis(call);
        options.unit = call.number("unit");
        options.mend = call.boolean("mend");
        const bool is_usda = call.has("head") && std::string_view(path).ends_with(".usda");
        if (is_usda) options.head = &call.object<MeshObject>("head")->mesh;
        report = has_rib_scene(call, is_usda)
                     ? save_rib(strands->strands, call.file(path, FileUse::write), rib_scene(call),
                                options, call.context())
                     : save_strands(strands->strands, call.file(path, FileUse::write), options,
                                    call.context());
    });
    if (!done) return call.fail();
    call.push_argument();
    push_findings(call, report);
    return 2;
}

Parameter up_option(const std::string& help, const std::string& usual) {
    return choice("up", {"y", "z"}, help).optional(usual);
}

}  // namespace

Function strands_save_method() {
    return {
        .name = "save",
        .body = save_hair,
        .summary =
            "Writes the strands to a .hair, .data, .usda, .tfx, .ply, .rib, .glb, .gltf or .obj "
            "file, "
            "whole or not at all. They are checked before, and changed if they would break in "
            "other programs; the strands themselves stay as they are.",
        .arguments = {string("path", "The file; its extension names the format.")},
        .options = {up_option("The up axis that the file shall have.", "y"),
                    number("unit",
                           "Length of the file's unit in metres: points and widths are divided "
                           "by it.")
                        .defaults(1.0)
                        .above(0)
                        .in("metres"),
                    boolean("mend",
                            "false makes a change or an omission an error that names the strands.")
                        .defaults(true),
                    object("head", "lissom.Mesh",
                           "For .rib: the head that the picture shows. For .usda: the head that "
                           "the hair grew on, with a skin of its file; the strands are bound to "
                           "its joints (UsdSkel).")
                        .optional("none"),
                    options("camera",
                            {vector("eye", "Its position, in units of the head."),
                             vector("target", "The middle of the picture."),
                             axis("up", "Direction upwards.").defaults("y"),
                             number("fov", "Vertical opening angle.")
                                 .above(0)
                                 .between(0, 179)
                                 .in("degrees")
                                 .defaults(30.0)},
                            "For .rib: the camera of the picture.")
                        .optional("hair and head whole, from the front, a little aside"),
                    boolean("archive",
                            "For .rib: the curves alone, for other RIB files to read; else a scene "
                            "with camera, lights and shaders, of which a RenderMan renderer makes "
                            "the picture.")
                        .defaults(false)},
        .results = {kSelfStrands.front(),
                    {"lissom.StrandFinding[]", "report", "Findings, changes and omissions."}},
        .errors = {ErrorCode::unknown_format, ErrorCode::file_write_failed,
                   ErrorCode::file_is_directory, ErrorCode::file_too_large, ErrorCode::not_finite,
                   ErrorCode::skin_mismatch, ErrorCode::memory_limit, ErrorCode::cancelled},
        .example = kTwoStrands + R"(local path = os.tmpname() .. ".hair"
assert(hair:save(path))
assert(#assert(lissom.load_strands(path)) == 2)
os.remove(path))"};
}

Function load_strands_function() {
    return {
        .name = "load_strands",
        .body = load_hair,
        .summary =
            "Reads hair from a .hair, .data (HairSalon, HairNet), .usda (BasisCurves), .tfx "
            "(TressFX), .glb, .gltf (lines) or .ply file (points with edges, as HairStep and "
            "Open3D write them, or "
            "with an element 'strand').",
        .arguments = {string("path", "The file; its extension names the format.")},
        .options = {up_option("The file's up axis; z is turned to y, which is up here.",
                              "the file's own, else y"),
                    number("unit", "Length of the file's unit in metres.")
                        .above(0)
                        .in("metres")
                        .optional("the file's own, else 1")},
        .results = {{"lissom.Strands", "strands", "The strands."}},
        .errors = {ErrorCode::file_not_found, ErrorCode::file_is_directory, ErrorCode::file_empty,
                   ErrorCode::file_unreadable, ErrorCode::file_syntax, ErrorCode::file_truncated,
                   ErrorCode::file_too_large, ErrorCode::unknown_format, ErrorCode::unsupported,
                   ErrorCode::not_finite, ErrorCode::memory_limit, ErrorCode::cancelled},
        .example = R"(local hair, problem = lissom.try(lissom.load_strands, "missing.hair")
assert(hair == nil and problem.code == "file_not_found"))"};
}

}  // namespace lissom::lua
