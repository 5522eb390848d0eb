// Meshes: in and out of the host's memory and of files.
#include "kernel/mesh/mesh.h"

#include <algorithm>

#include "bindings/c/data.h"
#include "bindings/c/mesh_options.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/normals_in_place.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/query/path.h"

namespace lissom::c {
namespace {

LoadOptions load_options(const lissom_mesh_load_options* given) {
    const auto taken = take_options(given, lissom_default_mesh_load_options());
    LoadOptions options;
    const Weld weld = weld_of(taken.weld);
    if (taken.weld != LISSOM_WELD_AUTOMATIC) options.weld = weld;
    options.repair = taken.repair;
    if (taken.z_up) options.up = UpAxis::z;
    options.unit = taken.unit;
    return options;
}

SaveOptions save_options(const lissom_mesh_save_options* given) {
    const auto taken = take_options(given, lissom_default_mesh_save_options());
    SaveOptions options;
    if (taken.z_up) options.up = UpAxis::z;
    options.unit = taken.unit;
    options.binary = taken.binary;
    require(taken.compression >= LISSOM_COMPRESSION_NONE &&
                taken.compression <= LISSOM_COMPRESSION_DRACO,
            "there is no such compression");
    if (taken.compression == LISSOM_COMPRESSION_MESHOPT) options.compression = Compression::meshopt;
    if (taken.compression == LISSOM_COMPRESSION_DRACO) options.compression = Compression::draco;
    options.quantize = taken.quantize;
    return options;
}

FaceList faces_of(const Mesh& mesh, bool reversed) {
    FaceList faces;
    for (Index f = 0; f < mesh.face_count(); ++f) faces.add(mesh.topology().face(f));
    if (reversed) reverse_faces(faces);
    return faces;
}

}  // namespace

Weld weld_of(lissom_weld weld) {
    require(weld >= LISSOM_WELD_AUTOMATIC && weld <= LISSOM_WELD_NONE, "there is no such weld");
    if (weld == LISSOM_WELD_ALL) return Weld::all;
    return weld == LISSOM_WELD_NONE ? Weld::none : Weld::seams;
}

}  // namespace lissom::c

using namespace lissom;
using namespace lissom::c;

