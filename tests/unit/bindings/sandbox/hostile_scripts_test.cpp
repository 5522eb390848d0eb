#include "tests/unit/bindings/sandbox/hostile_scripts.h"

#include <doctest/doctest.h>

#include "bindings/lua/core/error_object.h"
#include "bindings/lua/sandbox/sandbox.h"

namespace lissom::lua {
namespace {

using test::HostileEnd;
using test::HostileScript;

constexpr std::size_t kMemory = std::size_t{48} << 20;

// Short for those that it has to end; the others come to their own end, on any machine.
SandboxLimits limits_for(const HostileScript& script) {
    SandboxLimits limits;
    const bool is_ended = script.end == HostileEnd::time || script.end == HostileEnd::any;
    limits.seconds = is_ended ? 0.2 : 100.0;
    limits.memory_bytes = kMemory;
    limits.output_bytes = 100'000;
    return limits;
}

int run(Sandbox& sandbox, const std::string& text) {
    lua_State* L = sandbox.lua();
    lua_settop(L, 0);
    REQUIRE(luaL_loadbufferx(L, text.data(), text.size(), "=script", "t") == LUA_OK);
    return sandbox.call(0, 1);
}

std::string message_of(lua_State* L) {
    const bool has_text = lua_isstring(L, -1) != 0 || is_error_object(L, -1);
    return has_text ? push_error_text(L, -1) : "";
}

void check_end(Sandbox& sandbox, const HostileScript& script, int status) {
    const int top = lua_gettop(sandbox.lua());
    const std::string message = message_of(sandbox.lua());
    lua_settop(sandbox.lua(), top);
    INFO("ended with ", status, ": ", message);
    switch (script.end) {
        case HostileEnd::time:
            CHECK(status != LUA_OK);
            CHECK(sandbox.end() == SandboxEnd::seconds);
            break;
        case HostileEnd::error:
            CHECK(status != LUA_OK);
            CHECK(message.find(script.message) != std::string::npos);
            break;
        case HostileEnd::harmless:
            CHECK(status == LUA_OK);
            CHECK(lua_toboolean(sandbox.lua(), -1));
            break;
        case HostileEnd::any:
            break;
    }
}

TEST_CASE("sandbox: hostile scripts end, and leave a state that is of use") {
    const auto scripts = test::hostile_scripts();
    CHECK(scripts.size() >= 100);
    for (const HostileScript& script : scripts) {
        CAPTURE(script.name);
        Sandbox sandbox(limits_for(script), {});
        check_end(sandbox, script, run(sandbox, script.text));
        CHECK(sandbox.memory()->peak() <= kMemory);
        lua_settop(sandbox.lua(), 0);
        lua_gc(sandbox.lua(), LUA_GCCOLLECT);
        CHECK(run(sandbox, "local t = {} for i = 1, 1000 do t[i] = i end return #t") == LUA_OK);
        CHECK(lua_tointeger(sandbox.lua(), -1) == 1000);
    }
}

TEST_CASE("sandbox: whatever a script has taken is given back when it is closed") {
    for (const HostileScript& script : test::hostile_scripts()) {
        if (script.end == HostileEnd::time) continue;
        CAPTURE(script.name);
        std::shared_ptr<MemoryAccount> memory;
        {
            Sandbox sandbox(limits_for(script), {});
            memory = sandbox.memory();
            run(sandbox, script.text);
        }
        CHECK(memory->used() == 0);
    }
}

}  // namespace
}  // namespace lissom::lua
