// lissom convert IN OUT
#include <CLI/CLI.hpp>
#include <iostream>

#include "bindings/cli/json.h"
#include "bindings/cli/verbs.h"
#include "kernel/io/mesh_file.h"

namespace lissom::cli {
namespace {

struct Request {
    std::string in, out, in_up, up;
    LoadOptions load;
    SaveOptions save;
    bool text = false, big_endian = false;
};

UpAxis up_axis(const std::string& name) {
    if (name.empty()) return UpAxis::none;
    return name == "y" ? UpAxis::y : UpAxis::z;
}

void declare(CLI::App& app, Request& request) {
    app.add_option("IN", request.in, "The mesh file to read")->required();
    app.add_option("OUT", request.out, "The mesh file to write; its extension names the format")
        ->required();
    app.add_option("--up", request.up,
                   "Up axis that OUT shall have; needs --in-up where they differ")
        ->check(CLI::IsMember({"y", "z"}));
    app.add_option("--in-up", request.in_up, "Up axis of IN")->check(CLI::IsMember({"y", "z"}));
    app.add_option("--unit", request.save.unit,
                   "Length of OUT's unit: coordinates are divided by it (default: 1)")
        ->check(CLI::PositiveNumber);
    app.add_option("--in-unit", request.load.unit,
                   "Length of IN's unit: coordinates are multiplied by it (default: 1)")
        ->check(CLI::PositiveNumber);
    app.add_flag("--text", request.text, "Write text where the format has text and binary");
    app.add_flag("--big-endian", request.big_endian, "Byte order of a binary .ply");
}

}  // namespace

int convert(Program& program, const std::vector<std::string>& words) {
    CLI::App app("Reads a mesh file and writes it in another format.", "lissom convert");
    Request request;
    declare(app, request);
    int status = kSuccess;
    if (!program.parse(app, words, status)) return status;
    request.load.up = up_axis(request.in_up);
    request.save.up = up_axis(request.up);
    request.save.binary = !request.text;
    request.save.endianness = request.big_endian ? Endianness::big : Endianness::little;
    const Mesh mesh = load_mesh(request.in, request.load, program.context());
    save_mesh(mesh, request.out, request.save, program.context());
    program.clear_progress();
    if (program.json()) {
        std::cout << json_text({{"file", request.out},
                                {"vertices", mesh.vertex_count()},
                                {"faces", mesh.face_count()}})
                  << std::endl;
    }
    return kSuccess;
}

}  // namespace lissom::cli
