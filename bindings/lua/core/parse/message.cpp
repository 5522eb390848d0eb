#include "bindings/lua/core/parse/message.h"

#include <cstring>

#include "bindings/lua/core/call.h"

namespace lissom::lua {

std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
        text += words[i];
    }
    return text;
}

const char* push_description(lua_State* L, int index, const char* expected_type) {
    const int type = lua_type(L, index);
    if (type == LUA_TNUMBER) {
        char text[32];
        std::snprintf(text, sizeof text, "%.14g", lua_tonumber(L, index));
        lua_pushstring(L, text);
        return lua_tostring(L, -1);
    }
    if (type == LUA_TSTRING) return lua_pushfstring(L, "\"%s\"", lua_tostring(L, index));
    if (const Holder* holder = find_holder(L, index, nullptr)) {
        const bool is_expected = std::strcmp(holder->type_name, expected_type) == 0;
        return is_expected ? lua_pushfstring(L, "a closed %s", expected_type) : holder->type_name;
    }
    if (type != LUA_TUSERDATA || !luaL_getmetafield(L, index, "__name")) {
        return type == LUA_TNONE ? "no value" : lua_typename(L, type);
    }
    const char* name = lua_tostring(L, -1);
    // A name that was set on a foreign object is no name of it.
    const bool is_own = name && std::strcmp(name, expected_type) != 0;
    return is_own ? name : lua_typename(L, type);
}

}  // namespace lissom::lua