extern "C" {

lissom_mesh_load_options lissom_default_mesh_load_options(void) {
    lissom_mesh_load_options options{};
    options.struct_size = sizeof options;
    options.repair = true;
    options.unit = 1.0;
    return options;
}

lissom_mesh_save_options lissom_default_mesh_save_options(void) {
    lissom_mesh_save_options options{};
    options.struct_size = sizeof options;
    options.unit = 1.0;
    options.binary = true;
    return options;
}

lissom_status lissom_mesh_create(lissom_context* context, const lissom_input* positions,
                                 const lissom_input* corners, const lissom_input* sizes,
                                 lissom_mesh* mesh) {
    return run(context, [&] {
        require_given(mesh, "mesh");
        FaceList faces = read_faces(corners, sizes, context->space);
        Mesh made(read_points(positions, context->space, "positions"), std::move(faces),
                  context->kernel);
        mesh->id = context->add_mesh(std::move(made));
    });
}

lissom_status lissom_mesh_load(lissom_context* context, const char* path,
                               const lissom_mesh_load_options* options, lissom_mesh* mesh) {
    return run(context, [&] {
        require_given(mesh, "mesh");
        Mesh made =
            load_mesh(path_of(given_text(path, "path")), load_options(options), context->kernel);
        mesh->id = context->add_mesh(std::move(made));
    });
}

lissom_status lissom_mesh_begin_load(lissom_context* context, const char* path,
                                     const lissom_mesh_load_options* options, lissom_job* job) {
    return run(context, [&] {
        const auto made = std::make_shared<Mesh>();
        begin_job(*context,
                  {{},
                   [made, file = path_of(given_text(path, "path")), wanted = load_options(options)](
                       const Context& inner) { *made = load_mesh(file, wanted, inner); },
                   [context, made](JobResult& result) {
                       result.objects[0] = context->add_mesh(std::move(*made));
                   }},
                  job);
    });
}

lissom_status lissom_mesh_begin_save(lissom_context* context, lissom_mesh mesh, const char* path,
                                     const lissom_mesh_save_options* options, lissom_job* job) {
    return run(context, [&] {
        begin_job(*context,
                  {{},
                   [own = mesh_for_job(*context, mesh), file = path_of(given_text(path, "path")),
                    wanted = save_options(options)](const Context& inner) {
                       save_mesh(*own, file, wanted, inner);
                   }},
                  job);
    });
}

lissom_status lissom_mesh_decode(lissom_context* context, const void* bytes, size_t size,
                                 const char* extension, const lissom_mesh_load_options* options,
                                 lissom_mesh* mesh) {
    return run(context, [&] {
        if (size > 0) require_given(bytes, "bytes");
        require_given(mesh, "mesh");
        Mesh made =
            decode_mesh({static_cast<const char*>(bytes), size}, given_text(extension, "extension"),
                        load_options(options), context->kernel);
        mesh->id = context->add_mesh(std::move(made));
    });
}

lissom_status lissom_mesh_save(lissom_context* context, lissom_mesh mesh, const char* path,
                               const lissom_mesh_save_options* options) {
    return run(context, [&] {
        save_mesh(shown_mesh(*context, mesh), path_of(given_text(path, "path")),
                  save_options(options), context->kernel);
    });
}

lissom_status lissom_mesh_encode(lissom_context* context, lissom_mesh mesh, const char* extension,
                                 const lissom_mesh_save_options* options, lissom_bytes* bytes) {
    return run(context, [&] {
        require_given(bytes, "bytes");
        context->bytes = encode_mesh(shown_mesh(*context, mesh), given_text(extension, "extension"),
                                     save_options(options), context->kernel);
        *bytes = {context->bytes.data(), context->bytes.size()};
    });
}

lissom_status lissom_mesh_copy(lissom_context* context, lissom_mesh mesh, lissom_mesh* copy) {
    return run(context, [&] {
        require_given(copy, "copy");
        Mesh made = shown_mesh(*context, mesh);
        copy->id = context->add_mesh(std::move(made));
    });
}

int32_t lissom_mesh_vertex_count(lissom_context* context, lissom_mesh mesh) {
    return context ? context->count([&] { return shown_mesh(*context, mesh).vertex_count(); }) : -1;
}

int32_t lissom_mesh_face_count(lissom_context* context, lissom_mesh mesh) {
    return context ? context->count([&] { return shown_mesh(*context, mesh).face_count(); }) : -1;
}

int32_t lissom_mesh_corner_count(lissom_context* context, lissom_mesh mesh) {
    if (!context) return -1;
    return context->count(
        [&] { return element_count(shown_mesh(*context, mesh).topology(), Domain::corner); });
}

int32_t lissom_mesh_triangle_count(lissom_context* context, lissom_mesh mesh) {
    if (!context) return -1;
    return context->count([&] {
        const Mesh& own = shown_mesh(*context, mesh);
        return element_count(own.topology(), Domain::corner) - 2 * own.face_count();
    });
}

int32_t lissom_mesh_boundary_count(lissom_context* context, lissom_mesh mesh) {
    if (!context) return -1;
    return context->count([&] { return count_of(boundaries(shown_mesh(*context, mesh))); });
}

lissom_status lissom_mesh_read_positions(lissom_context* context, lissom_mesh mesh,
                                         const lissom_output* positions) {
    return run(context, [&] {
        const auto points = shown_mesh(*context, mesh).positions();
        write_points(positions, points.size(), "positions",
                     [&](std::size_t i) { return context->space.to_host(points[i]); });
    });
}

lissom_status lissom_mesh_read_normals(lissom_context* context, lissom_mesh mesh,
                                       const lissom_output* normals) {
    return run(context, [&] {
        const Mesh& shown = shown_mesh(*context, mesh);
        std::vector<Vec3>& own = context->normals.found;
        own.resize(at(shown.vertex_count()));
        find_vertex_normals(shown, own);
        write_directions(normals, own.size(), "normals",
                         [&](std::size_t i) { return context->space.to_host(own[i]); });
    });
}

lissom_status lissom_mesh_read_triangles(lissom_context* context, lissom_mesh mesh,
                                         const lissom_output* triangles) {
    return run(context, [&] {
        const Mesh& own = shown_mesh(*context, mesh);
        write_triangles(triangles, triangulate_faces(own.topology(), own.positions()).triangles,
                        context->space);
    });
}

lissom_status lissom_mesh_read_faces(lissom_context* context, lissom_mesh mesh,
                                     const lissom_output* corners, const lissom_output* sizes) {
    return run(context, [&] {
        const FaceList faces = faces_of(shown_mesh(*context, mesh), context->space.reverses());
        std::vector<Index> counts(at(faces.size()));
        for (std::size_t f = 0; f < counts.size(); ++f) {
            counts[f] = faces.offsets[f + 1] - faces.offsets[f];
        }
        if (sizes) require_room(sizes, counts.size(), 1, "sizes");
        if (corners) write_integers(corners, faces.vertices, "corners");
        if (sizes) write_integers(sizes, counts, "sizes");
    });
}

lissom_status lissom_mesh_read_boundary(lissom_context* context, lissom_mesh mesh, int32_t number,
                                        const lissom_output* vertices, int32_t* count) {
    return run(context, [&] {
        const auto loops = boundaries(shown_mesh(*context, mesh));
        if (number < 0 || number >= count_of(loops)) {
            throw Error(ErrorCode::out_of_range, "the mesh has " + std::to_string(loops.size()) +
                                                     " boundaries, numbered from 0");
        }
        const std::vector<Index>& loop = loops[at(number)].vertices();
        if (vertices) write_integers(vertices, loop, "vertices");
        if (count) *count = count_of(loop);
    });
}

lissom_status lissom_mesh_set_positions(lissom_context* context, lissom_mesh mesh,
                                        const lissom_input* positions) {
    return run(context, [&] {
        Mesh& own = mesh_of(*context, mesh);
        own.set_positions(read_points(positions, context->space, "positions"));
        context->sharing.changed(own);
    });
}

lissom_status lissom_mesh_transform(lissom_context* context, lissom_mesh mesh,
                                    const lissom_transform* map) {
    return run(context, [&] {
        require_given(map, "map");
        Mesh& own = mesh_of(*context, mesh);
        lissom::transform(own, context->space.to_kernel(*map), context->kernel);
        context->sharing.changed(own);
    });
}

lissom_status lissom_mesh_bounds(lissom_context* context, lissom_mesh mesh, double least[3],
                                 double greatest[3]) {
    return run(context, [&] {
        require_given(least, "least");
        require_given(greatest, "greatest");
        const Box box = bounds(shown_mesh(*context, mesh));
        require(!box.empty(), "the mesh has no vertices", ErrorCode::mesh_empty);
        const Vec3 a = context->space.to_host(box.min), b = context->space.to_host(box.max);
        for (int k = 0; k < 3; ++k) {
            least[k] = std::min(a[k], b[k]);
            greatest[k] = std::max(a[k], b[k]);
        }
    });
}

lissom_status lissom_mesh_hash(lissom_context* context, lissom_mesh mesh, uint64_t* hash) {
    return run(context, [&] {
        require_given(hash, "hash");
        *hash = lissom::hash(shown_mesh(*context, mesh));
    });
}

}  // extern "C"
