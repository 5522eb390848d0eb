// lissom.Mesh: nearest points, rays and distances.
#include "bindings/lua/core/library.h"
#include "bindings/lua/mesh/buffer.h"
#include "bindings/lua/mesh/mesh_object.h"

namespace lissom::lua {
namespace {

int push_surface_point(const Call& call, const SurfacePoint& point) {
    lua_createtable(call.lua(), 0, 7);
    call.set_field("position", call.push_vector(point.position));
    call.set_field("face", call.push_id(point.face));
    call.set_field("vertex", call.push_id(point.vertex));
    call.set_field("triangle", call.push_ids(point.triangle));
    call.set_field("bary", call.push_vector(point.barycentric));
    call.set_field("normal", call.push_vector(point.normal));
    call.set_field("distance", call.push(point.distance));
    return 1;
}

int nearest(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const Vec3 point = call.vector("point");
    SurfacePoint found;
    const bool done = call.attempt([&] { found = mesh->tree(call.context()).nearest(point); });
    if (!done) return call.fail();
    call.charge(mesh);
    return push_surface_point(call, found);
}

int pick(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const Vec3 origin = call.vector("origin"), direction = call.vector("direction");
    SurfacePoint found;
    bool hit = false;
    const bool done = call.attempt([&] {
        const auto first = mesh->tree(call.context()).pick(origin, direction);
        hit = first.has_value();
        if (hit) found = *first;
    });
    if (!done) return call.fail();
    call.charge(mesh);
    if (hit) return push_surface_point(call, found);
    lua_pushnil(call.lua());
    return 1;
}

// The vertices that distances start at.
std::vector<Index> sources(const Call& call) {
    switch (call.kind("from")) {
        case Kind::id:
            return {call.id("from")};
        case Kind::object:
            return call.object<RegionObject>("from")->current().vertices();
        default: {
            const auto ids = call.ids("from");
            return {ids.begin(), ids.end()};
        }
    }
}

int distances(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const bool along_edges = call.integer("method") == 1;
    const auto result = call.create<BufferObject>();
    const bool done = call.attempt([&] {
        auto buffer = std::make_shared<BufferObject>();
        const std::vector<Index> from = sources(call);
        buffer->values =
            along_edges ? edge_distances(mesh->mesh, from, std::numeric_limits<double>::infinity(),
                                         call.context())
                        : mesh->heat(call.context()).from(from, call.context());
        result.set(std::move(buffer));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

}  // namespace

std::vector<Function> mesh_query_methods() {
    return {{.name = "nearest",
             .body = nearest,
             .summary = "The point of the surface nearest to a given one.",
             .arguments = {vector("point", "Three numbers or {x, y, z}.")},
             .results = {{"lissom.SurfacePoint", "found", "The nearest point."}},
             .errors = {ErrorCode::mesh_empty, ErrorCode::cancelled},
             .example = "assert(lissom.shapes.box():nearest(0, 2, 0).distance == 1.5)"},
            {.name = "pick",
             .body = pick,
             .summary = "The first point of the surface that a ray hits, on either side.",
             .arguments = {vector("origin", "Where the ray starts."),
                           vector("direction", "Where it goes; any length.")},
             .results = {{"lissom.SurfacePoint?", "hit", "The point; nil where the ray misses."}},
             .errors = {ErrorCode::mesh_empty, ErrorCode::invalid_argument, ErrorCode::cancelled},
             .example = R"(local hit = lissom.shapes.box():pick({ 0.1, 0.2, 5 }, { 0, 0, -1 })
assert(math.abs(hit.position[3] - 0.5) < 1e-12))"},
            {.name = "distances",
             .body = distances,
             .summary =
                 "Distance of every vertex over the surface to the nearest of the given vertices; "
                 "infinite where there is no way.",
             .options = {either("from",
                                {id("vertex", "One vertex."),
                                 object("region", "lissom.Region", "The vertices of a region."),
                                 ids("list", "A list of vertices.")},
                                "Where distances start."),
                         choice("method", {"heat", "edges"},
                                "Geodesic by the heat method, or along edges.")
                             .defaults("heat")},
             .results = {{"lissom.Buffer", "distances", "One number a vertex."}},
             .errors = {ErrorCode::out_of_range, ErrorCode::invalid_argument, ErrorCode::mesh_empty,
                        ErrorCode::memory_limit, ErrorCode::cancelled},
             .example = R"(local grid = lissom.shapes.grid()
local d = grid:distances{ from = 1, method = "edges" }
assert(d[1] == 0 and #d == #grid))"}};
}

}  // namespace lissom::lua
