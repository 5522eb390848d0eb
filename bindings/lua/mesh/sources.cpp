#include "bindings/lua/mesh/sources.h"

#include <cmath>
#include <limits>

namespace lissom::lua {
namespace {

constexpr const char* kExpectedSource =
    "a vertex, a region, a list of vertices, a point {x, y, z}, { point = {x, y, z} } or "
    "{ vertices = {...} } expected";

bool is_vertex_number(double value) {
    return value >= 1.0 && value <= std::numeric_limits<Index>::max() && value == std::floor(value);
}

// The numbers of the list at stack index `list`.
std::span<const double> read_numbers(const Call& call, const char* path, int list) {
    lua_State* L = call.lua();
    if (lua_type(L, list) != LUA_TTABLE) call.reject(path, kExpectedSource);
    const std::size_t count = raw_length(L, list);
    double* values = call.scratch<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
        lua_rawgeti(L, list, index_of(i) + 1);
        if (lua_type(L, -1) != LUA_TNUMBER) call.reject(path, kExpectedSource);
        values[i] = lua_tonumber(L, -1);
        lua_pop(L, 1);
    }
    return {values, count};
}

SourceSpec point_source(const Call& call, const char* path, std::span<const double> xyz) {
    SourceSpec source{{}, true, {}};
    if (xyz.size() != 3) call.reject(path, kExpectedSource);
    for (int k = 0; k < 3; ++k) {
        source.xyz[k] = xyz[k];
        if (!std::isfinite(source.xyz[k])) call.reject(path, "the point is NaN or infinite");
    }
    return source;
}

SourceSpec vertex_sources(const Call& call, const char* path, std::span<const double> numbers) {
    Index* ids = call.scratch<Index>(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (!is_vertex_number(numbers[i])) call.reject(path, kExpectedSource);
        ids[i] = static_cast<Index>(numbers[i]) - 1;
    }
    return {{ids, numbers.size()}, false, {}};
}

// Pushes field `name` of the table, which stays; false and nothing if there is none.
bool push_table_field(lua_State* L, int table, const char* name) {
    lua_pushstring(L, name);
    lua_rawget(L, table);
    if (!lua_isnil(L, -1)) return true;
    lua_pop(L, 1);
    return false;
}

SourceSpec table_source(const Call& call, const char* path) {
    lua_State* L = call.lua();
    const int table = call.stack_index(path);
    luaL_checkstack(L, LUA_MINSTACK, "too many values");
    // Mesh:nearest and Mesh:pick give a position.
    for (const char* name : {"point", "position"}) {
        if (push_table_field(L, table, name)) {
            return point_source(call, path, read_numbers(call, path, lua_gettop(L)));
        }
    }
    if (push_table_field(L, table, "vertices")) {
        return vertex_sources(call, path, read_numbers(call, path, lua_gettop(L)));
    }
    const std::span<const double> numbers = read_numbers(call, path, table);
    const bool three = numbers.size() == 3;
    bool all_vertices = true;
    for (const double number : numbers) all_vertices = all_vertices && is_vertex_number(number);
    if (three && all_vertices) {
        call.reject(path,
                    "three whole numbers may be a point or vertices; write { point = {x, y, z} } "
                    "or { vertices = {a, b, c} }");
    }
    return three ? point_source(call, path, numbers) : vertex_sources(call, path, numbers);
}

}  // namespace

SurfacePoint SourceSpec::nearest(MeshObject& mesh, const Context& context) const {
    return mesh.tree(context).nearest({xyz[0], xyz[1], xyz[2]});
}

Parameter source_option() {
    return either("from",
                  {id("vertex", "One vertex."),
                   object("region", "lissom.Region", "The vertices of a region."),
                   table("table", "A point or a list of vertices.")},
                  "Start of distances: a vertex, a region, a list of vertices, or a point {x, "
                  "y, z}, of which the nearest on the surface counts, also a result of "
                  "Mesh:nearest and Mesh:pick. Three whole numbers above 0 may be vertices or a "
                  "point: write { vertices = {a, b, c} } or { point = {x, y, z} }.");
}

SourceSpec read_sources(Call& call, const char* path) {
    switch (call.kind(path)) {
        case Kind::id: {
            Index* vertex = call.scratch<Index>(1);
            *vertex = call.id(path);
            return {{vertex, 1}, false, {}};
        }
        case Kind::object: {
            const auto region = call.object<RegionObject>(path);
            if (!call.attempt_quick([&] { region->current(); })) call.fail();
            return {region->region.vertices(), false, {}};
        }
        default:
            return table_source(call, path);
    }
}

}  // namespace lissom::lua
