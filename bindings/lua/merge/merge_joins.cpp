// The joins of lissom.merge as scripts write them.
#include <cmath>
#include <cstring>
#include <limits>

#include "bindings/lua/core/failure.h"
#include "bindings/lua/merge/merge_object.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/core/nearest.h"

namespace lissom::lua {
namespace {

constexpr const char* kJoins =
    "list of joins expected: { source = boundary, target = boundary, keys = { { s, t }, ... } }";
constexpr const char* kKeys =
    "keys are pairs { s, t } of vertices or points { x, y, z }: the source's, then the target's";

// The key on top of the stack.
KeySpec top_key(const Call& call, const char* path) {
    lua_State* L = call.lua();
    KeySpec key{kNoIndex, {0.0, 0.0, 0.0}};
    if (lua_type(L, -1) == LUA_TNUMBER) {
        const double id = lua_tonumber(L, -1);
        if (!(id >= 1.0 && id <= std::numeric_limits<Index>::max() && id == std::floor(id))) {
            call.reject(path, kKeys);
        }
        key.vertex = static_cast<Index>(id) - 1;
        return key;
    }
    if (lua_type(L, -1) != LUA_TTABLE || raw_length(L, -1) != 3) call.reject(path, kKeys);
    for (int k = 0; k < 3; ++k) {
        lua_rawgeti(L, -1, k + 1);
        if (lua_type(L, -1) != LUA_TNUMBER) call.reject(path, kKeys);
        key.point[k] = lua_tonumber(L, -1);
        if (!std::isfinite(key.point[k])) call.reject(path, kKeys);
        lua_pop(L, 1);
    }
    return key;
}

// The list of pairs on top of the stack.
std::pair<const KeySpec*, std::size_t> top_keys(const Call& call, const char* path) {
    lua_State* L = call.lua();
    if (lua_type(L, -1) != LUA_TTABLE) call.reject(path, kKeys);
    const int list = lua_gettop(L);
    const std::size_t count = raw_length(L, list);
    KeySpec* keys = call.scratch<KeySpec>(2 * count + 1);
    for (std::size_t i = 0; i < count; ++i) {
        lua_rawgeti(L, list, index_of(i) + 1);
        if (lua_type(L, -1) != LUA_TTABLE || raw_length(L, -1) != 2) call.reject(path, kKeys);
        for (int side = 0; side < 2; ++side) {
            lua_rawgeti(L, -1, side + 1);
            keys[2 * i + side] = top_key(call, path);
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
    }
    return {keys, count};
}

constexpr const char* kBoundary =
    "a boundary, lissom.Path, expected in '%s', got %s; write %s:boundaries()[1]";

// The boundary under `name` in the table at `table`.
Holder* boundary_field(const Call& call, const char* path, int table, const char* name) {
    lua_State* L = call.lua();
    lua_getfield(L, table, name);
    Holder* holder = find_holder(L, -1, PathObject::kTypeName);
    if (holder && holder->object) return holder;
    if (lua_isnil(L, -1)) call.reject(path, kJoins);
    const Holder* other = find_holder(L, -1, nullptr);
    const bool is_mesh = other && std::strcmp(other->type_name, MeshObject::kTypeName) == 0;
    const char* got = other ? other->type_name : luaL_typename(L, -1);
    call.reject(path, lua_pushfstring(L, kBoundary, name, got, is_mesh ? name : "mesh"));
}

// Pushes the fault of a field of a join, with no C++ object alive afterwards.
const char* push_wrong_field(lua_State* L, const char* field) {
    Failure failure;
    const bool composed = failure.guard([&] {
        const std::string text =
            "a join has no field '" + std::string(field) + "'" +
            name_hint(field, std::vector<std::string_view>{"source", "target", "keys"});
        lua_pushlstring(L, text.data(), text.size());
    });
    if (!composed) lua_pushstring(L, failure.message);
    return lua_tostring(L, -1);
}

void check_fields(const Call& call, const char* path, int table) {
    lua_State* L = call.lua();
    for (lua_pushnil(L); lua_next(L, table) != 0; lua_pop(L, 1)) {
        if (lua_type(L, -2) != LUA_TSTRING) call.reject(path, kJoins);
        const char* name = lua_tostring(L, -2);
        const bool known = std::strcmp(name, "source") == 0 || std::strcmp(name, "target") == 0 ||
                           std::strcmp(name, "keys") == 0;
        if (!known) call.reject(path, push_wrong_field(L, name));
    }
}

JoinSpec top_join(const Call& call, const char* path) {
    lua_State* L = call.lua();
    if (lua_type(L, -1) != LUA_TTABLE) call.reject(path, kJoins);
    const int table = lua_gettop(L);
    luaL_checkstack(L, 16, "too many joins");
    check_fields(call, path, table);
    JoinSpec join{boundary_field(call, path, table, "source"),
                  boundary_field(call, path, table, "target"), nullptr, 0};
    lua_getfield(L, table, "keys");
    if (!lua_isnil(L, -1)) {
        const auto [keys, count] = top_keys(call, path);
        join.keys = keys;
        join.key_count = count;
    }
    return join;
}

}  // namespace

Key KeySpec::key() const {
    if (vertex != kNoIndex) return vertex;
    return Vec3(point[0], point[1], point[2]);
}

std::vector<KeyPair> JoinSpec::key_pairs() const {
    std::vector<KeyPair> pairs;
    for (std::size_t k = 0; k < key_count; ++k) {
        pairs.push_back({keys[2 * k].key(), keys[2 * k + 1].key()});
    }
    return pairs;
}

// Pushed values stay until the call ends: boundaries must stay alive.
std::span<const JoinSpec> read_joins(const Call& call, const char* path) {
    lua_State* L = call.lua();
    const int list = call.stack_index(path);
    const std::size_t count = raw_length(L, list);
    if (count == 0) call.reject(path, kJoins);
    JoinSpec* joins = call.scratch<JoinSpec>(count);
    for (std::size_t i = 0; i < count; ++i) {
        luaL_checkstack(L, 16, "too many joins");
        lua_rawgeti(L, list, index_of(i) + 1);
        joins[i] = top_join(call, path);
    }
    return {joins, count};
}

JoinSpec read_keys(const Call& call, const char* path) {
    lua_pushvalue(call.lua(), call.stack_index(path));
    const auto [keys, count] = top_keys(call, path);
    return {nullptr, nullptr, keys, count};
}

}  // namespace lissom::lua
