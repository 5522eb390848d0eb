// lissom convert IN OUT, and lissom convert --in PATTERN... --out FOLDER
#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "bindings/cli/batch/files/files_verb.h"
#include "bindings/cli/conversion.h"
#include "bindings/cli/json.h"
#include "bindings/cli/load_flags.h"
#include "bindings/cli/scene_input.h"
#include "bindings/cli/verbs.h"

namespace lissom::cli {
namespace {

struct Request {
    FilesVerb many{"convert"};
    std::string in, out, in_up, up, origin, compression;
    std::optional<double> in_unit;
    ConversionOptions options;
    LoadFlags load_flags;
    bool text = false, big_endian = false;

    bool is_for_many() const {
        const ManyFiles& files = many.files;
        return many.is_for_many() || !files.out_folder.empty() || !files.extension.empty();
    }
};

const char* const kDescription =
    "Reads mesh files, hair files, or what is visible of a scene (.lissom), and writes them in "
    "another format. Hair goes to .hair, .data, .usda, .tfx, .ply and .rib, and as lines to .glb, "
    ".gltf and "
    ".obj. Of a scene the meshes are written as one, or its hair where the format holds only hair "
    "or the scene has no mesh.\n\n"
    "  lissom convert IN OUT                                    one file\n"
    "  lissom convert --in 'a/*.obj' --out b/ --to glb          many files\n"
    "  lissom convert --in 'a/**/*.ply' other/ --out b/         with their folders\n\n"
    "Many files are converted several at a time. A failure does not stop the others; a table lists "
    "the results of all, and index.html in the output folder too. The same command again converts "
    "only files that have changed or failed. An output replaces an older file of its name, but not "
    "one of the files to read (unless --force), and not the output of another input. Exit status: "
    "0 all done, 1 some failed, 2 called wrongly.";

UpAxis up_axis(const std::string& name) {
    if (name.empty()) return UpAxis::none;
    return name == "y" ? UpAxis::y : UpAxis::z;
}

// The extension as the kernel lists it: without a dot, in lower case.
std::string normalized(const std::string& extension) {
    return CLI::detail::to_lower(extension.substr(extension.starts_with('.') ? 1 : 0));
}

std::vector<std::string> known_extensions() {
    std::vector<std::string> known = writable_extensions();
    const std::vector<std::string> of_hair = hair_only_extensions();
    known.insert(known.end(), of_hair.begin(), of_hair.end());
    return known;
}

void declare_files(CLI::App& app, Request& request) {
    app.add_option("IN", request.in, "The mesh file, hair file or scene to read");
    app.add_option("OUT", request.out, "The file to write; its extension names the format");
    app.add_option("--out", request.many.files.out_folder,
                   "Folder to write to, created if it is missing; sub-folders are kept");
    app.add_option("--to", request.many.files.extension,
                   "Format of the files in --out, by its extension (default: each as it was)")
        ->transform(normalized)
        ->check(CLI::IsMember(known_extensions()));
    app.add_flag("--force", request.options.force, "Let outputs replace files to read");
}

void declare(CLI::App& app, Request& request) {
    declare_files(app, request);
    app.add_option("--up", request.up,
                   "Up axis that the output shall have; needs --in-up if they differ")
        ->check(CLI::IsMember({"y", "z"}));
    app.add_option("--in-up", request.in_up, "Up axis of the input")
        ->check(CLI::IsMember({"y", "z"}));
    app.add_option("--unit", request.options.save.unit,
                   "Length of the output's unit: coordinates are divided by it (default: 1)")
        ->check(CLI::PositiveNumber);
    app.add_option("--in-unit", request.in_unit,
                   "Length of the input's unit: coordinates are multiplied by it (default: 1, of "
                   "hair what the file says)")
        ->check(CLI::PositiveNumber);
    app.add_option("--origin", request.origin,
                   "auto: move the output's origin into a mesh that is far from it, so that 32-bit "
                   "numbers can hold its detail (default: keep)")
        ->check(CLI::IsMember({"keep", "auto"}));
    app.add_flag("--text", request.text, "Write text if the format has text and binary");
    app.add_flag("--normals", request.options.save.normals,
                 "Write the normals of the surface for meshes that have none");
    app.add_option("--compression", request.compression,
                   "Compression of .glb and .gltf: meshopt or draco (default: none)")
        ->check(CLI::IsMember({"none", "meshopt", "draco"}));
    app.add_option("--quantize", request.options.save.quantize,
                   "Bits of positions in a compressed file, relative to the size of the object "
                   "(default: all numbers are kept)")
        ->check(CLI::Range(6, 20));
    app.add_flag("--big-endian", request.big_endian, "Byte order of a binary .ply");
    request.load_flags.declare(app);
    request.many.declare(app);
}

// Options that say how meshes are read and written.
std::vector<std::string> mesh_only(const CLI::App& app) {
    std::vector<std::string> given;
    for (const char* name : {"--origin", "--text", "--normals", "--compression", "--quantize",
                             "--big-endian", "--weld", "--keep-unused"}) {
        if (app.count(name) > 0) given.emplace_back(name);
    }
    return given;
}

void complete_hair(Request& request) {
    ConversionOptions& options = request.options;
    options.hair_load.up = options.load.up;
    options.hair_load.unit = request.in_unit;
    options.hair_save.up = options.save.up;
    options.hair_save.unit = options.save.unit;
    options.hair_save.mend = options.load.repair;
}

void complete(Request& request) {
    request.options.load.up = up_axis(request.in_up);
    request.options.save.up = up_axis(request.up);
    request.options.save.binary = !request.text;
    request.options.save.endianness = request.big_endian ? Endianness::big : Endianness::little;
    if (request.compression == "meshopt") request.options.save.compression = Compression::meshopt;
    if (request.compression == "draco") request.options.save.compression = Compression::draco;
    if (request.origin == "auto") request.options.save.origin = FileOrigin::automatic;
    request.load_flags.apply(request.options.load);
    request.options.load.unit = request.in_unit.value_or(1.0);
    complete_hair(request);
}

// Returns the defect of the choice of files; empty if there is none.
std::string misuse(const CLI::App& app, const Request& request) {
    const std::string wrong = request.many.misuse(app, {request.in});
    if (!wrong.empty()) return wrong;
    if (!request.is_for_many()) {
        return request.out.empty() ? "IN and OUT are required, or --in and --out" : "";
    }
    if (!request.in.empty()) return "IN and OUT do not go with --in, --out and --to";
    if (!request.many.is_for_many()) return "--in is missing: the files to read";
    return request.many.files.out_folder.empty() ? "--out is missing: the folder to write to" : "";
}

bool is_among(const std::vector<std::string>& extensions, const std::string& extension) {
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

// Folders name the files that can become the format of --to.
int convert_files(Program& program, const CLI::App& app, Request& request) {
    ManyFiles& files = request.many.files;
    files.force = request.options.force;
    const std::string& to = files.extension;
    if (!to.empty()) {
        files.kinds = {is_among(writable_extensions(), to),
                       is_among(writable_strand_extensions(), to)};
        files.kinds_text = " that can become ." + to;
    }
    const FileColumn vertices{"vertices", 9, [](const Json& answer) {
                                  const char* const name =
                                      answer.contains("points") ? "points" : "vertices";
                                  return number_column(name, 9).text(answer);
                              }};
    return request.many.run(
        program, app, {"--out", "--to", "--force"}, "",
        {{"converted", "repaired"},
         {vertices, number_column("faces", 9), number_column("seconds", 8, 2)}});
}

int convert_one(Program& program, const Request& request) {
    const Conversion done = convert_file(program, request.in, request.out, request.options);
    program.clear_progress();
    if (program.json()) program.answer(json_text(conversion_json(done)));
    return kSuccess;
}

}  // namespace

int convert(Program& program, const std::vector<std::string>& words) {
    CLI::App app(kDescription, "lissom convert");
    Request request;
    declare(app, request);
    int status = kSuccess;
    if (!request.many.parse(program, app, words, status)) return status;
    const std::string wrong = misuse(app, request);
    if (!wrong.empty()) {
        return program.fail("lissom convert: " + wrong + " (see lissom convert --help)", kUsage);
    }
    complete(request);
    request.options.mesh_only = mesh_only(app);
    if (request.is_for_many()) return convert_files(program, app, request);
    return convert_one(program, request);
}

}  // namespace lissom::cli
