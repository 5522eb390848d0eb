/// Fuzzes the mesh readers: any bytes either make a mesh or an Error, and a mesh that was read can
/// be written and read again. Run it with folders of sample files; the first collects what it
/// finds.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "kernel/core/context.h"
#include "kernel/core/error.h"
#include "kernel/io/mesh_file.h"

namespace {

using namespace lissom;

/// A limit that no honest file of the size that is fuzzed comes near.
const Context& context() {
    static const Context limited = [] {
        ContextOptions options;
        options.memory_limit = std::size_t{1} << 28;
        return Context(options);
    }();
    return limited;
}

std::optional<Mesh> decoded(std::string_view bytes, std::string_view extension,
                            const LoadOptions& options = {}) {
    try {
        return decode_mesh(bytes, extension, options, context());
    } catch (const Error& error) {
        if (error.code() == ErrorCode::internal) std::abort();
        return std::nullopt;
    }
}

/// Writing may refuse a mesh (coordinates beyond a format's range), but what it wrote must be
/// readable with the same counts. Formats that store each corner or round positions may lose faces
/// that have no area.
void check_round_trip(const Mesh& mesh, std::string_view extension) {
    std::string bytes;
    try {
        bytes = encode_mesh(mesh, extension, {}, context());
    } catch (const Error& error) {
        if (error.code() == ErrorCode::internal) std::abort();
        return;
    }
    const bool keeps_vertices = extension == "obj" || extension == "ply" || extension == "off";
    const LoadOptions as_stored{.weld = Weld::none};
    const std::optional<Mesh> again = decoded(bytes, extension, as_stored);
    if (!again) std::abort();
    if (keeps_vertices &&
        (again->vertex_count() != mesh.vertex_count() || again->face_count() != mesh.face_count()))
        std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    for (const std::string_view extension : {"obj", "ply", "off", "stl", "gltf", "glb"}) {
        const std::optional<Mesh> mesh = decoded(bytes, extension);
        if (mesh) check_round_trip(*mesh, extension);
    }
    return 0;
}
