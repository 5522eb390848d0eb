// Functions of tables that end when the script has to.
#include "bindings/lua/sandbox/sandbox_state.h"

namespace lissom::lua {
namespace {

// Elements that one call may pass over; of a table that looks for them in a chain of others, which
// takes no step of Lua's for each of up to 2,000.
constexpr lua_Integer kMaxElements = 10'000'000, kMaxInChain = 10'000;

// Calls Lua's function, upvalue 1.
int call_lua(lua_State* L) {
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
    return lua_gettop(L);
}

// Returns whether a metamethod of the value at `index` is a table with a metatable.
bool leads_on(lua_State* L, int index, const char* metamethod) {
    if (luaL_getmetafield(L, index, metamethod) == LUA_TNIL) return false;
    const bool leads = lua_istable(L, -1) && lua_getmetatable(L, -1);
    lua_pop(L, leads ? 2 : 1);
    return leads;
}

lua_Integer max_elements(lua_State* L, int index) {
    const bool chain = leads_on(L, index, "__index") || leads_on(L, index, "__newindex");
    return chain ? kMaxInChain : kMaxElements;
}

// Counts the range first..last of the table at `index`.
void require_range(lua_State* L, int index, lua_Integer first, lua_Integer last) {
    if (last < first) return;
    const auto count = static_cast<lua_Unsigned>(last) - static_cast<lua_Unsigned>(first);
    if (count >= static_cast<lua_Unsigned>(max_elements(L, index))) {
        luaL_error(L, "too many elements for one call in a sandbox");
    }
    charge(L, count);
}

// The length that Lua's function asks for again must be the same.
lua_Integer own_length(lua_State* L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    if (luaL_getmetafield(L, 1, "__len") != LUA_TNIL) {
        luaL_error(L, "a table with __len is not for this function in a sandbox");
    }
    return static_cast<lua_Integer>(raw_length(L, 1));
}

// table.insert and table.remove move the elements behind the position, if one is given.
int insert_or_remove(lua_State* L, int position) {
    const lua_Integer length = own_length(L);
    const bool moves = lua_gettop(L) >= position && lua_isinteger(L, 2);
    const lua_Integer from = moves ? lua_tointeger(L, 2) : length;
    require_range(L, 1, from < 1 ? 1 : from, length);
    return call_lua(L);
}

int insert(lua_State* L) {
    return insert_or_remove(L, 3);
}

int remove(lua_State* L) {
    return insert_or_remove(L, 2);
}

// Compares as table.sort does by itself, within the limits: strings may be long.
int is_less(lua_State* L) {
    charge(L, 1);
    if (lua_type(L, 1) == LUA_TSTRING && lua_type(L, 2) == LUA_TSTRING) {
        const std::size_t a = raw_length(L, 1), b = raw_length(L, 2);
        charge_bytes(L, a < b ? a : b);
    }
    lua_pushboolean(L, lua_compare(L, 1, 2, LUA_OPLT));
    return 1;
}

int sort(lua_State* L) {
    require_range(L, 1, 1, own_length(L));
    if (lua_isnoneornil(L, 2)) {
        lua_settop(L, 1);
        lua_pushcfunction(L, is_less);
    }
    return call_lua(L);
}

int concatenate(lua_State* L) {
    // Nothing else has elements; strings are no lists.
    if (!lua_istable(L, 1) && !lua_isuserdata(L, 1)) return call_lua(L);
    lua_settop(L, 4);
    luaL_optstring(L, 2, "");
    const lua_Integer first = luaL_optinteger(L, 3, 1);
    const lua_Integer last = lua_isnoneornil(L, 4) ? luaL_len(L, 1) : luaL_checkinteger(L, 4);
    require_range(L, 1, first, last);
    lua_pushinteger(L, first);
    lua_replace(L, 3);
    lua_pushinteger(L, last);
    lua_replace(L, 4);
    return call_lua(L);
}

int unpack(lua_State* L) {
    const lua_Integer first = luaL_optinteger(L, 2, 1);
    const lua_Integer last = lua_isnoneornil(L, 3) ? luaL_len(L, 1) : luaL_checkinteger(L, 3);
    require_range(L, 1, first, last);
    lua_settop(L, 1);
    lua_pushinteger(L, first);
    lua_pushinteger(L, last);
    return call_lua(L);
}

int move(lua_State* L) {
    const lua_Integer first = luaL_checkinteger(L, 2), last = luaL_checkinteger(L, 3);
    luaL_checkinteger(L, 4);
    require_range(L, 1, first, last);
    if (!lua_isnoneornil(L, 5)) require_range(L, 5, first, last);
    return call_lua(L);
}

}  // namespace

void make_tables_safe(lua_State* L) {
    const luaL_Reg functions[] = {{"concat", concatenate}, {"insert", insert}, {"move", move},
                                  {"remove", remove},      {"sort", sort},     {"unpack", unpack}};
    lua_getglobal(L, LUA_TABLIBNAME);
    for (const luaL_Reg& function : functions) {
        lua_getfield(L, -1, function.name);
        lua_pushcclosure(L, function.func, 1);
        lua_setfield(L, -2, function.name);
    }
    lua_pop(L, 1);
}

}  // namespace lissom::lua
