// Texts that the library keeps, addresses that it could give out, and callbacks that it calls.
#include "tests/unit/bindings/sandbox/hostile_scripts.h"

namespace lissom::test {
namespace {

using enum HostileEnd;

const std::string kStart = "local l = require('lissom') local t = {} ";
const std::string kBox = kStart + "local m = l.shapes.box() ";
const std::string kLong = "(('n'):rep(4000000) .. i)";

}  // namespace

std::vector<HostileScript> hostile_names() {
    const char* const limit = "memory";
    return {
        {"names of regions",
         kBox + "local r = m:region{ all = true } for i = 1, 1e9 do assert(m:set_region(" + kLong +
             ", r)) end",
         error, "at most 255"},
        {"names that nothing has",
         kStart +
             "local b = ('x'):rep(20000000) for i = 1, 1e9 do pcall(function() return l[b] end) "
             "pcall(function() return l.shapes.box()[b] end) pcall(l.shapes.box, { [b] = 1 }) end",
         time},
        {"a choice that differs in millions of letters",
         kStart +
             "local a, b = ('x'):rep(5000000), ('y'):rep(5000000) while true do pcall(l.params, "
             "{ a = { type = 'choice', choices = { a }, default = b } }, { command_line = false }) "
             "end",
         time},
        {"many named regions",
         kBox + "local r = m:region{ all = true } for i = 1, 200 do m:set_region(('n'):rep(200) .. "
                "i, r) end while true do t[#t + 1] = assert(m:copy()) end",
         error, limit},
        {"names of attributes",
         kBox + "for i = 1, 1e9 do assert(m:add_attribute{ name = " + kLong +
             ", domain = 'vertex', width = 1 }) end",
         error, limit},
        {"names of objects",
         kBox + "local s = l.scene() for i = 1, 1e9 do s:add(" + kLong + ", m) end", error, limit},
        {"names of objects, changed",
         kBox +
             "local s = l.scene{ history = 1e12 } s:add('a', m) local from = 'a' "
             "for i = 1, 1e9 do local to = " +
             kLong + " s:rename(from, to) from = to end",
         error, limit},
        {"names of steps",
         kBox + "local s = l.scene{ history = 1e12 } s:add('a', m) for i = 1, 1e9 do s:step(" +
             kLong + ", function() m:transform{ translate = { 1, 0, 0 } } end) end",
         error, limit},
        {"many objects and steps",
         kBox + "local s = l.scene{ history = 1e12 } for i = 1, 1e9 do s:add('o' .. i, m) end",
         any},
        {"texts of parameters",
         kStart + "for i = 1, 1e9 do t[i] = l.params({ a = { type = 'string', default = " + kLong +
             ", help = " + kLong + " } }, { command_line = false }) end",
         error, limit},
        {"values of parameters",
         kStart +
             "for i = 1, 1e9 do t[i] = l.params({ a = { type = 'string', default = '' } }, "
             "{ command_line = false }) t[i].a = " +
             kLong + " end",
         error, limit},
        {"choices of a parameter",
         kStart +
             "local c = {} for i = 1, 4e5 do c[i] = 'choice of a parameter ' .. i end for i = "
             "1, 1e9 do t[i] = l.params({ a = { type = 'choice', choices = c, default = c[1] } "
             "}, { command_line = false }) end",
         any},
        {"name of a parameter",
         "require('lissom').params{ [('n'):rep(1e7)] = { type = 'number' } }", error},
        {"errors that quote names",
         kStart + "for i = 1, 1e9 do t[i] = select(2, pcall(l.load, " + kLong + ")) end", any},
        {"methods that are not there",
         kBox + "for i = 1, 1e9 do t[i] = select(2, pcall(function() return m[" + kLong +
             "] end)) end",
         any},
        {"names that are looked for among many",
         kBox + "local s = l.scene() for i = 1, 300 do s:add('object number ' .. i, m) end "
                "while true do pcall(s.get, s, ('object'):rep(1000)) end",
         time},
    };
}

std::vector<HostileScript> hostile_addresses() {
    const auto shows = [](const std::string& made) {
        return "local function f() end local c = coroutine.create(f) "
               "for _, x in ipairs{ {}, f, c, print, require('lissom'), require('lissom').load } "
               "do "
               "local text = " +
               made + " assert(not text:find('0x'), text) end return true";
    };
    return {
        {"tostring", shows("tostring(x)"), harmless},
        {"%s", shows("string.format('%5s %s %%s', 1, x)"), harmless},
        {"%p", "return string.format('%p', {})", error, "addresses"},
        {"%p with a width", "return string.format('%-20p', {})", error, "addresses"},
        {"the metatable of strings", shows("('%s'):format(x)"), harmless},
        {"a name of its own",
         "return tostring(setmetatable({}, { __name = 'Mine' })):match('^Mine: %d+$') ~= nil",
         harmless},
        {"a number for each",
         "local a, b = {}, {} return tostring(a) == tostring(a) and tostring(a) "
         "~= tostring(b)",
         harmless},
        {"objects of the library",
         kBox + "for _, x in ipairs{ m, m:region('top'), l.scene() } do "
                "assert(not tostring(x):find('0x')) end return true",
         harmless},
        {"methods of the library", kBox + "return not tostring(m.area):find('0x')", harmless},
        {"errors that name a table",
         kBox + "return not select(2, pcall(function() return m[{}] "
                "end)).message:find('0x')",
         harmless},
        {"errors joined with a table",
         kBox + "local _, e = pcall(l.load, '') return not (e .. {}):find('0x') and not "
                "({} .. e):find('0x')",
         harmless},
        {"messages of Lua", "return not select(2, pcall(function() return {} + 1 end)):find('0x')",
         harmless},
        {"error that is a table", "error({})", error},
        {"traceback", "return not debug.traceback(coroutine.create(function() end)):find('0x')",
         harmless},
        {"buffers as addresses",
         kBox + "return not pcall(function() return m:positions():address() end)", harmless},
        {"print of a table", "print({}, print) return true", harmless},
        {"tostring without a value", "tostring()", error, "value expected"},
        {"texts of wrong kinds",
         "tostring(setmetatable({}, { __tostring = function() return {} end "
         "}))",
         error, "must return a string"},
        {"upvalues, locals and hooks",
         "return debug.getlocal == nil and debug.setlocal == nil and debug.upvalueid == nil and "
         "debug.upvaluejoin == nil and debug.setuservalue == nil and debug.getmetatable == nil",
         harmless},
    };
}

std::vector<HostileScript> hostile_callbacks() {
    const std::string forever = "while true do end ";
    const std::string object = "local x = setmetatable({}, { ";
    return {
        {"try", "require('lissom').try(function() " + forever + "end)", time},
        {"try for ever",
         "local l = require('lissom') while true do l.try(function() " + forever + "end) end",
         time},
        {"step",
         kBox +
             "local s = l.scene() s:add('m', m) while true do pcall(s.step, s, 'a', function() " +
             forever + "end) end",
         time},
        {"steps in steps", kBox + "local s = l.scene() local function f() s:step('a', f) end f()",
         any},
        {"undo in a step",
         kBox + "local s = l.scene() s:add('m', m) return not pcall(s.step, s, 'a', function() "
                "s:undo() end)",
         harmless},
        {"step that yields",
         kBox + "local s = l.scene() local c = coroutine.wrap(function() s:step('a', "
                "function() coroutine.yield(1) end) end) pcall(c) pcall(c) return true",
         harmless},
        {"step that closes what it works on",
         kBox + "local s = l.scene() s:add('m', m) pcall(s.step, s, 'a', function() m:close() "
                "s:close() end) return not pcall(m.area, m)",
         harmless},
        {"objects that are closed twice", kBox + "m:close() m:close() return true", harmless},
        {"close of other things", kBox + "return not pcall(m.close, {})", harmless},
        {"method of one type on another",
         kBox + "return not pcall(m.area, l.scene()) and not pcall(l.scene().undo, m)", harmless},
        {"options with an index that loops",
         kStart + "l.shapes.box(setmetatable({}, { __index = function() " + forever + "end }))",
         any},
        {"options with pairs that loop",
         kStart + "l.shapes.box(setmetatable({}, { __pairs = function() " + forever + "end }))",
         any},
        {"list without an end",
         kBox + "m:region{ vertices = setmetatable({}, { __index = function(_, i) return 1 end, "
                "__len = function() return math.maxinteger end }) }",
         any},
        {"list of itself", kBox + "t[1] = t m:region{ vertices = t }", error},
        {"list of many",
         kBox + "for i = 1, 2e5 do t[i] = 1 end while true do m:region{ vertices = "
                "t } end",
         time},
        {"numbers that are none",
         kBox + "for _, x in ipairs{ 0/0, 1/0, -1/0, 1e308 } do assert(not pcall(m.transform, m, "
                "{ scale = x })) end return true",
         any},
        {"ids beyond all",
         kBox + "for _, x in ipairs{ 0, -1, 9, math.maxinteger, "
                "math.mininteger, 1.5 } do assert(not pcall(m.region, m, "
                "{ vertices = { x } })) end return true",
         harmless},
        {"tool for ever",
         kStart + "local tool = l.tool{ name = 'x', begin = function() " + forever + "end } " +
             forever,
         any},
        {"addition that loops", object + "__add = function() " + forever + "end }) return x + 1",
         time},
        {"concat that loops", object + "__concat = function() " + forever + "end }) return x .. 1",
         time},
        {"length that loops", object + "__len = function() " + forever + "end }) return #x", time},
        {"call that loops", object + "__call = function() " + forever + "end }) return x()", time},
        {"call of a call of a call", object + "}) getmetatable(x).__call = x return x()", time},
        {"equality that loops",
         object + "__eq = function() " + forever + "end }) return x == setmetatable({}, {})", time},
        {"order that loops", object + "__le = function() " + forever + "end }) return x <= x",
         time},
        {"new index that loops", object + "__newindex = function() " + forever + "end }) x.y = 1",
         time},
        {"pairs that loop",
         object + "__pairs = function() return function() return 1 end end }) for _ in pairs(x) do "
                  "end",
         time},
        {"length in a sort", object + "__len = function() " + forever + "end }) table.sort(x)",
         error, "__len"},
        {"index in a concat",
         object + "__index = function() " + forever + "end }) table.concat(x, '', 1, 2)", time},
        {"index in an unpack",
         object + "__index = function() " + forever + "end }) table.unpack(x, 1, 2)", time},
        {"index of itself", "local t = {} setmetatable(t, { __index = t }) return t.x", error},
        {"new index of itself", "local t = {} setmetatable(t, { __newindex = t }) t.x = 1", error},
        {"load by a reader that loops", "load(function() " + forever + "end)", time},
        {"load by a reader without an end", "load(function() return 'x = 1 ' end)", any},
        {"load by a reader of nothing", "return load(function() end) ~= nil", harmless},
        {"reader that yields",
         "local c = coroutine.wrap(function() return load(function() coroutine.yield() end) end) "
         "return c() == nil",
         harmless},
        {"message handlers within each other",
         "local function h() return xpcall(error, h) end for i = 1, 100 do xpcall(error, h) end " +
             forever,
         time},
        {"errors that raise errors",
         "local m = {} m.__tostring = function() error(setmetatable({}, m)) end "
         "error(setmetatable({}, m))",
         error},
        {"closers that raise errors",
         "for i = 1, 100 do pcall(function() local x <close> = setmetatable({}, { __close = "
         "function() error('x') end }) error('y') end) end " +
             forever,
         time},
        {"closers of closers",
         "local function f() local x <close> = setmetatable({}, { __close = f }) end f()", any},
        {"closer that yields",
         "local c = coroutine.wrap(function() local x <close> = setmetatable({}, { __close = "
         "function() coroutine.yield(1) end }) end) assert(c() == 1) c() return true",
         harmless},
        {"close of the running one", "return not pcall(coroutine.close, coroutine.running())",
         harmless},
        {"close within its own closer",
         "local c c = coroutine.create(function() local x <close> = setmetatable({}, { __close = "
         "function() pcall(coroutine.close, c) end }) coroutine.yield() end) coroutine.resume(c) "
         "return coroutine.close(c)",
         harmless},
        {"resume within a closer",
         "local c c = coroutine.create(function() local x <close> = setmetatable({}, { __close = "
         "function() coroutine.resume(c) end }) coroutine.yield() end) coroutine.resume(c) "
         "coroutine.close(c) return true",
         harmless},
        {"resume within a sort of itself",
         "local c c = coroutine.wrap(function() table.sort({ 3, 2, 1 }, function() pcall(c) return "
         "false end) return true end) return c()",
         harmless},
        {"resume within a comparison",
         "local c c = coroutine.wrap(function() return setmetatable({}, { __lt = function() "
         "return not pcall(c) end }) < {} end) return c()",
         harmless},
        {"wrap of wrap of wrap",
         "local f = coroutine.wrap for i = 1, 1e9 do f = coroutine.wrap(f) end", any},
        {"coroutines that hold each other",
         "local c while true do local d = c c = coroutine.create(function() coroutine.yield() "
         "return d end) coroutine.resume(c) end",
         any},
        {"coroutine in a finalizer",
         "return pcall(setmetatable, {}, { __gc = coroutine.wrap(print) }) == false", harmless},
        {"finalizer by a metatable's metatable",
         "local m = setmetatable({}, { __index = { __gc = print }, __newindex = rawset }) "
         "setmetatable({}, m) m.__gc = print collectgarbage() return true",
         harmless},
        {"finalizer at the end",
         "local m = {} kept = setmetatable({}, m) m.__gc = function() " + forever +
             "end return true",
         harmless},
        {"finalizer by rawset",
         "local m = {} kept = setmetatable({}, m) rawset(m, '__gc', function() " + forever +
             "end) return true",
         harmless},
        {"weak tables",
         "local t = setmetatable({}, { __mode = 'kv' }) for i = 1, 1e9 do t[{}] = {} "
         "end",
         time},
        {"weak keys that hold themselves",
         "local t = setmetatable({}, { __mode = 'k' }) for i = 1, 1e9 do local k = {} t[k] = { k } "
         "end",
         any},
        {"warnings", "return warn == nil", harmless},
        {"os.time of odd tables",
         "for _, x in ipairs{ {}, { year = 1e18, month = 1, day = 1 }, { year = 2000, month = "
         "math.maxinteger, day = 1 } } do assert(not pcall(os.time, x)) end return true",
         harmless},
        {"math.random of odd ranges",
         "assert(not pcall(math.random, 1, 0)) return math.random(math.mininteger, "
         "math.maxinteger) ~= nil",
         harmless},
        {"division of the least number",
         "return math.mininteger // -1 == math.mininteger and "
         "math.mininteger % -1 == 0",
         harmless},
        {"for without an end", "for i = 1, math.huge do end", time},
        {"for beyond the greatest number",
         "local n = 0 for i = math.maxinteger - 1, math.maxinteger do n = n + 1 end return n == 2",
         harmless},
    };
}

}  // namespace lissom::test
