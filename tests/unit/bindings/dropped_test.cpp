// Failures that nobody looked at.
#include "bindings/lua/core/state.h"
#include "tests/unit/bindings/lua_state.h"

namespace lissom::lua {
namespace {

using test::LuaState;

// How many failures `code` drops; it must not end with an error.
std::size_t dropped_by(const std::string& code) {
    LuaState lua;
    CHECK_MESSAGE(lua.run(code) == "", code);
    return lua.binding().dropped_count;
}

TEST_CASE("a failure is dropped where the call is a statement") {
    CHECK(dropped_by("lissom.load('none.obj')") == 1);
    CHECK(dropped_by("local box = lissom.shapes.box() box:save('no/folder.obj')") == 1);
    CHECK(dropped_by("for i = 1, 5 do lissom.load('none.obj') end") == 5);
    CHECK(dropped_by("lissom.load\n(\n'none.obj'\n)\n") == 1);
    CHECK(dropped_by("local f = function() lissom.load('none.obj') end f()") == 1);
    CHECK(dropped_by("(lissom or 0).load(('none.%s'):format('obj'))") == 1);
    CHECK(dropped_by("coroutine.wrap(function() lissom.load('none.obj') end)()") == 1);
    CHECK(dropped_by("local t = { lissom.load } t[1]('none.obj')") == 1);
}

TEST_CASE("a failure is dropped where it is returned and the caller drops it") {
    CHECK(dropped_by("local function save(p) return lissom.load(p) end save('none.obj')") == 1);
    CHECK(dropped_by("local function a(p) return lissom.load(p) end "
                     "local function b(p) return a(p) end b('none.obj')") == 1);
    CHECK(dropped_by("local function save(p) return lissom.load(p) end "
                     "local ok = save('none.obj')") == 0);
    CHECK(dropped_by("local function save(p) return lissom.load(p) end "
                     "if save('none.obj') then error('no') end") == 0);
}

TEST_CASE("a failure that is taken is no false alarm") {
    for (const char* code :
         {"local mesh = lissom.load('none.obj')",
          "local _ = lissom.load('none.obj')",
          "local mesh, message = lissom.load('none.obj')",
          "mesh = lissom.load('none.obj')",
          "if lissom.load('none.obj') then end",
          "if not lissom.load('none.obj') then end",
          "while lissom.load('none.obj') do end",
          "repeat until not lissom.load('none.obj')",
          "local x = lissom.load('none.obj') or 5",
          "local t = { lissom.load('none.obj') }",
          "local t = {} t[1] = lissom.load('none.obj')",
          "tostring(lissom.load('none.obj'))",
          "pcall(assert, lissom.load('none.obj'))",
          "pcall(lissom.load, 'none.obj')",
          "select('#', lissom.load('none.obj'))",
          "assert(lissom.load('none.obj') == nil)",
          "(function(...) end)(lissom.load('none.obj'))",
          "return lissom.load('none.obj')",
          "local function f(...) return ... end f(lissom.load('none.obj'))",
          "local x = lissom.load('none.obj'); local y = lissom.load('none.obj')",
          "for _, m in ipairs{ lissom.load('none.obj') } do end",
          "local t = setmetatable({}, { __index = function(_, k) return lissom.load(k) end }) "
          "local v = t['none.obj']"}) {
        CHECK_MESSAGE(dropped_by(code) == 0, code);
    }
}

// On one line, in one register: the second is taken.
TEST_CASE("where a line leaves it open a failure counts as taken") {
    CHECK(dropped_by("lissom.load('none.obj') local x = lissom.load('none.obj')") == 0);
    CHECK(dropped_by("lissom.load('none.obj')\nlocal x = lissom.load('none.obj')") == 1);
    CHECK(dropped_by("do local a, b lissom.load('none.obj') end "
                     "local x = lissom.load('none.obj')") == 1);
}

TEST_CASE("long functions, functions in functions and stripped code are understood") {
    std::string code = "local t = {}\n";
    for (int i = 0; i < 400; ++i) {
        code += "t[" + std::to_string(i) + "] = function() return '" + std::string(100, 'x') +
                "', 1.5, -7, true end\n\n";
    }
    CHECK(dropped_by(code + "lissom.load('none.obj')\nlocal x = lissom.load('none.obj')") == 1);
    CHECK(dropped_by(std::string(300, '\n') + "lissom.load('none.obj')") == 1);
    CHECK(dropped_by("load(string.dump(function() lissom.load('none.obj') end, true))()") == 0);
}

TEST_CASE("a dropped failure is told with file and line, by the log") {
    std::vector<std::string> told;
    HostOptions options;
    options.context.log = [&](LogLevel level, std::string_view text) {
        if (level == LogLevel::warning) told.emplace_back(text);
    };
    LuaState lua(options);
    CHECK(lua.run("\nlissom.load('none.obj')") == "");
    REQUIRE(told.size() == 1);
    CHECK(told[0].find("test:2: none.obj: there is no such file") == 0);
    CHECK(told[0].find("[file_not_found]") != std::string::npos);
    CHECK(lua.eval("lissom.failures()[1].place") == "test:2: ");
    CHECK(lua.run("heard = 0 lissom.listen{ log = function() heard = heard + 1 end }\n"
                  "lissom.load('none.obj')") == "");
    CHECK(lua.eval("heard") == "1");
}

TEST_CASE("a failure dropped a thousand times costs no more memory") {
    LuaState lua;
    CHECK(lua.run("for i = 1, 1000 do lissom.load('none.obj') end") == "");
    CHECK(lua.binding().dropped_count == 1000);
    CHECK(lua.binding().dropped.size() == 100);
}

}  // namespace
}  // namespace lissom::lua
