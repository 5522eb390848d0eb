// What an object of a script takes before its lists is charged to its account, whatever its kind.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <memory>
#include <string>

#include "bindings/lua/core/error_object.h"
#include "bindings/lua/sandbox/sandbox.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace lissom::lua {
namespace {

constexpr std::size_t kLimit = std::size_t{48} << 20;

// Bytes of the process's heap in use; 0 where that is not known.
std::size_t heap_bytes() {
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
    const auto info = mallinfo2();
    return info.uordblks + info.hblkhd;
#else
    return 0;
#endif
}

// Makes the objects that `expression` gives after `setup`, and keeps all of them.
std::string keeping(const std::string& setup, const std::string& expression) {
    return "local l = require 'lissom' kept = {} " + setup +
           " for i = 1, 1e9 do kept[i] = " + expression + " end";
}

void check_kind(const std::string& setup, const std::string& expression) {
    CAPTURE(expression);
    SandboxLimits limits;
    limits.seconds = 1000.0;
    limits.memory_bytes = kLimit;
    const std::size_t before = heap_bytes();
    std::shared_ptr<MemoryAccount> memory;
    {
        Sandbox sandbox(limits, {});
        memory = sandbox.memory();
        lua_State* L = sandbox.lua();
        const std::string text = keeping(setup, expression);
        REQUIRE(luaL_loadbufferx(L, text.data(), text.size(), "=script", "t") == LUA_OK);
        CHECK(sandbox.call(0, 0) != LUA_OK);
        const std::string message = push_error_text(L, -1);
        CHECK_MESSAGE(message.find("memory") != std::string::npos, message);
        const std::size_t growth = heap_bytes() - before;
        INFO("the heap grew by ", growth >> 10, " kB");
        CHECK(growth <= 3 * kLimit);
    }
    CHECK(memory->used() == 0);
}

TEST_CASE("sandbox: many objects of a kind end at the limit of memory") {
    const std::string box = "local m = l.shapes.box()";
    check_kind("", "l.shapes.box()");
    check_kind(box, "m:region{ vertices = { 1 } }");
    check_kind("local m = l.shapes.grid{ segments = 2 }", "m:boundaries()[1]");
    check_kind(box, "m:positions()");
    check_kind(box + " m:add_attribute{ name = 'a', domain = 'vertex', width = 1 }",
               "m:attribute('a')");
    check_kind("", "l.strands{ points = { { 0, 0, 0 } }, counts = { 1 } }");
    check_kind("", "l.scene{}");
    check_kind("", "l.gizmo{}");
    check_kind("", "l.camera{ eye = { 0, 0, 5 } }");
    check_kind("", "l.polyline{ points = { { 0, 0, 0 }, { 1, 0, 0 } } }");
    check_kind("", "l.params({ a = { type = 'number', default = 1 } }, { command_line = false })");
    check_kind(box, "l.deformer(m)");
    check_kind(box, "l.pose_space{ rest = m, poses = { a = m } }");
    check_kind(box + " local d = l.deformer(m) d:add_handle(m:region{ vertices = { 1 } })",
               "d:handles()[1]");
    check_kind(box + " local d = l.deformer(m)", "d:pose()");
}

// A number of /proc/self/status in bytes; 0 if there is none.
std::size_t status_bytes(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with(name + ":")) return std::stoul(line.substr(name.size() + 1)) << 10;
    }
    return 0;
}

// Sanitizers keep freed memory.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSanitized = true;
#elif defined(__has_feature)
constexpr bool kIsSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool kIsSanitized = false;
#endif

// Makes the greatest resident size that of now. Returns whether that can be had.
bool forget_greatest_size() {
    if (kIsSanitized) return false;
    std::ofstream refs("/proc/self/clear_refs");
    return static_cast<bool>(refs << "5" << std::flush);
}

void check_peak(const std::string& setup, const std::string& call) {
    CAPTURE(call);
    SandboxLimits limits;
    limits.seconds = 2.0;
    limits.memory_bytes = 2 * kLimit;
    Sandbox sandbox(limits, {});
    lua_State* L = sandbox.lua();
    const std::string text = setup + "return pcall(function() " + call + " end)";
    REQUIRE(luaL_loadbufferx(L, text.data(), text.size(), "=script", "t") == LUA_OK);
    const std::size_t before = status_bytes("VmRSS");
    const bool is_measured = forget_greatest_size();
    sandbox.call(0, 0);
    if (!is_measured) return;
    const std::size_t growth = std::max(status_bytes("VmHWM"), before) - before;
    INFO("the process grew by ", growth >> 20, " MB");
    CHECK(growth <= 2 * limits.memory_bytes);
}

TEST_CASE("sandbox: calls with many points take no memory that is not counted") {
    const std::string points =
        "local l = require 'lissom' local m = l.shapes.sphere{} local c = l.frame(m) local p = {} "
        "for i = 1, 100000 do p[i] = { 640 + 600 * math.cos(i), 480 + 400 * math.sin(i * 1.1) } "
        "end ";
    for (const std::string call :
         {"c:select{ mesh = m, lasso = p }", "c:stroke{ points = p, spacing = .01 }",
          "c:stroke{ points = p, on = m }",
          "c:stroke{ points = { p[1], p[2], p[3] }, spacing = 1e-9 }",
          "c:stroke{ points = { { 1, 2 }, { 1e16, 1e16 } } }"}) {
        check_peak(points, call);
    }
    const std::string hair =
        "local l = require 'lissom' local p, n, s = {}, {}, {} "
        "for i = 1, 50 do n[i] = 20 for j = 1, 20 do p[#p + 1] = { i * 1e-4, j * .01, 0 } end end "
        "for i = 1, 100000 do s[i] = { math.sin(i) * .1, i * 1e-5, math.cos(i) * .1 } end "
        "local h = l.strands{ points = p, counts = n } ";
    for (const std::string call :
         {"h:duplicate{ copies = 1000000 }", "h:duplicate{ copies = 20000000 }",
          "h:feed_braid{ spine = s, across = { 1, 0, 0 } }",
          "for i = 1, 1e9 do h:append(h:copy()) end",
          "h:resample{ count = 20000 } h:detail{ from = h }", "h:resample{ count = 1000000 }"}) {
        check_peak(hair, call);
    }
}

}  // namespace
}  // namespace lissom::lua
