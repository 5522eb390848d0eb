#include "bindings/cli/repl/completion.h"

#include <algorithm>

#include "tests/unit/bindings/lua_state.h"

namespace lissom::cli {
namespace {

using test::LuaState;

std::vector<std::string> words(LuaState& lua, const std::string& text) {
    const int top = lua_gettop(lua.get());
    const Completions found = completions(lua.get(), text);
    CHECK_MESSAGE(lua_gettop(lua.get()) == top, text);
    for (const std::string& word : found.words) {
        CHECK_MESSAGE(word.compare(0, text.size() - found.begin, text.substr(found.begin)) == 0,
                      word);
    }
    return found.words;
}

bool offers(LuaState& lua, const std::string& text, const std::string& word) {
    const std::vector<std::string> list = words(lua, text);
    return std::find(list.begin(), list.end(), word) != list.end();
}

using Words = std::vector<std::string>;

TEST_CASE("names of variables, of the module and of its tables complete") {
    LuaState lua;
    CHECK(lua.run("my_mesh = 5 settings = { depth = { left = 1, list = 2 } }") == "");
    CHECK(words(lua, "lis") == Words{"lissom"});
    CHECK(words(lua, "print(my_") == Words{"my_mesh"});
    CHECK(words(lua, "settings.depth.l") == Words{"left", "list"});
    CHECK(words(lua, "settings . depth . li") == Words{"list"});
    CHECK(words(lua, "lissom.shapes.cac") == Words{"cactus"});
    CHECK(offers(lua, "lissom.", "load"));
    CHECK(words(lua, "whi") == Words{"while"});
    CHECK(words(lua, "nothing.a") == Words{});
}

TEST_CASE("methods complete behind a colon, of variables and of what functions return") {
    LuaState lua;
    CHECK(lua.run("mesh = lissom.shapes.box() list = { mesh = mesh }") == "");
    CHECK(words(lua, "mesh:vertex_c") == Words{"vertex_count"});
    CHECK(words(lua, "list.mesh:vertex_c") == Words{"vertex_count"});
    CHECK(words(lua, "lissom.shapes.box():vertex_c") == Words{"vertex_count"});
    CHECK(words(lua, "lissom.shapes.box{ size = 2 }:copy():vertex_c") == Words{"vertex_count"});
    CHECK(offers(lua, "lissom.shapes.box(\"){\"):", "close"));
    CHECK(words(lua, "mesh.vertex_c") == Words{});
    CHECK(words(lua, "print():vertex_c") == Words{});
    CHECK(words(lua, "mesh:nothing():vertex_c") == Words{});
}

TEST_CASE("options complete where a key may stand, also of tables in tables") {
    LuaState lua;
    CHECK(lua.run("mesh = lissom.shapes.box()") == "");
    CHECK(words(lua, "lissom.shapes.cactus{ vert") == Words{"vertices = "});
    CHECK(words(lua, "lissom.shapes.cactus{ ribs = 3, vert") == Words{"vertices = "});
    CHECK(words(lua, "lissom.load(\"a.obj\", { rep") == Words{"repair = "});
    CHECK(offers(lua, "mesh:region{ ", "sphere = "));
    CHECK(words(lua, "mesh:region{ sphere = { cen") == Words{"center = "});
    CHECK(words(lua, "lissom.shapes.cactus{ vertices = lis") == Words{"lissom"});
    CHECK(offers(lua, "local t = { ", "lissom"));
}

TEST_CASE("inside a string a file may be meant") {
    LuaState lua;
    CHECK(completions(lua.get(), "lissom.load(\"mod").in_string);
    CHECK(completions(lua.get(), "lissom.load('mod").in_string);
    CHECK(!completions(lua.get(), "lissom.load(\"mod\\\"\")").in_string);
    CHECK(words(lua, "\"a.obj\" lis") == Words{"lissom"});
}

TEST_CASE("completion runs nothing") {
    LuaState lua;
    CHECK(lua.run("trap = setmetatable({}, { __index = function() error('run') end, "
                  "__pairs = function() error('run') end })") == "");
    CHECK(words(lua, "trap.x") == Words{});
    CHECK(words(lua, "trap.x.y:z") == Words{});
    for (const char* text : {"", ".", ":", "(", "{", "}", ")", "):", "}:", "a..b", "--x", "'", "[[",
                             "f(){", "((((", "}}}}", "x={{{", "f{,"}) {
        CAPTURE(text);
        completions(lua.get(), text);
    }
}

}  // namespace
}  // namespace lissom::cli
