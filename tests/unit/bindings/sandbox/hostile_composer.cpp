#include "tests/unit/bindings/sandbox/hostile_composer.h"

#include <iterator>
#include <random>
#include <string_view>

namespace lissom::test {
namespace {

// Work that is endless, or fails, or takes much; `f` is the script itself, `t` a table that it
// keeps.
constexpr std::string_view kActs[] = {
    "while true do end",
    "for i = 1, 1e9 do end",
    "f(n + 1)",
    "return f(n + 1)",
    "for i = 1, 100 do t[#t + 1] = ('x'):rep(1000) .. #t end",
    "while true do t[#t + 1] = ('x'):rep(100000) .. #t end",
    "local s = ('x'):rep(1000000) for i = 1, 1e9 do local u = s .. i end",
    "return ('a'):rep(300):find('a*a*a*a*a*b')",
    "return (('a'):rep(1000):gsub('a', ('x'):rep(1000)))",
    "error('x', n)",
    "error(t)",
    "error()",
    "coroutine.yield(t)",
    "while true do coroutine.yield() end",
    "return coroutine.close(c)",
    "return pcall(coroutine.resume, c)",
    "c = coroutine.running()",
    "return t.a.b.c",
    "t.x = setmetatable({}, getmetatable(t)) t = t.x",
    "collectgarbage()",
    "return load(('x = 1 '):rep(10000))",
    "print(('x'):rep(10000), t)",
    "table.sort({ 3, 1, 2 }, function() return true end)",
    "return table.concat(t)",
    "return string.format('%s %d', t, 'x')",
    "require('lissom').shapes.sphere()",
    "t.m = t.m or require('lissom').shapes.box() t.m:set_region(('n'):rep(1000) .. n, t.m:region{ "
    "all = true })",
    "return require('lissom').load(('p'):rep(n * 1000))",
    "require('lissom').params{ [('n'):rep(10000)] = { type = 'number' } }",
    "t.m = require('lissom').shapes.box() t.m:close() return t.m:area()",
    "local s = require('lissom').scene() s:add('m', require('lissom').shapes.box()) s:undo()",
};

// Ways to call a body, whose place is '@'.
constexpr std::string_view kWays[] = {
    "pcall(function() @ end)",
    "while true do pcall(function() @ end) end",
    "xpcall(function() @ end, function() @ end)",
    "coroutine.wrap(function() @ end)()",
    "c = coroutine.create(function() @ end) coroutine.resume(c) coroutine.close(c)",
    "c = coroutine.create(function() @ end) while coroutine.resume(c) do end",
    "while true do pcall(coroutine.wrap(function() @ end)) end",
    "do local x <close> = setmetatable({}, { __close = function() @ end }) @ end",
    "c = coroutine.create(function() local x <close> = setmetatable({}, { __close = function() @ "
    "end }) @ end) "
    "coroutine.resume(c) pcall(coroutine.close, c)",
    "local _ = setmetatable({}, { __index = function() @ end }).x",
    "setmetatable({}, { __newindex = function() @ end }).x = 1",
    "setmetatable({}, { __call = function() @ end })()",
    "local m = { __lt = function() @ end, __le = function() @ end } "
    "local _ = setmetatable({}, m) < setmetatable({}, m)",
    "local _ = setmetatable({}, { __concat = function() @ end }) .. 'x'",
    "local _ = #setmetatable({}, { __len = function() @ end })",
    "local _ = setmetatable({}, { __eq = function() @ end }) == setmetatable({}, {})",
    "tostring(setmetatable({}, { __tostring = function() @ return 'x' end }))",
    "print(string.format('%s', setmetatable({}, { __tostring = function() @ return 'x' end })))",
    "for _ in pairs(setmetatable({}, { __pairs = function() @ return next, {} end })) do end",
    "table.sort({ 5, 3, 1, 4 }, function(a, b) @ end)",
    "local _ = ('abc'):gsub('.', function() @ end)",
    "for _ in ('abc'):gmatch('.') do @ end",
    "load(function() @ end)",
    // The level of the brackets is that of the depth, so that such texts may hold others.
    "local g = load([^[ @ ]^]) if g then g() end",
    "table.concat(setmetatable({}, { __index = function() @ return 'x' end }), '', 1, 10)",
    "table.move(setmetatable({}, { __index = function() @ end }), 1, 10, 1, {})",
    "local m = {} setmetatable({}, m) m.__gc = function() @ end collectgarbage()",
    "require('lissom').try(function() @ end)",
    "require('lissom').scene():step('s', function() @ end)",
    "require('lissom').params{ p = setmetatable({}, { __index = function() @ end }) }",
    "for i = 1, 3 do @ end",
    "@ @",
};

class Composer {
  public:
    explicit Composer(std::uint32_t seed) : random_(seed) {}

    std::string body(int depth) {
        const bool ends = depth <= 0 || below(4) == 0;
        if (ends) return "if n < 1000 then " + std::string(one_of(kActs)) + " end";
        std::string text(one_of(kWays));
        for (std::size_t at; (at = text.find('^')) != std::string::npos;) {
            text.replace(at, 1, static_cast<std::size_t>(depth), '=');
        }
        for (std::size_t at = text.find('@'); at != std::string::npos; at = text.find('@', at)) {
            const std::string inner = body(depth - 1);
            text.replace(at, 1, inner);
            at += inner.size();
        }
        return "do " + text + " end";
    }

  private:
    std::uint32_t below(std::size_t n) { return random_() % static_cast<std::uint32_t>(n); }
    template <typename List>
    std::string_view one_of(const List& list) {
        return list[below(std::size(list))];
    }

    // Its numbers are the same everywhere.
    std::mt19937 random_;
};

}  // namespace

std::string composed_script(std::uint32_t seed) {
    return "local t, c = {} local f function f(n) " + Composer(seed).body(4) + " end f(1)";
}

}  // namespace lissom::test
