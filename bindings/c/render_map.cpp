// Vertex buffers with seams, and the vertices that a mesh is drawn with.
#include "kernel/mesh/render/render_map.h"

#include <utility>

#include "bindings/c/attributes/attribute_space.h"
#include "bindings/c/data.h"
#include "bindings/c/mesh_options.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom::c {
namespace {

RenderMap& map_of(lissom_context& context, lissom_render_map map) {
    return context.content<RenderMap>(map.id, Kind::render_map);
}

std::vector<Vec2> read_pairs(const lissom_input* input, const char* name) {
    const std::vector<double> numbers = read_numbers(input, 2, name);
    std::vector<Vec2> pairs;
    for (std::size_t i = 0; i < numbers.size(); i += 2)
        pairs.emplace_back(numbers[i], numbers[i + 1]);
    return pairs;
}

RenderBuffer render_buffer(const lissom_context& context, const lissom_buffer& given) {
    RenderBuffer buffer;
    buffer.positions = read_points(&given.positions, context.space, "positions");
    buffer.faces =
        read_faces(&given.corners, given.sizes.count > 0 ? &given.sizes : nullptr, context.space);
    if (given.normals.count > 0) {
        const std::vector<double> numbers = read_numbers(&given.normals, 3, "normals");
        for (std::size_t i = 0; i < numbers.size(); i += 3) {
            buffer.normals.push_back(
                context.space.to_kernel(Vec3(numbers[i], numbers[i + 1], numbers[i + 2])));
        }
    }
    if (given.uvs.count > 0) buffer.uvs = read_pairs(&given.uvs, "uvs");
    return buffer;
}

std::uint64_t add_map(lissom_context& context, RenderMap&& made) {
    const std::size_t bytes = sizeof(Index) * (3 * made.vertex.size() + made.of_corner.size());
    return context.add(Kind::render_map, std::make_shared<RenderMap>(std::move(made)), bytes);
}

// Adds the mesh and its map, or neither.
void add_welded(lissom_context& context, WeldedBuffer&& made, bool with_map, JobResult& result) {
    const std::uint64_t map = with_map ? add_map(context, std::move(made.map)) : 0;
    try {
        result.objects[0] = context.add_mesh(std::move(made.mesh));
    } catch (...) {
        context.objects.release(map);
        throw;
    }
    result.objects[1] = map;
}

void require_mesh(const RenderMap& map, const Mesh& mesh) {
    require_same_topology(mesh, map.topology, "the render map");
}

}  // namespace

WeldedBuffer make_welded(const RenderBuffer& buffer, const lissom_buffer& given,
                         const Context& context) {
    RepairOptions options;
    options.weld = weld_of(given.weld);
    options.repair = given.repair;
    WeldedBuffer made = weld_buffer(buffer, options, context);
    log_findings(made.mesh.report(), context);
    return made;
}

}  // namespace lissom::c

using namespace lissom;
using namespace lissom::c;

