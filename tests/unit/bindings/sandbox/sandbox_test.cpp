#include "bindings/lua/sandbox/sandbox.h"

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "kernel/core/error.h"

namespace lissom::lua {
namespace {

int run_text(Sandbox& sandbox, const std::string& text) {
    lua_State* L = sandbox.lua();
    lua_settop(L, 0);
    REQUIRE(luaL_loadbufferx(L, text.data(), text.size(), "=script", "t") == LUA_OK);
    return sandbox.call(0, 1);
}

TEST_CASE("sandbox: a script that does no harm runs as elsewhere") {
    std::string printed;
    Sandbox sandbox({}, {}, [&](std::string_view text) { printed += text; });
    CHECK(run_text(sandbox,
                   "local lissom = require 'lissom' local m = lissom.shapes.cactus() "
                   "assert(m:smooth{ iterations = 2 }) print('vertices', m:vertex_count() > 100) "
                   "return table.concat({ ('a,b'):match('(%w),(%w)') }, '+')") == LUA_OK);
    CHECK(std::string(lua_tostring(sandbox.lua(), -1)) == "a+b");
    CHECK(printed == "vertices\ttrue\n");
    CHECK(sandbox.end() == SandboxEnd::none);
}

TEST_CASE("sandbox: instructions are counted, of each run") {
    SandboxLimits limits;
    limits.instructions = 100'000;
    Sandbox sandbox(limits, {});
    for (int i = 0; i < 3; ++i) {
        CHECK(run_text(sandbox, "for i = 1, 10000 do end return true") == LUA_OK);
        CHECK(run_text(sandbox, "while true do end") != LUA_OK);
        CHECK(sandbox.end() == SandboxEnd::instructions);
        CHECK(run_text(sandbox, "coroutine.wrap(function() while true do end end)()") != LUA_OK);
        CHECK(sandbox.end() == SandboxEnd::instructions);
    }
}

TEST_CASE("sandbox: memory is Lua's and the kernel's together") {
    SandboxLimits limits;
    limits.memory_bytes = std::size_t{64} << 20;
    Sandbox sandbox(limits, {});
    CHECK(sandbox.memory()->limit() == limits.memory_bytes);
    CHECK(run_text(sandbox, "kept = ('x'):rep(20 * 2^20) return true") == LUA_OK);
    CHECK(sandbox.memory()->used() > std::size_t{20} << 20);
    CHECK(run_text(sandbox,
                   "local lissom = require 'lissom' "
                   "local bar = lissom.shapes.bar{ across = 40, along = 400 } "
                   "local edit = lissom.deform(bar) edit:handle(bar:region('bottom')) "
                   "edit:handle(bar:region('top')):rotate{ axis = 'y', angle = 90 } "
                   "return select(3, edit:solve())") == LUA_OK);
    CHECK(std::string(lua_tostring(sandbox.lua(), -1)) == "memory_limit");
}

TEST_CASE("sandbox: the host cancels from another thread") {
    SandboxLimits limits;
    limits.seconds = 0.0;
    Sandbox sandbox(limits, {});
    const Context context = sandbox.state().context;
    std::thread host([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        context.cancel();
    });
    CHECK(run_text(sandbox, "while true do pcall(function() while true do end end) end") != LUA_OK);
    host.join();
    CHECK(sandbox.end() == SandboxEnd::cancelled);
    context.clear_cancel();
    CHECK(run_text(sandbox, "return true") == LUA_OK);
}

TEST_CASE("sandbox: limits that cannot be") {
    SandboxLimits below;
    below.seconds = -1.0;
    CHECK_THROWS_AS(Sandbox(below, {}), Error);
    SandboxLimits tight;
    tight.memory_bytes = 10'000;
    CHECK_THROWS_AS(Sandbox(tight, {}), Error);
}

TEST_CASE("sandbox: several at once, each with limits of its own") {
    std::vector<std::thread> hosts;
    std::array<SandboxEnd, 4> ends{};
    for (std::size_t i = 0; i < ends.size(); ++i) {
        hosts.emplace_back([&ends, i] {
            SandboxLimits limits;
            limits.seconds = 0.1 * static_cast<double>(i % 2) + 0.05;
            Sandbox sandbox(limits, {});
            lua_State* L = sandbox.lua();
            if (luaL_loadstring(L, "while true do end") == LUA_OK) sandbox.call(0, 0);
            ends[i] = sandbox.end();
        });
    }
    for (std::thread& host : hosts) host.join();
    for (const SandboxEnd end : ends) CHECK(end == SandboxEnd::seconds);
}

}  // namespace
}  // namespace lissom::lua
