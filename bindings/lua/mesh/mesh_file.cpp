// lissom.load and mesh:save.
#include <filesystem>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/up_option.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/mesh/weld_option.h"
#include "kernel/io/mesh_file.h"

namespace lissom::lua {
namespace {

int load(Call& call) {
    const char* path = call.string("path");
    LoadOptions options;
    options.up = up_axis(call);
    options.unit = call.number("unit");
    options.repair = call.boolean("repair");
    options.unused = call.choice<UnusedVertices>("unused");
    if (call.has("weld")) options.weld = given_weld(call);
    return new_mesh(
        call, [&] { return load_mesh(call.file(path, FileUse::read), options, call.context()); });
}

int save(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const char* path = call.string("path");
    SaveOptions options;
    options.up = up_axis(call);
    options.unit = call.number("unit");
    options.binary = call.boolean("binary");
    options.endianness = call.choice<Endianness>("endianness");
    options.origin = call.choice<FileOrigin>("origin");
    options.normals = call.boolean("normals");
    options.compression = call.choice<Compression>("compression");
    if (call.has("quantize")) options.quantize = call.integer("quantize");
    SavedFile saved;
    const bool done = call.attempt([&] {
        saved = save_mesh(mesh->mesh, call.file(path, FileUse::write), options, call.context());
    });
    if (!done) return call.fail();
    call.push_argument();
    return 1 + (options.origin == FileOrigin::keep ? 0 : call.push_vector(saved.origin));
}

Parameter up_option(const std::string& help) {
    return choice("up", {"y", "z"}, help).optional("as it is");
}

Parameter unit_option(const std::string& help) {
    return number("unit", help).defaults(1.0).above(0).in("mesh units");
}

}  // namespace

std::vector<Function> mesh_file_functions() {
    return {
        {.name = "load",
         .body = load,
         .summary =
             "Reads a mesh from an .obj, .ply, .off, .stl, .gltf or .glb file, with its groups, "
             "materials, texture coordinates, normals, colours, skins and morph targets. It is "
             "checked and repaired: mesh:report() lists the changes.",
         .arguments = {string("path", "The file; its extension names the format.")},
         .options = {weld_option().optional("\"all\" for .stl, \"seams\" for others"),
                     choice("unused", {"drop", "keep"},
                            "Treatment of vertices that no face uses. \"keep\" leaves them in "
                            "their order, for programs that match vertices by number; with weld "
                            "= false all vertices of a sound file keep their numbers.")
                         .defaults("drop"),
                     boolean("repair",
                             "false makes each defect that would be mended, and each face without "
                             "area, an error that names the elements.")
                         .defaults(true),
                     up_option("The file's up axis; z is turned to y, which is up here."),
                     unit_option("Length of the file's unit in the unit of the mesh: positions are "
                                 "multiplied by it.")},
         .results = {{"lissom.Mesh", "mesh", "The mesh."}},
         .errors = {ErrorCode::file_not_found,
                    ErrorCode::file_is_directory,
                    ErrorCode::file_empty,
                    ErrorCode::file_unreadable,
                    ErrorCode::file_syntax,
                    ErrorCode::file_truncated,
                    ErrorCode::file_too_large,
                    ErrorCode::unknown_format,
                    ErrorCode::unsafe_path,
                    ErrorCode::unsupported,
                    ErrorCode::not_finite,
                    ErrorCode::face_index,
                    ErrorCode::face_too_small,
                    ErrorCode::repeated_vertex,
                    ErrorCode::duplicate_face,
                    ErrorCode::nonmanifold_edge,
                    ErrorCode::inconsistent_orientation,
                    ErrorCode::nonmanifold_vertex,
                    ErrorCode::unreferenced_vertex,
                    ErrorCode::zero_area,
                    ErrorCode::memory_limit,
                    ErrorCode::cancelled},
         .example = R"(local mesh, problem = lissom.try(lissom.load, "missing.obj")
assert(mesh == nil and problem.code == "file_not_found"))"}};
}

std::vector<Function> mesh_file_methods() {
    const SaveOptions defaults;
    return {
        {.name = "save",
         .body = save,
         .summary = "Writes the mesh to a file, whole or not at all.",
         .arguments = {string("path", "The file; its extension names the format.")},
         .options =
             {boolean("normals",
                      "Write the normals of the surface, one a vertex, for a mesh without the "
                      "attribute \"normal\". STL has those of its triangles in any case.")
                  .defaults(defaults.normals),
              choice("compression", {"none", "meshopt", "draco"},
                     "Compression of .glb and .gltf: \"meshopt\" (EXT_meshopt_compression) of all "
                     "vertices, morph targets and indices, \"draco\" "
                     "(KHR_draco_mesh_compression). Vertices and faces keep their order, but for "
                     "vertices of objects that have several materials under \"draco\".")
                  .defaults("none"),
              integer(
                  "quantize",
                  "Bits of positions in a .glb or .gltf file, relative to the size of the object: "
                  "14 keep a 16000th. Texture coordinates have as many, and directions half as "
                  "many but at least 8; so have morph targets. Without compression they are "
                  "integers (KHR_mesh_quantization), but for positions, if these are as fine "
                  "and the numbers lie from -1 to 1.")
                  .between(6, 20)
                  .optional("all numbers are kept"),
              up_option("The up axis that the file shall have."),
              unit_option("Length of the file's unit in the unit of the mesh: positions are "
                          "divided by it."),
              boolean("binary", "Binary or text, for .ply and .stl.").defaults(defaults.binary),
              choice("endianness", {"little", "big"}, "Byte order of a binary .ply.")
                  .defaults("little"),
              choice("origin", {"keep", "auto"},
                     "\"auto\" moves the file's origin into a mesh that is farther from it than "
                     "it is large, so that 32-bit numbers (.glb, .gltf, binary .stl) can hold its "
                     "detail. glTF keeps the place in its nodes; for other formats it is returned.")
                  .defaults("keep")},
         .results = {{"lissom.Mesh", "mesh", "The mesh itself."},
                     {"lissom.Vector?", "origin",
                      "With origin = \"auto\": the point of the mesh that is the origin of the "
                      "file, zero if it stayed or glTF keeps it."}},
         .errors = {ErrorCode::unknown_format, ErrorCode::file_write_failed,
                    ErrorCode::file_is_directory, ErrorCode::not_finite, ErrorCode::unsupported,
                    ErrorCode::invalid_argument, ErrorCode::cancelled},
         .example = R"(local path = os.tmpname() .. ".obj"
local mesh = lissom.shapes.box()
assert(mesh:save(path))
assert(assert(lissom.load(path)) == mesh)
os.remove(path))"}};
}

}  // namespace lissom::lua
