// Functions of Lua's libraries in a sandbox beside the ones they replace.
#include <doctest/doctest.h>

#include <string>

#include "bindings/lua/sandbox/sandbox.h"
#include "bindings/lua/sandbox/stoppable.h"

namespace lissom::lua {
namespace {

// Calls each function with generated arguments and adds what comes of it to a text: results, or the
// message without its place and the function's name.
const char* const kCalls = R"lua(
local seed, lines = 1, {}
local function random(n)
    seed = (seed * 1103515245 + 12345) % 2147483648
    return seed // 65536 % n + 1
end
local function chain(t) return setmetatable({}, { __index = t, __newindex = t }) end
local function values()
    return {
        0, 1, 2, 3, -1, -2, 7, 1.5, 2.0, 1e15, math.maxinteger, math.mininteger, 0 / 0, "", "a", "abc",
        "a.b", "%a+", "(%w)(%w*)", "[%s%u]", "^a", "%d%d?", "%b()", "%f[%w]", "x%1", "%0%0", "hello world",
        "(1 + 2)", "i4", "<s1z", "\27Lua", "return 1, 2", "return", "return =", "10", "\0b\0", "\u{20ac}z",
        "%5.2f %s %q %d", "%q", "%Y", "!%H", true, false, {}, { 1, 2, 3 }, { 3, 1, 2, 5 },
        { "b", "a", "c" }, { 1, "x", 2 }, { 1, nil, 3 }, { a = "z", hello = 1 }, chain{ 4, 5, 6 },
        chain(chain{ "q", "r" }),
        function() end, function(x) return x end, function(a, b) return a > b end,
        function() error("mine", 0) end, function() error({}) end, print, string.upper, nil,
    }
end
local function text_of(value)
    local kind = type(value)
    if kind == "table" then
        local parts = {}
        for i = 1, 6 do parts[i] = tostring(rawget(value, i)):gsub(": .*", "") end
        return "{" .. table.concat(parts, " ") .. "}"
    end
    if kind == "function" or kind == "thread" then return kind end
    if kind == "string" then return (value:gsub("0?x%x+", "address")) end
    return math.type(value) == "float" and ("%.14g"):format(value) or tostring(value)
end
local function plain(message)
    if type(message) ~= "string" then return text_of(message) end
    return (message:gsub("^[%w%[%]\"=_. ]+:%d+: ", ""):gsub("to '[^']*'", "to '?'"))
end
local function note(name, done, ...)
    local parts = { name, tostring(done) }
    for i = 1, select("#", ...) do
        local value = (select(i, ...))
        parts[#parts + 1] = done and text_of(value) or plain(value)
    end
    lines[#lines + 1] = table.concat(parts, " | ")
end
local functions = {
    "string.rep", "string.sub", "string.byte", "string.upper", "string.lower", "string.reverse",
    "string.find", "string.match", "string.gsub", "string.gmatch", "string.format", "string.pack",
    "string.unpack", "string.packsize", "table.concat", "table.insert", "table.remove", "table.sort",
    "table.unpack", "table.move", "utf8.len", "utf8.offset", "utf8.codepoint", "coroutine.create",
    "coroutine.wrap", "coroutine.close", "xpcall", "setmetatable",
}
local limits = { ["string.rep"] = 12, ["table.move"] = 12, ["table.unpack"] = 12, ["table.concat"] = 12 }
for _, name in ipairs(functions) do
    local library, field = name:match("^(%w+)%.(%w+)$")
    local called = library and _G[library][field] or _G[name]
    for _ = 1, 400 do
        local all, given = values(), random(5) - 1
        local arguments, small = {}, limits[name]
        for i = 1, given do
            local value = all[random(61)]
            -- What a sandbox refuses by its size is not compared.
            if small and type(value) == "number" and (value ~= value or value > small or value < -small) then
                value = 5
            end
            arguments[i] = value
        end
        local kept = arguments[1]
        note(name, pcall(called, table.unpack(arguments, 1, given)))
        if type(kept) == "table" then note(name, true, kept) end
    end
end
-- Coroutines: yields through wrapped calls, errors, and what cannot be resumed.
local function try(name, f, ...) note(name, pcall(f, ...)) end
local steps = coroutine.wrap(function(a) local b = coroutine.yield(a + 1) error(b) end)
try("wrap", steps, 1) try("wrap", steps, "broken") try("wrap", steps)
local ends = coroutine.wrap(function() return 1, nil, 3 end)
try("wrap", ends) try("wrap", ends)
local own own = coroutine.wrap(function() return pcall(own) end)
try("own", own) try("own", own)
local object = coroutine.wrap(function() error({ 9 }) end)
try("object", object) try("object", object)
local inner, outer
outer = coroutine.wrap(function() return inner() end)
inner = coroutine.wrap(function() return pcall(outer) end)
try("outer", outer)
local closing = coroutine.wrap(function()
    local x <close> = setmetatable({}, { __close = function(_, why) error("closed by " .. plain(why)) end })
    error("first")
end)
try("closing", closing) try("closing", closing)
for _, text in ipairs{ "return 1", "return =", "", "x = y" } do
    note("load", pcall(load, text)) note("load", pcall(load, text, "=name", "t", {}))
end
for _, call in ipairs{
    function() return table.sort({ 3, 2, 1 }, function() coroutine.yield() end) end,
    function() return ("a"):gsub("a", function() coroutine.yield() end) end,
    function() return table.concat(setmetatable({}, { __index = function() coroutine.yield() end }), "", 1, 1) end,
    function() return pcall(coroutine.yield, 1) end,
    function() return xpcall(coroutine.yield, print, 1) end,
    function() return xpcall(function() coroutine.yield(1) error("late") end, function(m) return "heard" end) end,
    function() return load(function() coroutine.yield() end) end,
    function() for k in ("ab"):gmatch(".") do coroutine.yield(k) end end,
} do
    local thread = coroutine.create(call)
    for _ = 1, 4 do note("yield", coroutine.resume(thread)) end
    note("close", coroutine.close(thread))
end
-- Long moves, which are made in pieces.
local long = {}
for i = 1, 1500000 do long[i] = i end
for _, range in ipairs{ { 1, 1300000, 1001 }, { 1001, 1300000, 1 }, { 1, 1200000, 1200001 }, { 5, 1200000, 5 } } do
    table.move(long, range[1], range[2], range[3])
    note("moved", true, long[1], long[1000], long[1001], long[1048576], long[1048577], long[1300000], long[2400000])
end
-- Finalizers in the order of Lua; a sandbox has none.
local order = {}
local function last(i) return { __gc = function() order[#order + 1] = i end } end
for i = 1, 5 do
    if not pcall(setmetatable, {}, last(i)) then order = { 5, 4, 3, 2, 1 } end
end
collectgarbage()
note("finalized", true, table.concat(order, " "))
return table.concat(lines, "\n")
)lua";

std::string result_of(lua_State* L) {
    std::size_t size = 0;
    const char* text = lua_tolstring(L, -1, &size);
    return text ? std::string(text, size) : "no text";
}

// By stock Lua 5.4, or as `stoppable` changes it.
std::string by_stock_libraries(Stoppable* stoppable = nullptr) {
    lua_State* L = luaL_newstate();
    luaL_openlibs(L);
    if (stoppable) {
        stoppable->open(L);
        stoppable->open_finalizers(L);
    }
    const bool failed = luaL_loadbufferx(L, kCalls, std::char_traits<char>::length(kCalls),
                                         "=calls", "t") != LUA_OK ||
                        lua_pcall(L, 0, 1, 0) != LUA_OK;
    const std::string text = failed ? "failed: " + result_of(L) : result_of(L);
    lua_close(L);
    return text;
}

std::string by_sandbox() {
    Sandbox sandbox({}, {});
    lua_State* L = sandbox.lua();
    REQUIRE(luaL_loadbufferx(L, kCalls, std::char_traits<char>::length(kCalls), "=calls", "t") ==
            LUA_OK);
    const bool failed = sandbox.call(0, 1) != LUA_OK;
    return failed ? "failed: " + result_of(L) : result_of(L);
}

// The lines that differ, side by side.
std::string differences(const std::string& a, const std::string& b) {
    std::string found;
    std::size_t i = 0, k = 0;
    while (i < a.size() && k < b.size() && found.size() < 4000) {
        const std::string left = a.substr(i, a.find('\n', i) - i);
        const std::string right = b.substr(k, b.find('\n', k) - k);
        if (left != right) found += "stock:   " + left + "\nsandbox: " + right + "\n";
        i += left.size() + 1;
        k += right.size() + 1;
    }
    return found;
}

TEST_CASE("sandbox: functions of Lua's libraries do what those of stock Lua do") {
    const std::string stock = by_stock_libraries(), own = by_sandbox();
    REQUIRE(stock.find("failed") != 0);
    CHECK(stock.size() > 100'000);
    const bool is_same = stock == own;
    CHECK_MESSAGE(is_same, differences(stock, own));
    Stoppable stoppable;
    const std::string stopped = by_stock_libraries(&stoppable);
    const bool is_same_stopped = stock == stopped;
    CHECK_MESSAGE(is_same_stopped, differences(stock, stopped));
}

}  // namespace
}  // namespace lissom::lua