extern "C" {

lissom_buffer lissom_default_buffer(void) {
    lissom_buffer buffer{};
    buffer.struct_size = sizeof buffer;
    buffer.corners.format = LISSOM_UINT32;
    buffer.sizes.format = LISSOM_UINT32;
    buffer.weld = LISSOM_WELD_SEAMS;
    buffer.repair = true;
    return buffer;
}

lissom_status lissom_mesh_create_welded(lissom_context* context, const lissom_buffer* buffer,
                                        lissom_mesh* mesh, lissom_render_map* map) {
    return run(context, [&] {
        require_given(buffer, "buffer");
        require_given(mesh, "mesh");
        const auto given = take_options(buffer, lissom_default_buffer());
        JobResult result;
        add_welded(*context, make_welded(render_buffer(*context, given), given, context->kernel),
                   map != nullptr, result);
        mesh->id = result.objects[0];
        if (map) map->id = result.objects[1];
    });
}

lissom_status lissom_mesh_begin_create(lissom_context* context, const lissom_buffer* buffer,
                                       lissom_job* job) {
    return run(context, [&] {
        require_given(buffer, "buffer");
        const auto given = take_options(buffer, lissom_default_buffer());
        weld_of(given.weld);
        const auto read = std::make_shared<RenderBuffer>(render_buffer(*context, given));
        const auto made = std::make_shared<WeldedBuffer>();
        begin_job(*context,
                  {{},
                   [read, made, given](const Context& inner) {
                       *made = make_welded(*read, given, inner);
                   },
                   [context, made](JobResult& result) {
                       add_welded(*context, std::move(*made), true, result);
                   }},
                  job);
    });
}

lissom_status lissom_render_map_create(lissom_context* context, lissom_mesh mesh,
                                       lissom_render_map* map) {
    return run(context, [&] {
        require_given(map, "map");
        map->id = add_map(*context, render_map(shown_mesh(*context, mesh), context->kernel));
    });
}

int32_t lissom_render_map_size(lissom_context* context, lissom_render_map map) {
    return context ? context->count([&] { return map_of(*context, map).size(); }) : -1;
}

int32_t lissom_render_map_triangle_count(lissom_context* context, lissom_render_map map) {
    if (!context) return -1;
    return context->count([&] {
        const Topology& own = *map_of(*context, map).topology;
        return own.corner_count() - 2 * own.face_count();
    });
}

lissom_status lissom_render_map_read_vertices(lissom_context* context, lissom_render_map map,
                                              const lissom_output* vertices) {
    return run(context,
               [&] { write_integers(vertices, map_of(*context, map).vertex, "vertices"); });
}

lissom_status lissom_render_map_read_triangles(lissom_context* context, lissom_render_map map,
                                               lissom_mesh mesh, const lissom_output* triangles) {
    return run(context, [&] {
        write_triangles(triangles,
                        render_triangles(map_of(*context, map), shown_mesh(*context, mesh)),
                        context->space);
    });
}

lissom_status lissom_render_map_read_positions(lissom_context* context, lissom_render_map map,
                                               lissom_mesh mesh, const lissom_output* positions) {
    return run(context, [&] {
        const RenderMap& own = map_of(*context, map);
        const Mesh& shape = shown_mesh(*context, mesh);
        require_mesh(own, shape);
        require_room(positions, own.vertex.size(), 3, "positions");
        if (!is_float(positions->format)) refuse_format("positions", "FLOAT16, FLOAT32 or FLOAT64");
        Vec3 point = Vec3::Zero();
        write_elements(
            *positions, own.vertex.size(), 3,
            [&](std::size_t, std::size_t k) { return point[index_of(k)]; },
            [&](std::size_t i) {
                if (own.vertex[i] == kNoIndex) return true;
                point = context->space.to_host(shape.position(own.vertex[i]));
                return false;
            });
    });
}

lissom_status lissom_render_map_read_normals(lissom_context* context, lissom_render_map map,
                                             lissom_mesh mesh, const lissom_output* normals) {
    return run(context, [&] {
        const RenderMap& own = map_of(*context, map);
        require_directions(normals, own.vertex.size(), 3, "normals");
        std::vector<Vec3>& found = context->normals.found;
        find_render_normals(own, shown_mesh(*context, mesh), context->normals.sums, found);
        Vec3 normal = Vec3::Zero();
        write_elements(
            *normals, own.vertex.size(), 3,
            [&](std::size_t, std::size_t k) { return normal[index_of(k)]; },
            [&](std::size_t i) {
                normal = context->space.to_host(found[i]);
                return own.vertex[i] == kNoIndex;
            });
    });
}

lissom_status lissom_render_map_read_tangents(lissom_context* context, lissom_render_map map,
                                              lissom_mesh mesh, const char* uv,
                                              const lissom_output* tangents) {
    return run(context, [&] {
        const RenderMap& own = map_of(*context, map);
        require_directions(tangents, own.vertex.size(), 4, "tangents");
        const auto found = render_tangents(own, shown_mesh(*context, mesh), uv ? uv : "uv");
        const double mirror = context->space.mirrors() ? -1.0 : 1.0;
        Vec4 tangent = Vec4::Zero();
        write_elements(
            *tangents, own.vertex.size(), 4,
            [&](std::size_t, std::size_t k) { return tangent[index_of(k)]; },
            [&](std::size_t i) {
                tangent << context->space.to_host(found[i].direction), mirror * found[i].sign;
                return own.vertex[i] == kNoIndex;
            });
    });
}

lissom_status lissom_render_map_read_attribute(lissom_context* context, lissom_render_map map,
                                               lissom_mesh mesh, const char* name,
                                               const lissom_output* values) {
    return run(context, [&] {
        const RenderMap& own = map_of(*context, map);
        const Mesh& shape = shown_mesh(*context, mesh);
        require_mesh(own, shape);
        const std::string text = given_text(name, "name");
        const Attribute* found = shape.attributes().find(text);
        if (!found || found->domain == Domain::face) {
            throw Error(ErrorCode::out_of_range,
                        "the mesh has no attribute '" + text + "' of vertices or corners");
        }
        const bool of_vertices = found->domain == Domain::vertex;
        write_attribute(values, *found, own.size(), context->space,
                        [&](std::size_t i) { return of_vertices ? own.vertex[i] : own.corner[i]; });
    });
}

}  // extern "C"
