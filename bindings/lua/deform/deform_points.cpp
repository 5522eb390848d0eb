#include "bindings/lua/deform/deform_points.h"

#include <cmath>
#include <limits>

#include "kernel/core/error.h"

namespace lissom::lua {
namespace {

constexpr const char* kExpected =
    "list of points expected: {vertex=}, {edge={a, b}, at=}, {face=, bary=}, or results of "
    "nearest and pick";

// The id on top of the stack.
Index top_id(const Call& call, const char* path) {
    lua_State* L = call.lua();
    const double id = lua_type(L, -1) == LUA_TNUMBER ? lua_tonumber(L, -1) : 0.0;
    const bool valid = id >= 1.0 && id <= std::numeric_limits<Index>::max() && id == std::floor(id);
    if (!valid) call.reject(path, "ids of points are integers from 1");
    return static_cast<Index>(id) - 1;
}

// Pushes field `name` of the table on top; pops it again if it is absent.
bool push_field(lua_State* L, const char* name) {
    lua_getfield(L, -1, name);
    if (!lua_isnil(L, -1)) return true;
    lua_pop(L, 1);
    return false;
}

// Elements of the list on top of the stack.
template <typename T, typename Read>
std::span<const T> top_list(const Call& call, const char* path, const Read& read) {
    lua_State* L = call.lua();
    if (lua_type(L, -1) != LUA_TTABLE) call.reject(path, kExpected);
    const std::size_t count = raw_length(L, -1);
    const int list = lua_gettop(L);
    T* values = call.scratch<T>(count);
    for (std::size_t i = 0; i < count; ++i) {
        lua_rawgeti(L, list, index_of(i) + 1);
        values[i] = read();
        lua_pop(L, 1);
    }
    return {values, count};
}

double top_number(const Call& call, const char* path) {
    if (lua_type(call.lua(), -1) != LUA_TNUMBER) call.reject(path, "weights are numbers");
    return lua_tonumber(call.lua(), -1);
}

PointSpec vertex_spec(const Call& call, Index v) {
    Index* vertex = call.scratch<Index>(1);
    double* weight = call.scratch<double>(1);
    *vertex = v;
    *weight = 1.0;
    return {kNoIndex, {vertex, 1}, {weight, 1}};
}

PointSpec edge_spec(const Call& call, std::span<const Index> edge, double at) {
    double* weights = call.scratch<double>(2);
    weights[0] = 1.0 - at;
    weights[1] = at;
    return {kNoIndex, edge, {weights, 2}};
}

// The point of the table at stack index `table`. Pushed values stay until the call ends.
PointSpec read_point(const Call& call, const char* path, int table) {
    lua_State* L = call.lua();
    luaL_checkstack(L, 16, "too many points");
    lua_pushvalue(L, table);
    const auto ids = [&] {
        return top_list<Index>(call, path, [&] { return top_id(call, path); });
    };
    const auto pushed_again = [&](const char* name) {
        lua_pushvalue(L, table);
        return push_field(L, name);
    };
    if (push_field(L, "bary")) {
        const auto weights = top_list<double>(call, path, [&] { return top_number(call, path); });
        if (pushed_again("triangle")) return {kNoIndex, ids(), weights};
        if (!pushed_again("face")) call.reject(path, kExpected);
        return {top_id(call, path), {}, weights};
    }
    if (push_field(L, "edge")) {
        const auto edge = ids();
        if (edge.size() != 2) call.reject(path, "edge: two vertices expected");
        return edge_spec(call, edge, pushed_again("at") ? top_number(call, path) : 0.5);
    }
    if (!push_field(L, "vertex")) call.reject(path, kExpected);
    return vertex_spec(call, top_id(call, path));
}

}  // namespace

MeshPoint PointSpec::point(const Topology& topology) const {
    if (face != kNoIndex) return face_point(topology, face, weights);
    if (vertices.size() != weights.size()) {
        throw Error(ErrorCode::invalid_argument, "a point needs one weight a vertex");
    }
    return {{vertices.begin(), vertices.end()}, {weights.begin(), weights.end()}};
}

std::span<const PointSpec> read_points(const Call& call, const char* path) {
    lua_State* L = call.lua();
    const int list = call.stack_index(path);
    const std::size_t count = raw_length(L, list);
    if (count == 0) call.reject(path, kExpected);
    PointSpec* points = call.scratch<PointSpec>(count);
    for (std::size_t i = 0; i < count; ++i) {
        luaL_checkstack(L, 16, "too many points");
        lua_rawgeti(L, list, index_of(i) + 1);
        if (lua_type(L, -1) != LUA_TTABLE) call.reject(path, kExpected);
        points[i] = read_point(call, path, lua_gettop(L));
    }
    return {points, count};
}

std::vector<Parameter> point_fields() {
    return {id("vertex", "A vertex.").optional(),
            ids("edge", "The two vertices of an edge.").optional(),
            number("at", "Place on the edge: 0 is its first vertex, 1 its second.")
                .between(0, 1)
                .defaults(0.5),
            id("face", "A face.").optional(),
            numbers("bary", "Weights of the face's corners, which sum to 1.").optional(),
            ids("triangle",
                "Three vertices of the face that bary weighs instead, as nearest and pick give.")
                .optional()};
}

PointSpec read_point_options(const Call& call) {
    const bool in_face = call.has("face") || call.has("triangle");
    const int given = int{call.has("vertex")} + int{call.has("edge")} + int{in_face};
    if (given != 1) call.raise("give one of vertex, edge and face");
    if (in_face != call.has("bary")) call.raise("give face and bary together");
    if (call.has("vertex")) return vertex_spec(call, call.id("vertex"));
    if (call.has("triangle")) return {kNoIndex, call.ids("triangle"), call.numbers("bary")};
    if (call.has("face")) return {call.id("face"), {}, call.numbers("bary")};
    const auto edge = call.ids("edge");
    if (edge.size() != 2) call.reject("edge", "two vertices expected");
    return edge_spec(call, edge, call.number("at"));
}

}  // namespace lissom::lua
