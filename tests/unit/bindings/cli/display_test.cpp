#include "bindings/cli/repl/display.h"

#include "tests/unit/bindings/lua_state.h"

namespace lissom::cli {
namespace {

std::string shown(const std::string& expression) {
    test::LuaState lua;
    lua_State* L = lua.get();
    const std::string code = "return " + expression;
    REQUIRE(luaL_loadstring(L, code.c_str()) == 0);
    REQUIRE(lua_pcall(L, 0, 1, 0) == 0);
    const std::string text = display(L, -1);
    CHECK(lua_gettop(L) == 1);
    return text;
}

TEST_CASE("plain values are shown as print shows them") {
    CHECK(shown("5") == "5");
    CHECK(shown("'a b'") == "a b");
    CHECK(shown("nil") == "nil");
    CHECK(shown("true") == "true");
    CHECK(shown("lissom.load") == "function lissom.load");
    CHECK(shown("lissom.shapes.box().area") == "function lissom.Mesh:area");
}

TEST_CASE("tables are shown with their fields") {
    CHECK(shown("{}") == "{}");
    CHECK(shown("{1, 'a', true}") == "{ 1, \"a\", true }");
    CHECK(shown("{x = 1, ['a b'] = { 2 }, [7] = 3}") == "{ [\"a b\"] = { 2 }, [7] = 3, x = 1 }");
    CHECK(shown("lissom.shapes.box():bounds().min") == "{ -0.5, -0.5, -0.5 }");
    CHECK(shown("(function() local t = {} for i = 1, 500 do t[i] = i end return t end)()") ==
          "{ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, ... (# = 500) }");
    const std::string wide = shown("{ a = ('x'):rep(50), b = ('y'):rep(50) }");
    CHECK(wide ==
          "{\n  a = \"" + std::string(50, 'x') + "\",\n  b = \"" + std::string(50, 'y') + "\"\n}");
}

TEST_CASE("a table within itself ends") {
    CHECK(shown("(function() local t = {} t.t = t return t end)()") == "{ t = {...} }");
    CHECK(shown("{{{{{{1}}}}}}") == "{ { { { {...} } } } }");
}

TEST_CASE("objects are shown with counts and bounds") {
    CHECK(shown("lissom.shapes.box()").find("lissom.Mesh: 8 vertices") == 0);
    const std::string region = shown("lissom.shapes.box():region{ all = true }");
    CHECK(region.find("lissom.Region: 8 of 8 vertices\n  bounds: {") == 0);
    CHECK(shown("{ lissom.shapes.box() }").find("{ lissom.Mesh: 8 vertices") == 0);
    CHECK(shown("(function() local m = lissom.shapes.box() m:close() return m end)()") ==
          "lissom.Mesh (closed)");
}

TEST_CASE("what cannot be shown does not stop the prompt") {
    CHECK(shown("setmetatable({}, { __tostring = function() error('no') end })") == "a table");
    CHECK(shown("setmetatable({}, { __tostring = function() return 'mine' end })") == "mine");
}

}  // namespace
}  // namespace lissom::cli
