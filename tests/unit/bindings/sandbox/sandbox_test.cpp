#include "bindings/lua/sandbox/sandbox.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "bindings/lua/core/error_object.h"
#include "kernel/core/error.h"

namespace lissom::lua {
namespace {

// Time enough on a machine that is slow, with sanitizers, and does other work.
SandboxLimits patient() {
    SandboxLimits limits;
    limits.seconds = 1000.0;
    return limits;
}

int run_text(Sandbox& sandbox, const std::string& text) {
    lua_State* L = sandbox.lua();
    lua_settop(L, 0);
    REQUIRE(luaL_loadbufferx(L, text.data(), text.size(), "=script", "t") == LUA_OK);
    return sandbox.call(0, 1);
}

TEST_CASE("sandbox: a script that does no harm runs as elsewhere") {
    std::string printed;
    Sandbox sandbox(patient(), {}, [&](std::string_view text) { printed += text; });
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

TEST_CASE("sandbox: a script whose coroutine a limit has ended fails, also if it ends at once") {
    SandboxLimits limits = patient();
    limits.instructions = 100'000;
    limits.output_bytes = 1000;
    Sandbox sandbox(limits, {});
    const auto check = [&](const char* text, SandboxEnd end, const char* message) {
        CAPTURE(text);
        CHECK(run_text(sandbox, text) == LUA_ERRRUN);
        CHECK(sandbox.end() == end);
        CHECK(std::string(lua_tostring(sandbox.lua(), -1)).find(message) != std::string::npos);
    };
    const char* const too_long = "as many instructions as it may";
    check(
        "local co = coroutine.create(function() local x <close> = setmetatable({}, { __close = "
        "function() while true do end end }) coroutine.yield() end) coroutine.resume(co) "
        "coroutine.close(co)",
        SandboxEnd::instructions, too_long);
    check("return coroutine.resume(coroutine.create(function() while true do end end))",
          SandboxEnd::instructions, too_long);
    check("return coroutine.resume(coroutine.create(function() print(('x'):rep(2000)) end))",
          SandboxEnd::output, "written as much as it may");
    CHECK(run_text(sandbox, "return true") == LUA_OK);
}

// Bytes that the kernel has taken for objects, after all garbage was collected.
std::size_t kernel_bytes(const Sandbox& sandbox) {
    lua_State* L = sandbox.lua();
    lua_settop(L, 0);
    lua_gc(L, LUA_GCCOLLECT);
    lua_gc(L, LUA_GCCOLLECT);
    const std::size_t of_lua = (static_cast<std::size_t>(lua_gc(L, LUA_GCCOUNT)) << 10) +
                               static_cast<std::size_t>(lua_gc(L, LUA_GCCOUNTB));
    return sandbox.memory()->used() - of_lua;
}

TEST_CASE("sandbox: objects whose finalizers find no stack are freed with the state") {
    std::shared_ptr<MemoryAccount> memory;
    {
        Sandbox sandbox(patient(), {});
        memory = sandbox.memory();
        const std::size_t before = kernel_bytes(sandbox);
        // Finalizers that run at the depth of the error fail by it, which some of these depths
        // meet.
        run_text(sandbox,
                 "local l = require('lissom') local function f() l.shapes.box() l.scene() "
                 "collectgarbage(); ('x'):gsub('.', f) end "
                 "local function deep(k) if k > 0 then pcall(deep, k - 1) else f() end end "
                 "for k = 0, 12 do pcall(deep, k) end");
        INFO("the test has to get there");
        CHECK(kernel_bytes(sandbox) > before);
    }
    CHECK(memory->used() == 0);
}

TEST_CASE("sandbox: objects that are made while the memory runs out are freed") {
    SandboxLimits limits = patient();
    limits.memory_bytes = std::size_t{4} << 20;
    std::shared_ptr<MemoryAccount> memory;
    {
        Sandbox sandbox(limits, {});
        memory = sandbox.memory();
        for (int i = 0; i < 20; ++i) {
            run_text(sandbox,
                     "local l, t = require('lissom'), {} "
                     "pcall(function() while true do t[#t + 1] = ('x'):rep(1000) .. #t end end) "
                     "for i = 1, 200 do pcall(function() local s = l.scene() "
                     "s:step('s', function() s:add('a', l.shapes.box()) end) end) t[#t] = nil end");
        }
        const int status = run_text(sandbox, "return require('lissom').shapes.box():area()");
        CHECK_MESSAGE(status == LUA_OK, push_error_text(sandbox.lua(), -1));
    }
    CHECK(memory->used() == 0);
}

TEST_CASE("sandbox: memory is Lua's and the kernel's together") {
    SandboxLimits limits = patient();
    limits.memory_bytes = std::size_t{64} << 20;
    Sandbox sandbox(limits, {});
    CHECK(sandbox.memory()->limit() == limits.memory_bytes);
    CHECK(run_text(sandbox, "kept = ('x'):rep(20 * 2^20) return true") == LUA_OK);
    CHECK(sandbox.memory()->used() > std::size_t{20} << 20);
    CHECK(run_text(sandbox,
                   "local lissom = require 'lissom' "
                   "local bar = lissom.shapes.bar{ across = 40, along = 400 } "
                   "local _, problem = lissom.try(function() "
                   "local deformer = lissom.deformer(bar) "
                   "deformer:add_handle(bar:region('bottom')) "
                   "deformer:add_handle(bar:region('top')):rotate{ axis = 'y', angle = 90 } "
                   "return deformer:solve() end) return problem.code") == LUA_OK);
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

// Deforms, merges and grows, and tells what came out.
constexpr const char* kThreeChapters = R"(
local lissom = require "lissom"
local bar = lissom.shapes.bar{ across = 6, along = 40 }
local deformer = lissom.deformer(bar)
deformer:add_handle(bar:region("bottom"))
deformer:add_handle(bar:region("top")):rotate{ axis = "z", angle = 60 }
assert(deformer:solve())
local lower = lissom.shapes.cylinder{ segments = 30, rings = 20, caps = false }
local upper = lower:copy():transform{ translate = { 0.1, 2.5, 0 } }
local join = { source = upper:boundaries()[1], target = lower:boundaries()[2] }
local merged = assert(lissom.merge{ source = upper, target = lower, joins = { join } })
local style = assert(lissom.hairstyle(lissom.shapes.head{ vertices = 3000 }, { resolution = 6000 }))
local points = {}
for i, at in ipairs{ { 20, 50 }, { 70, 25 }, { 85, -15 } } do
    points[i] = style:at{ azimuth = at[1], elevation = at[2], lift = 0.01 }
end
style:add_stream{ points = points }
local hair = assert(style:grow{ count = 2000, length = 0.15 })
return bar:hash() .. " " .. merged:hash() .. " " .. hair:hash()
)";

std::string three_chapters() {
    Sandbox sandbox(patient(), {});
    lua_State* L = sandbox.lua();
    if (luaL_loadstring(L, kThreeChapters) != LUA_OK) return "no script";
    sandbox.call(0, 1);
    const char* text = lua_tostring(L, -1);
    return text ? text : "no text";
}

TEST_CASE("sandbox: ten states on ten threads make what one makes alone") {
    const std::string alone = three_chapters();
    INFO(alone);
    CHECK(std::count(alone.begin(), alone.end(), ' ') == 2);
    std::array<std::string, 10> results;
    {
        std::vector<std::jthread> threads;
        for (std::string& result : results) {
            threads.emplace_back([&result] { result = three_chapters(); });
        }
    }
    for (const std::string& result : results) CHECK(result == alone);
}

TEST_CASE("sandbox: the account of the host is charged too, and holds") {
    const auto account = std::make_shared<MemoryAccount>(std::size_t{32} << 20);
    HostOptions options;
    options.context.memory = account;
    {
        Sandbox sandbox(patient(), options);
        CHECK(account->used() == sandbox.memory()->used());
        CHECK(run_text(sandbox, "return ('x'):rep(40 * 2^20)") != LUA_OK);
        CHECK(run_text(sandbox, "kept = require('lissom').shapes.grid{ segments = 100 }") ==
              LUA_OK);
        CHECK(account->used() > 1'000'000);
    }
    CHECK(account->used() == 0);
    CHECK(account->peak() <= account->limit());
}

TEST_CASE("sandbox: objects that no script holds make room for others") {
    SandboxLimits limits = patient();
    limits.memory_bytes = std::size_t{32} << 20;
    Sandbox sandbox(limits, {});
    CHECK(
        run_text(sandbox,
                 "local l = require('lissom') local bar = l.shapes.bar{ across = 20, along = 100 } "
                 "for i = 1, 200 do assert(bar:copy()) assert(bar:region{ all = true }) "
                 "assert(bar:subdivide(1)) end return true") == LUA_OK);
    const char* message = lua_tostring(sandbox.lua(), -1);
    INFO(std::string(message ? message : ""));
    CHECK(lua_toboolean(sandbox.lua(), -1));
}

TEST_CASE("sandbox: files of a host's table") {
    std::map<std::string, std::string> files{{"tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
                                             {"lib/part.lua", "return 7"}};
    HostOptions options;
    options.context.files.read = [&](std::string_view path,
                                     const std::function<void(std::string_view)>& sink) {
        const auto found = files.find(std::string(path));
        if (found == files.end()) return false;
        sink(found->second);
        return true;
    };
    options.context.files.write = [&](std::string_view path, std::string_view bytes) {
        files[std::string(path)] = bytes;
        return true;
    };
    SandboxLimits limits;
    limits.module_folders = {"lib"};
    limits.output_bytes = 1000;
    Sandbox sandbox(limits, options);
    CHECK(run_text(sandbox,
                   "local l = require('lissom') local m = assert(l.load('tri.obj')) "
                   "assert(require('part') == 7) assert(m:save('out.off')) "
                   "assert(select(2, pcall(function() return l.load('/etc/passwd.obj') end)).code "
                   "== 'file_not_found') "
                   "return select(2, pcall(function() return l.shapes.cactus():save('big.off') "
                   "end)).code") == LUA_OK);
    CHECK(std::string(lua_tostring(sandbox.lua(), -1)) == "file_write_failed");
    CHECK(files.contains("out.off"));
    CHECK_FALSE(files.contains("big.off"));
}

}  // namespace
}  // namespace lissom::lua
