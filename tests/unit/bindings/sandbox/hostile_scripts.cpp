#include "tests/unit/bindings/sandbox/hostile_scripts.h"

namespace lissom::test {
namespace {

using enum HostileEnd;

// Loops that no error of the script's own ends.
std::vector<HostileScript> endless() {
    return {
        {"loop", "while true do end", time},
        {"repeat", "repeat until false", time},
        {"goto", "::again:: goto again", time},
        {"tail calls", "local function f() return f() end f()", time},
        {"loop in pcall", "pcall(function() while true do end end) while true do end", time},
        {"pcall for ever", "while true do pcall(function() while true do end end) end", time},
        {"pcall in pcall",
         "local function f() pcall(f) while true do end end while true do pcall(f) end", time},
        {"xpcall whose handler loops",
         "while true do xpcall(function() while true do end end, function() while true do end end) "
         "end",
         time},
        {"error handler that calls itself",
         "local function h() xpcall(error, h) end while true do xpcall(error, h) end", time},
        {"coroutine", "coroutine.wrap(function() while true do end end)()", time},
        {"coroutines for ever",
         "while true do pcall(coroutine.wrap(function() while true do end end)) end", time},
        {"coroutine.close that loops at the end",
         "local c = coroutine.create(function() local x <close> = setmetatable({}, "
         "{ __close = function() while true do end end }) coroutine.yield() end) "
         "coroutine.resume(c) coroutine.close(c)",
         time},
        {"resume that loops at the end",
         "return coroutine.resume(coroutine.create(function() while true do end end))", time},
        {"coroutine in coroutine",
         "local function f() return coroutine.wrap(f)() end while true do pcall(f) end", time},
        {"resume for ever",
         "while true do coroutine.resume(coroutine.create(function() while true do end end)) end",
         time},
        {"yield for ever",
         "local c = coroutine.wrap(function() while true do coroutine.yield() end end) "
         "while true do c() end",
         time},
        {"close that loops",
         "do local x <close> = setmetatable({}, { __close = function() while true do end end }) "
         "end",
         time},
        {"close that loops after an error",
         "while true do pcall(function() local x <close> = setmetatable({}, "
         "{ __close = function() while true do end end }) error() end) end",
         time},
        {"coroutine.close that loops",
         "local c = coroutine.create(function() local x <close> = setmetatable({}, "
         "{ __close = function() while true do end end }) coroutine.yield() end) "
         "coroutine.resume(c) coroutine.close(c) while true do end",
         time},
        {"close that loops in a coroutine that is ended",
         "coroutine.wrap(function() local x <close> = setmetatable({}, { __close = function() "
         "while true do end end }) while true do end end)()",
         time},
        {"coroutine.close of one that was ended",
         "while true do local c = coroutine.create(function() local x <close> = setmetatable({}, "
         "{ __close = function() while true do end end }) while true do end end) "
         "coroutine.resume(c) coroutine.close(c) end",
         time},
        {"handler of a coroutine",
         "coroutine.wrap(function() xpcall(function() while true do end end, "
         "function() while true do end end) while true do end end)()",
         time},
        {"index that loops",
         "local t = setmetatable({}, { __index = function() while true do end end }) return t.x",
         time},
        {"tostring that loops",
         "print(setmetatable({}, { __tostring = function() while true do end end }))", time},
        {"comparison that loops",
         "local m = { __lt = function() while true do end end } "
         "return setmetatable({}, m) < setmetatable({}, m)",
         time},
        {"sort with a comparison that loops",
         "table.sort({ 1, 2, 3 }, function() while true do end end)", time},
        {"sort with a comparison that is always true, for ever",
         "while true do pcall(table.sort, { 5, 3, 1, 4, 2 }, function() return true end) end",
         time},
        {"gsub whose function loops", "('x'):gsub('x', function() while true do end end)", time},
        {"load whose reader loops", "load(function() while true do end end)", time},
        {"load whose reader never ends", "load(function() return ' ' end)", any},
        {"concat with an index that loops",
         "table.concat(setmetatable({}, { __index = function() while true do end end }), '', 1, 9)",
         time},
        {"iterator that never ends", "for _ in function() return 1 end do end", time},
        {"next over its own table", "local t = { 1 } while true do for k in pairs(t) do end end",
         time},
        {"collections for ever",
         "local t = {} for i = 1, 1e5 do t[i] = {} end while true do collectgarbage() end", time},
        {"rep and forget", "while true do local s = ('x'):rep(1e6) end", time},
        {"sorted again and again",
         "local t = {} for i = 1, 1e5 do t[i] = i end while true do table.sort(t) end", time},
        {"moved again and again", "local t = {} while true do table.move(t, 1, 1e6, 2) end", time},
        {"moved by metamethods without a step",
         "local t = setmetatable({}, { __index = type }) "
         "local u = setmetatable({}, { __newindex = type }) "
         "while true do table.move(t, 1, 9e6, 1, u) end",
         time},
        {"empty strings repeated", "return (''):rep(math.maxinteger, '') == ''", harmless},
        {"sort of long strings",
         "local long, t = {}, {} for i = 1, 7 do long[i] = ('a'):rep(1000000) .. i end "
         "for i = 1, 200000 do t[i] = long[i % 7 + 1] end table.sort(t)",
         time},
        {"bodies of coroutines shorter than a look",
         "while true do coroutine.wrap(function() return 1 end)() end", time},
        {"bodies of created coroutines",
         "while true do coroutine.resume(coroutine.create(function() return 1 end)) end", time},
        {"moved through a chain of indices",
         "local t = {} for i = 1, 1900 do t = setmetatable({}, { __index = t }) end "
         "table.move(t, 1, 9000000, 1, {})",
         error, "too many elements"},
        {"moved into a chain of indices",
         "local t = {} for i = 1, 1900 do t = setmetatable({}, { __newindex = t }) end "
         "table.move({}, 1, 9000000, 1, t)",
         error, "too many elements"},
        {"moved through a short chain again and again",
         "local t = {} for i = 1, 1900 do t = setmetatable({}, { __index = t }) end "
         "while true do table.move(t, 1, 9000, 1, {}) end",
         time},
        {"concat through a chain of indices",
         "local t = setmetatable({}, { __index = function() return '' end }) "
         "for i = 1, 100 do t = setmetatable({}, { __index = t }) end "
         "while true do pcall(table.concat, t, '', 1, 9000) end",
         time},
        {"unpack through a chain of indices",
         "local t = {} for i = 1, 1900 do t = setmetatable({}, { __index = t }) end "
         "while true do table.unpack(t, 1, 200) end",
         time},
        {"insert at the front for ever",
         "local t = {} for i = 1, 1e5 do t[i] = 0 end while true do table.insert(t, 1, 1) end",
         time},
        {"numbers of many digits for ever",
         "local s = ('9'):rep(5000000) while true do tonumber(s, 10) end", time},
        {"sizes of long formats for ever",
         "local f = ('x'):rep(5000000) while true do string.packsize(f) end", time},
        {"unpacked bytes for ever",
         "local f, s = ('x'):rep(5000000), ('y'):rep(5000000) while true do string.unpack(f, s) "
         "end",
         time},
        {"date of a long format", "return os.date(('%c'):rep(1000000))", error,
         "too long a format"},
        {"quoted again and again",
         "local s = ('\\0'):rep(1000000) while true do string.format('%q', s) end", any},
        {"quoted at once", "return string.format('%q', ('\\0'):rep(5000000))", error, "too long"},
        {"source of megabytes", "local s = ('x = 1 '):rep(2000000) while true do load(s) end",
         time},
        {"modules for ever", "while true do pcall(require, 'none') end", time},
        {"assert for ever", "while true do pcall(assert, false) end", time},
        {"meshes for ever",
         "local lissom = require 'lissom' while true do lissom.shapes.sphere() end", time},
        {"kernel call in pcall for ever",
         "local lissom = require 'lissom' local m = lissom.shapes.sphere{ segments = 60 } "
         "while true do pcall(m.smooth, m, { iterations = 1000 }) end",
         time},
        {"one long kernel call",
         "local lissom = require 'lissom' local m = lissom.shapes.sphere{ segments = 200 } "
         "m:smooth{ iterations = 1000000 } while true do end",
         any},
    };
}

// Patterns that Lua's own matcher would not finish in hours.
std::vector<HostileScript> patterns() {
    return {
        {"find: lazy items", "return ('a'):rep(150):find('.-.-.-.-.-b')", time},
        {"find: long and lazy", "return ('a'):rep(200000):find('.-b')", time},
        {"find: greedy items", "return ('a'):rep(300):find('a*a*a*a*a*b')", time},
        {"find: optional items",
         "return ('a'):rep(28):find(('a?'):rep(28) .. ('a'):rep(28) .. 'b')", any},
        {"match", "return ('a'):rep(150):match('(.-)(.-)(.-)(.-)(.-)b')", time},
        {"gmatch", "for _ in ('a'):rep(300):gmatch('a*a*a*a*a*b') do end", time},
        {"gsub", "return ('a'):rep(300):gsub('a*a*a*a*a*b', '')", time},
        {"gsub in pcall", "while true do pcall(string.gsub, ('a'):rep(300), 'a*a*a*a*a*b', '') end",
         time},
        {"find in a coroutine",
         "coroutine.wrap(function() return ('a'):rep(300):find('a*a*a*a*a*b') end)()", time},
        {"balanced", "while true do ('('):rep(100000):find('%b()') end", time},
        {"plain", "return ('a'):rep(4000000):find(('a'):rep(2000000) .. 'b', 1, true)", any},
        {"plain for ever",
         "while true do ('a'):rep(1000000):find(('a'):rep(500000) .. 'b', 1, true) end", time},
        {"the original by the metatable of strings",
         "local find = getmetatable('').__index.find return find(('a'):rep(300), 'a*a*a*a*a*b')",
         time},
        {"long set", "return ('a'):rep(1000000):find('[' .. ('b'):rep(10000000) .. ']')", time},
        {"long set, repeated",
         "return ('a'):rep(1000000):gsub('[' .. ('b'):rep(10000000) .. ']*', '')", time},
        {"replacement of many captures", "return ('a'):rep(10000):gsub('a', ('%0'):rep(100000))",
         any},
        {"deep captures", "return ('x'):find(('('):rep(300) .. 'x')", error, "captures"},
        {"deep pattern", "return ('x'):rep(1000):find(('x?'):rep(1000))", error, "too complex"},
        {"no end of a set", "return ('x'):find('[a')", error, "missing ']'"},
        {"no end of an escape", "return ('x'):find('%')", error, "ends with '%'"},
        {"no arguments of %b", "return ('x'):find('%b')", error, "%b"},
        {"capture that is not there", "return ('x'):find('%1')", error, "capture index"},
        {"frontier without a set", "return ('x'):find('%f')", error, "missing '['"},
        {"replacement that refers to nothing", "return ('x'):gsub('x', '%2')", error,
         "capture index"},
    };
}

// What would take more memory than there is.
std::vector<HostileScript> memory() {
    const char* const enough = "not enough memory";
    return {
        {"rep", "return ('x'):rep(1e9)", error, enough},
        {"rep beyond all sizes", "return ('x'):rep(math.maxinteger)", error, "too large"},
        {"rep with a separator", "return ('x'):rep(1e9, 'y')", error, "memory"},
        {"doubling", "local s = 'x' while true do s = s .. s end", error, enough},
        {"table", "local t = {} for i = 1, 1e9 do t[i] = i end", error, enough},
        {"table by keys", "local t = {} for i = 1, 1e9 do t['k' .. i] = i end", any},
        {"nested tables", "local t = {} while true do t = { t, t } end", any},
        {"closures", "local t = {} while true do t[#t + 1] = function() return t end end", error,
         enough},
        {"coroutines", "local t = {} while true do t[#t + 1] = coroutine.create(print) end", error,
         enough},
        {"concat",
         "local t = {} for i = 1, 1000 do t[i] = ('x'):rep(1e5) end "
         "return table.concat(t)",
         error, enough},
        {"concat of what is not there",
         "return table.concat(setmetatable({}, { __index = type }), '', 1, 9e6)", error, enough},
        {"gsub that grows", "local s = 'x' while true do s = s:gsub('.', '%0%0') end", any},
        {"format", "local s = '' while true do s = string.format('%s%s%s', s, s, 'x') end", any},
        {"swallowed by pcall",
         "local t = {} while true do pcall(function() while true do t[#t + 1] = ('x'):rep(1e5) .. "
         "#t end end) end",
         time},
        {"stack", "local function f() return 1 + f() end return f()", error},
        {"stack by pcall", "local function f() return pcall(f) end return f()", any},
        {"stack by metamethods",
         "local t = {} setmetatable(t, { __index = function(_, k) return t[k] end }) return t.x",
         error},
        {"stack by tostring",
         "local t = {} setmetatable(t, { __tostring = function() return tostring(t) end }) "
         "return tostring(t)",
         error},
        {"long argument list", "return select('#', table.unpack({}, 1, 1e7))", error, "unpack"},
        {"longer argument list", "return table.unpack({}, 1, math.maxinteger)", error,
         "too many elements"},
        {"bytes as results", "return #{ ('x'):rep(1e7):byte(1, -1) }", error, "string slice"},
        {"length that lies",
         "return table.sort(setmetatable({}, { __len = function() return 1e9 end }))", error,
         "__len"},
        {"insert with a length that lies",
         "table.insert(setmetatable({}, { __len = function() return 1e9 end }), 1, 1)", error,
         "__len"},
        {"concat with a length that lies",
         "return table.concat(setmetatable({}, { __len = function() return math.maxinteger end }))",
         error, "too many elements"},
        {"move of everything", "table.move({}, 1, math.maxinteger - 1, 2)", error,
         "too many elements"},
        {"deeply nested source", "return load(('('):rep(1e5))", any},
        {"long source", "return load(('x = 1 '):rep(1e6))", any},
        {"number of many digits", "return tonumber(('9'):rep(1e7))", any},
        {"pack", "return string.pack('s8', ('x'):rep(1e8))", error, enough},
    };
}

// What would take more memory than there is by objects of the library. Each keeps what it makes, or
// makes too much at once.
std::vector<HostileScript> objects() {
    const char* const limit = "of the limit of";
    const std::string start = "local l = require('lissom') local t = {} ";
    const std::string bar = start + "local m = l.shapes.bar{ across = 20, along = 100 } ";
    const std::string hair =
        start +
        "local points, counts = {}, {} for i = 1, 2000 do points[i] = { i, 0, 0 } end "
        "for i = 1, 20 do counts[i] = 100 end local s = l.strands{ points = points, counts = "
        "counts } ";
    const std::string keep = "while true do t[#t + 1] = assert(";
    const std::string grow = "while true do m = assert(";
    return {
        {"copies of a mesh", bar + keep + "m:copy()) end", error, limit},
        {"copies of a mesh in pcall",
         bar + "while true do pcall(function() while true do t[#t + 1] = assert(m:copy()) end end) "
               "end",
         time},
        {"copies of a mesh in coroutines",
         bar + "coroutine.wrap(function() " + keep + "m:copy()) end end)()", error, limit},
        {"subdivision", bar + grow + "m:subdivide(1)) end", error, limit},
        {"subdivision at once", bar + "assert(m:subdivide(9))", error, limit},
        {"mesh appended to itself", bar + "while true do assert(m:append(m)) end", error, limit},
        {"grid", start + "assert(l.shapes.grid{ segments = 16000 })", error, limit},
        {"box", start + "assert(l.shapes.box{ segments = 5000 })", error, limit},
        {"sphere", start + "assert(l.shapes.sphere{ segments = 3000, kind = 'triangles' })", error,
         limit},
        {"sphere of quads", start + "assert(l.shapes.sphere{ segments = 5000, kind = 'quads' })",
         error, limit},
        {"torus", start + "assert(l.shapes.torus{ segments = 9000, tube_segments = 9000 })", error,
         limit},
        {"cylinder", start + "assert(l.shapes.cylinder{ segments = 9000, rings = 9000 })", error,
         limit},
        {"cactus", start + "assert(l.shapes.cactus{ vertices = 1000000 })", error, limit},
        {"regions", bar + keep + "m:region{ all = true }) end", error, limit},
        {"named regions",
         bar +
             "local r = m:region{ all = true } for i = 1, 1e9 do assert(m:set_region('r' .. i, r)) "
             "end",
         error, limit},
        {"attributes",
         bar + "for i = 1, 1e9 do assert(m:add_attribute{ name = 'a' .. i, domain = 'corner', "
               "width = 4 "
               "}) end",
         error, limit},
        {"parts", bar + keep + "m:extract(m:region{ all = true })) end", error, limit},
        {"cuts", bar + keep + "m:cut{ plane = { point = {0, 0, 0}, normal = {0, 1, 0} } }) end",
         error, limit},
        {"strands", hair + "while true do t[#t + 1] = assert(s:copy()) end", error, limit},
        {"strands appended to themselves", hair + "while true do assert(s:append(s)) end", error,
         limit},
        {"strands of many points", hair + "assert(s:resample{ step = 1e-5 })", error, limit},
        {"points of strands", hair + keep + "s:points()) end", error, "memory"},
        {"history of a scene",
         bar + "local scene = l.scene{ history = 1e12 } scene:add('m', m) "
               "while true do local _, why = scene:step('move', function() "
               "assert(m:transform{ translate = {1, 0, 0} }) end) if why then error(why) end end",
         error, "limit"},
    };
}

// Ways out.
std::vector<HostileScript> ways_out() {
    return {
        {"io", "return io == nil and package.loaded.io == nil", harmless},
        {"files of Lua", "return dofile == nil and loadfile == nil", harmless},
        {"os",
         "return os.execute == nil and os.remove == nil and "
         "os.rename == nil and os.getenv == nil and os.tmpname == nil and "
         "os.setlocale == nil",
         harmless},
        {"end of the process", "os.exit(true, true)", error, "return from the script"},
        {"os that is loaded", "return package.loaded.os.execute == nil and require('os') == os",
         harmless},
        {"debug",
         "return debug.getregistry == nil and debug.sethook == nil and "
         "debug.getupvalue == nil and debug.setmetatable == nil and "
         "debug.getinfo == nil and package.loaded.debug == debug",
         harmless},
        {"package",
         "return package.loadlib == nil and package.cpath == nil and "
         "package.searchers == nil and package.path == '' and "
         "package.searchpath('passwd', '/etc/?') == nil",
         harmless},
        {"search by a path", "package.searchpath('../../etc/passwd')", error,
         "no name of a module"},
        {"tool of the system", "require('lissom').load_tool('/etc/passwd.lua')", error,
         "may not read"},
        {"tool upwards", "require('lissom').load_tool('../../../../../../../../etc/passwd.lua')",
         error, "may not read"},
        {"tool that is none", "require('lissom').load_tool('bend')", error, "there is no tool"},
        {"recording of the system", "require('lissom').replay('/etc/passwd')", error,
         "may not read"},
        {"script in a recording",
         "require('lissom').replay{ version = 1, open = { '/etc/passwd.lua' }, events = {} }",
         error, "may not read"},
        {"scene in a recording",
         "require('lissom').replay{ version = 1, open = { '/etc/passwd.lissom' }, events = {} }",
         error, "may not read"},
        {"tool in a recording",
         "require('lissom').replay{ version = 1, open = {}, events = { { 'tool', '/etc/passwd.lua' "
         "} } "
         "}",
         error, "may not read"},
        {"preload",
         "package.preload = { evil = function() return io end } "
         "return pcall(require, 'evil') == false",
         harmless},
        {"module by a path", "require '../../../etc/passwd'", error, "names like"},
        {"module by an absolute path", "require '/etc/passwd'", error, "names like"},
        {"module by dots", "require '..etc.passwd'", error, "names like"},
        {"module with a zero byte", "require 'a\\0b'", error},
        {"binary chunk", "return load('\\27Lua') == nil", harmless},
        {"binary chunk by its mode", "return load('\\27Lua', 'x', 'b') == nil", harmless},
        {"binary chunk by a reader",
         "local n = 0 return load(function() n = n + 1 if n == 1 then return '\\27Lua' end end, "
         "'x', 'bt') == nil",
         harmless},
        {"string.dump", "return string.dump == nil", harmless},
        {"finalizer", "setmetatable({}, { __gc = function() while true do end end })", error,
         "__gc"},
        {"finalizer set later",
         "local m = {} setmetatable({}, m) m.__gc = function() while true do end end "
         "collectgarbage() return true",
         harmless},
        {"finalizer behind an index",
         "setmetatable({}, setmetatable({}, { __index = { __gc = print } })) collectgarbage() "
         "return true",
         harmless},
        {"collection that is stopped", "collectgarbage('stop')", error, "invalid option"},
        {"collection that never comes", "collectgarbage('setpause', 1e9)", error, "invalid option"},
        {"globals of the library replaced",
         "_G.setmetatable = nil string.find = nil print = nil "
         "return require('lissom').shapes.box():vertex_count() == 8",
         harmless},
        {"metatable of strings replaced",
         "getmetatable('').__index = nil return pcall(function() return ('x').find end) == false",
         harmless},
        {"metatable of a mesh",
         "local l = require('lissom') "
         "for _, x in ipairs{ l.shapes.box(), l.shapes.box():region('top'), l.scene() } do "
         "assert(type(getmetatable(x)) == 'string' and not pcall(setmetatable, x, {})) end "
         "return true",
         harmless},
        {"coroutine that resumes itself",
         "local c c = coroutine.wrap(function() return (('aaa'):gsub('a', function() "
         "local done, why = pcall(c) assert(not done and why:find('non%-suspended')) return 'b' "
         "end)) end) return c() == 'bbb'",
         harmless},
        {"coroutine that resumes itself by its thread",
         "local c c = coroutine.create(function() return (('aaa'):gsub('a', function() "
         "assert(not coroutine.resume(c)) assert(not pcall(coroutine.close, c)) return 'b' end)) "
         "end) return select(2, coroutine.resume(c)) == 'bbb'",
         harmless},
        {"coroutine that resumes the one that resumed it",
         "local a, b a = coroutine.wrap(function() return b() end) "
         "b = coroutine.wrap(function() local done = pcall(a) return done end) "
         "return a() == false",
         harmless},
        {"methods on other things",
         "local m = require('lissom').shapes.box() "
         "for _, x in ipairs{ 1, 'x', {}, print, coroutine.create(print) } do "
         "assert(not pcall(m.vertex_count, x)) end return true",
         harmless},
        {"read a file of the system",
         "return select(2, pcall(function() return require('lissom').load('/etc/passwd') "
         "end)).code == 'file_unreadable'",
         harmless},
        {"read upwards",
         "return select(2, pcall(function() return "
         "require('lissom').load('../../../../../../../../etc/passwd.obj') end)).code == "
         "'file_unreadable'",
         harmless},
        {"ask whether a file is there",
         "local l = require('lissom') local _, a = l.try(l.load, '/etc/passwd.obj') "
         "local _, b = l.try(l.load, '/etc/none.obj') "
         "return a.message:gsub('passwd', 'none') == b.message",
         harmless},
        {"write a file",
         "return select(2, pcall(function() return "
         "require('lissom').shapes.box():save('/tmp/lissom_hostile.obj') end)).code == "
         "'file_write_failed'",
         harmless},
        {"write a scene",
         "return select(2, pcall(function() return "
         "require('lissom').scene():save('/tmp/lissom_hostile') end)).code == "
         "'file_write_failed'",
         harmless},
        {"read strands",
         "return select(2, pcall(function() return require('lissom').load_strands('/etc/passwd') "
         "end)).code == 'file_unreadable'",
         harmless},
        {"parameter that makes a folder",
         "return pcall(require('lissom').params, { out = { type = 'folder', "
         "default = '/tmp/lissom_hostile_folder' } }) == false",
         harmless},
        {"print without end", "while true do print(('x'):rep(1000)) end", error, "written as much"},
        {"print without end in pcall", "while true do pcall(print, ('x'):rep(1000)) end", error,
         "written as much"},
        {"error that is no text",
         "error(setmetatable({}, { __tostring = function() return 1 end }))", error},
        {"error without a value", "error()", error},
        {"yield outside of a coroutine", "coroutine.yield()", error, "outside a coroutine"},
        {"environment of load",
         "local f = load('return io, os', 'x', 't', {}) local a, b = f() return a == nil and "
         "b == nil",
         harmless},
    };
}

}  // namespace

std::vector<HostileScript> hostile_scripts() {
    std::vector<HostileScript> all = endless();
    for (const auto& more : {patterns(), memory(), objects(), ways_out(), hostile_names(),
                             hostile_addresses(), hostile_callbacks(), hostile_keeping()}) {
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
}

}  // namespace lissom::test
