// lissom.Mesh: nearest points, rays and distances.
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/mesh/buffer.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/mesh/sources.h"
#include "kernel/mesh/measure/distortion.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/mesh/query/front_distances.h"

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

// The choices of the option `method`, in their order.
enum class DistanceMethod { heat, front, edges };

constexpr double kFar = std::numeric_limits<double>::infinity();

std::vector<double> from_vertices(const Call& call, MeshObject& mesh,
                                  std::span<const Index> sources) {
    switch (DistanceMethod(call.integer("method"))) {
        case DistanceMethod::heat:
            return mesh.heat(call.context()).from(sources, call.context());
        case DistanceMethod::front:
            return front_distances(mesh.mesh, sources, kFar, call.context());
        case DistanceMethod::edges:
            break;
    }
    return edge_distances(mesh.mesh, sources, kFar, call.context());
}

std::vector<double> from_point(const Call& call, MeshObject& mesh, const SurfacePoint& point) {
    switch (DistanceMethod(call.integer("method"))) {
        case DistanceMethod::heat:
            return mesh.heat(call.context()).from_point(point, call.context());
        case DistanceMethod::front:
            return front_distances(mesh.mesh, point, kFar, call.context());
        case DistanceMethod::edges:
            break;
    }
    return edge_distances(mesh.mesh, point, kFar, call.context());
}

int distances(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const SourceSpec sources = read_sources(call, "from");
    const auto result = call.create<BufferObject>();
    const bool done = call.attempt([&] {
        auto buffer = std::make_shared<BufferObject>();
        buffer->values = sources.is_point
                             ? from_point(call, *mesh, sources.nearest(*mesh, call.context()))
                             : from_vertices(call, *mesh, sources.vertices);
        result.set(std::move(buffer));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

// ---- mesh:distortion

// A field that is a buffer with one number a vertex.
struct DistortionField {
    const char* name;
    std::vector<double> Distortion::*values;
};

constexpr DistortionField kDistortionFields[] = {{"stretch", &Distortion::stretch},
                                                 {"area", &Distortion::area},
                                                 {"angle", &Distortion::angle},
                                                 {"flips", &Distortion::flips}};

int mesh_distortion(Call& call) {
    const auto mesh = call.self<MeshObject>(), rest = call.object<MeshObject>("rest");
    lua_State* L = call.lua();
    lua_createtable(L, 0, 5);
    const int table = lua_gettop(L);
    const Ref<BufferObject> buffers[] = {call.create<BufferObject>(), call.create<BufferObject>(),
                                         call.create<BufferObject>(), call.create<BufferObject>()};
    auto& flipped = call.hold<std::vector<Index>>();
    const bool done = call.attempt([&] {
        Distortion found = distortion(mesh->mesh, rest->mesh, call.context());
        for (double& angle : found.angle) angle *= 180.0 / kPi;
        for (int i = 0; i < 4; ++i) {
            auto buffer = std::make_shared<BufferObject>();
            buffer->values = std::move(found.*kDistortionFields[i].values);
            buffers[i].set(std::move(buffer));
        }
        flipped = std::move(found.flipped);
    });
    if (!done) return call.fail();
    for (int i = 0; i < 4; ++i) {
        call.charge(buffers[i]);
        lua_pushvalue(L, table + 1 + i);
        lua_setfield(L, table, kDistortionFields[i].name);
    }
    lua_pushvalue(L, table);
    call.set_field("flipped", call.push_ids(flipped));
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
             .arguments = {vector("origin", "Start of the ray."),
                           vector("direction", "Direction of the ray; any length.")},
             .results = {{"lissom.SurfacePoint?", "hit", "The point; nil if the ray misses."}},
             .errors = {ErrorCode::mesh_empty, ErrorCode::invalid_argument, ErrorCode::cancelled},
             .example = R"(local hit = lissom.shapes.box():pick({ 0.1, 0.2, 5 }, { 0, 0, -1 })
assert(math.abs(hit.position[3] - 0.5) < 1e-12))"},
            {.name = "distances",
             .body = distances,
             .summary =
                 "Distance of every vertex over the surface to the nearest of the given vertices, "
                 "or to a point; infinite for vertices without a path.",
             .options = {source_option(),
                         choice("method", {"heat", "front", "edges"},
                                "Geodesic by the heat method, which prepares a mesh once and is "
                                "fast from then on; geodesic by an advancing front, which needs "
                                "no preparation; or along edges.")
                             .defaults("heat")},
             .results = {{"lissom.Buffer", "distances", "One number a vertex."}},
             .errors = {ErrorCode::out_of_range, ErrorCode::invalid_argument, ErrorCode::mesh_empty,
                        ErrorCode::memory_limit, ErrorCode::cancelled},
             .example = R"(local grid = lissom.shapes.grid()
local d = grid:distances{ from = 1, method = "edges" }
assert(d[1] == 0 and #d == #grid))"},
            {.name = "distortion",
             .body = mesh_distortion,
             .summary = "Stretch, shear and folds of this mesh, compared with another shape "
                        "of it, as numbers of the vertices that lissom.render draws in colours: "
                        "lissom.render{ mesh = mesh, scalars = mesh:distortion(rest).area, ... }.",
             .arguments = {object("rest", "lissom.Mesh",
                                  "A mesh with the same faces, such as a copy from before.")},
             .results = {{"lissom.Distortion", "found", "Numbers of the vertices."}},
             .errors = {ErrorCode::topology_mismatch, ErrorCode::cancelled},
             .example = R"(local bar = lissom.shapes.bar{ across = 2, along = 10 }
local rest = bar:copy()
bar:transform{ scale = { 1, 2, 1 } }
local found = bar:distortion(rest)
assert(math.abs(found.stretch[1] - 2) < 1e-12 and #found.flipped == 0))"}};
}

}  // namespace lissom::lua
