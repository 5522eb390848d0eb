// The calls from C++ to the host of tools agree with its Lua text.
#include "bindings/lua/tools/tool_calls.h"

#include <set>
#include <string>

#include "bindings/lua/tools/tools.h"
#include "tests/unit/bindings/lua_state.h"

namespace lissom::lua {
namespace {

using test::LuaState;

// Number of parameters of the function on top of the stack, and whether more are taken; pops it.
struct Parameters {
    int count = 0;
    bool more = false;
};

Parameters parameters_of(lua_State* L) {
    lua_Debug info;
    lua_getinfo(L, ">u", &info);
    return {info.nparams, info.isvararg != 0};
}

TEST_CASE("calls of tools are described in the order of their enumerators") {
    for (std::size_t i = 0; i < tool_calls().size(); ++i) {
        CHECK(static_cast<std::size_t>(tool_calls()[i].call) == i);
    }
    CHECK(tool_calls().size() == static_cast<std::size_t>(ToolCall::journal_text) + 1);
}

TEST_CASE("each call of tools is a function of the Lua text with the arguments described") {
    LuaState lua;
    for (const ToolCallRow& row : tool_calls()) {
        INFO(row.name);
        push_tool_call(lua.get(), row.call);
        REQUIRE(lua_type(lua.get(), -1) == LUA_TFUNCTION);
        const bool more = !row.arguments.empty() && row.arguments.back() == "...";
        const Parameters taken = parameters_of(lua.get());
        CHECK(taken.more == more);
        CHECK(taken.count == static_cast<int>(row.arguments.size()) - (more ? 1 : 0));
        CHECK((!row.is_method || row.arguments.front() == "host"));
    }
    CHECK(lua_gettop(lua.get()) == 0);
}

TEST_CASE("the Lua text offers no function that is not described") {
    LuaState lua;
    std::set<std::string> known{"methods"};
    for (const ToolCallRow& row : tool_calls()) {
        if (!row.is_method) known.insert(row.name);
    }
    push_tool_functions(lua.get());
    for (lua_pushnil(lua.get()); lua_next(lua.get(), -2) != 0; lua_pop(lua.get(), 1)) {
        INFO(lua_tostring(lua.get(), -2));
        CHECK(known.count(lua_tostring(lua.get(), -2)) == 1);
    }
}

}  // namespace
}  // namespace lissom::lua
