#include <cmath>
#include <optional>

#include "bindings/lua/core/call.h"
#include "tests/unit/bindings/lua_state.h"

namespace lissom::lua {
namespace {

using test::LuaState;

// Values of every Lua type and of every type of object, none of which a parameter expects
// everywhere.
const char* const kValues[] = {"nil",
                               "true",
                               "-1",
                               "0",
                               "1",
                               "1.5",
                               "1e300",
                               "0/0",
                               "1/0",
                               "\"\"",
                               "\"no folder/text\"",  // a path, too: nothing may be written
                               "{}",
                               "{ 1, 2, 3 }",
                               "{ 1, 2 }",
                               "{ { 1, 2, 3 } }",
                               "{ { 0/0, 1, 2 } }",
                               "{ nothing = 1 }",
                               "{ true }",
                               "{ { true } }",
                               "function() error('called') end",
                               "print",
                               "io.stdout",
                               "coroutine.create(print)",
                               "lissom",
                               "lissom.shapes",
                               "box",
                               "box:region('top')",
                               "closed",
                               "box:positions()",
                               "grid:boundaries()[1]",
                               "deformer",
                               "handle",
                               "params",
                               "strands",
                               "scalp",
                               "style",
                               "curve"};

// Objects of each type to call methods on.
const char* const kSetup = R"(
grid, closed = lissom.shapes.grid(), lissom.shapes.box()
closed:close()
params = lissom.params{ length = { type = "number", default = 1 } }
head = lissom.shapes.sphere{ segments = 8 }
scalp = lissom.scalp(head, { up = "y", front = "z", region = head:region{ all = true } })
style = lissom.hairstyle(head, { scalp = scalp, resolution = 1000 })
-- The style has no curve, or each call of grow would make much hair.
curve = lissom.hairstyle(head, { scalp = scalp, resolution = 1000 }):add_stream{
    points = { { 0, 1, 0 }, { 0, 1.2, 0 } } }
support = curve:support{ camera = lissom.camera{ eye = { 0, 0, 5 } } }
ball = lissom.shapes.sphere{ segments = 2 }
cap, rest = ball:cut{ plane = { point = { 0, 0.1, 0 }, normal = { 0, 1, 0 } } }
pose_space = lissom.pose_space{ rest = ball, poses = {
    grown = ball:copy():transform{ scale = 2 } } }
merger = lissom.merger{
    joins = { { source = cap:boundaries()[1], target = rest:boundaries()[1] } } }
provenance = select(2, merger:solve()).provenance
local globe = lissom.shapes.sphere{ segments = 8 }
paste = lissom.paste{ source = globe, target = globe:copy(), placement = { at = { 0, 1, 0 }, scale = 0.5 },
    region = globe:region{ plane = { point = { 0, 0, 0 }, normal = { 0, 1, 0 } } } }
local tuft = lissom.strands{ counts = { 2, 2, 2, 2 }, points = { { 0, 0, 0 }, { 0, 1, 0 }, { 0.1, 0, 0 }, { 0.1, 1, 0 },
    { 0, 0, 0.1 }, { 0, 1, 0.1 }, { 0.1, 0, 0.1 }, { 0.1, 1, 0.1 } } }
guides, cards = tuft:guide_set{ count = 3 }, tuft:cards{ count = 2 }
dynamics = guides:dynamics{}
local planted = lissom.hairstyle(head, { scalp = scalp, resolution = 1000 })
planted:add_stream{ points = { { 0, 1, 0 }, { 0, 1.2, 0 } } }
follower = planted:grow{ count = 3, length = 0.1 }:follower{}
local eye = lissom.camera{ eye = { 0, 0, 5 } }
lissom.tool_host{ scene = lissom.scene{}, camera = eye, tool = lissom.tool{ name = "draws",
    draw = function(_, given) view = given end } }:draw()
-- What calls may change is made anew after fresh(), when it is first asked for.
local makers = {
    box = lissom.shapes.box,
    deformer = function() return lissom.deformer(box) end,
    handle = function() return deformer:add_handle(box:region("top")) end,
    bones = function()
        return lissom.deformer(lissom.shapes.bar{ across = 2, along = 10 }):add_bones{
            joints = { { 0, -1.5, 0 }, { 0, 1.5, 0 } } }
    end,
    strands = function() return lissom.strands{ points = { { 0, 0, 0 }, { 0, 1, 0 } }, counts = { 2 } } end,
    scene = function()
        local scene = lissom.scene{}
        scene:add("box", box)
        return scene
    end,
    camera = function() return lissom.camera{ eye = { 0, 0, 5 } } end,
    gizmo = function()
        local gizmo = lissom.gizmo{}
        gizmo:begin("move-x", camera, 100, 50, 50)
        return gizmo
    end,
}
local function made(table, key)
    local maker = makers[key]
    if not maker then return nil end
    rawset(table, key, maker())
    return rawget(table, key)
end
local named = {
    ["lissom.Mesh"] = function() return box end,
    ["lissom.Region"] = function() return box:region("top") end,
    ["lissom.Path"] = function() return grid:boundaries()[1] end,
    ["lissom.Buffer"] = function() return box:positions() end,
    ["lissom.Deformer"] = function() return deformer end,
    ["lissom.Handle"] = function() return handle end,
    ["lissom.Bones"] = function() return bones end,
    ["lissom.Strands"] = function() return strands end,
    ["lissom.Pose"] = function() return deformer:pose() end,
    ["lissom.Scene"] = function() return scene end,
    ["lissom.Camera"] = function() return camera end,
    ["lissom.Gizmo"] = function() return gizmo end,
    ["lissom.Polyline"] = function()
        return lissom.polyline{ points = { { 0, 0, 0 }, { 0, 1, 0 } } }
    end,
}
local lasting = {
    ["lissom.Params"] = params, ["lissom.Scalp"] = scalp, ["lissom.Hairstyle"] = style,
    ["lissom.Curve"] = curve, ["lissom.Merger"] = merger, ["lissom.Provenance"] = provenance,
    ["lissom.Paste"] = paste, ["lissom.GuideSet"] = guides, ["lissom.Cards"] = cards,
    ["lissom.StrandFollower"] = follower, ["lissom.PoseSpace"] = pose_space,
    ["lissom.HairDynamics"] = dynamics,
    ["lissom.Support"] = support, ["lissom.ToolView"] = view,
}
objects = setmetatable({}, { __index = function(_, name)
    return named[name] and named[name]() or lasting[name]
end })
setmetatable(_G, { __index = made })
function fresh()
    for name in pairs(makers) do rawset(_G, name, nil) end
end
)";

std::string call_of(const Entry& entry, const std::string& arguments) {
    if (!entry.type) return "return pcall(lissom." + entry.function->name + ", " + arguments + ")";
    return "local object = objects['" + entry.type->name + "'] return pcall(object." +
           entry.function->name + ", object, " + arguments + ")";
}

// An option table with one key, which may be in nested tables: "handles.rotate.axis". Those of a
// list of tables stand in its first one.
std::string option_text(const Entry& entry, const Entry::Slot& slot, const std::string& value) {
    const std::size_t dot = slot.path.rfind('.');
    const std::string key = slot.path.substr(dot == std::string::npos ? 0 : dot + 1);
    const std::string table = "{ " + key + " = " + value + " }";
    if (dot == std::string::npos) return table;
    for (const Entry::Slot& outer : entry.slots) {
        if (outer.path != slot.path.substr(0, dot)) continue;
        const bool is_list = outer.parameter->kind == Kind::option_list;
        return option_text(entry, outer, is_list ? "{ " + table + " }" : table);
    }
    return table;
}

// Lists with `value` that are as long as the function reads, and one beyond.
std::vector<std::string> argument_lists(const Function& function, const std::string& value) {
    const std::size_t read = function.arguments.size() + (function.options.empty() ? 0 : 1);
    if (read < 2) return {value, value + ", " + value};
    const std::string two = value + ", " + value;
    return {value, two, two + ", " + two, "1, " + value, "'no folder/text', " + value};
}

TEST_CASE("a method called with a dot is told of the colon") {
    test::LuaState lua;
    const std::string message = lua.run("local m = lissom.shapes.box() m.smooth{ iterations = 1 }");
    CHECK(
        message ==
        "test:1: bad argument #1 to 'smooth' (lissom.Mesh expected, got table; write mesh:smooth, "
        "not mesh.smooth) [invalid_argument]");
    CHECK(lua.run("lissom.shapes.box().area()")
              .find("got no value; write mesh:area, not mesh.area") != std::string::npos);
    CHECK(lua.run("lissom.shapes.box().area(nil)").find("write") == std::string::npos);
}

TEST_CASE("no function crashes on arguments of any type") {
    const Registry registry = kernel_registry();
    // What calls leave in long-lived objects, curves above all, does not pile up.
    constexpr int kFunctionsOfState = 8;
    std::optional<LuaState> state;
    int called = 0;
    for (const auto& entry : registry.entries()) {
        CAPTURE(entry->function->name);
        if (called++ % kFunctionsOfState == 0) REQUIRE(state.emplace().run(kSetup) == "");
        LuaState& lua = *state;
        for (const char* value : kValues) {
            CAPTURE(value);
            const std::string v = value;
            for (const std::string& arguments : argument_lists(*entry->function, v)) {
                CHECK(lua.run("fresh() " + call_of(*entry, arguments)) == "");
            }
            for (const Entry::Slot& slot : entry->slots) {
                if (slot.parameter == nullptr) continue;
                CHECK(lua.run("fresh() " + call_of(*entry, option_text(*entry, slot, v))) == "");
            }
        }
    }
}

// Of what is called with bad values: nothing returns nil and a message, and what is raised by the
// library is an error object. A function that was given may raise what it likes.
TEST_CASE("every failure is raised as an object with a code, none is returned") {
    const Registry registry = kernel_registry();
    LuaState lua;
    REQUIRE(lua.run(kSetup) == "");
    REQUIRE(lua.run("function look(done, first, second, third) "
                    "  if done then return not (first == nil and type(second) == 'string') end "
                    "  return type(first) == 'table' and type(first.code) == 'string' and "
                    "    type(first.message) == 'string' and #first.message > 3 end") == "");
    for (const auto& entry : registry.entries()) {
        const std::string& name = entry->function->name;
        if (name == "try" || name == "listen") continue;
        for (const char* arguments :
             {"", "nil", "'no/such/file.x'", "-1e9", "{}", "{ nonsense = 1 }", "0 / 0",
              "print, print", "'no/such/file.x', {}", "true"}) {
            CAPTURE(name);
            CAPTURE(arguments);
            const std::string given = *arguments ? arguments : "nil";
            CHECK(lua.run("fresh() local function call() " + call_of(*entry, given) +
                          " end local done, first, second = call() "
                          "assert(look(done, first, second), tostring(first))") == "");
        }
    }
}

TEST_CASE("every method refuses another object") {
    const Registry registry = kernel_registry();
    LuaState lua;
    REQUIRE(lua.run(kSetup) == "");
    REQUIRE(lua.run("fresh()") == "");
    for (const auto& entry : registry.entries()) {
        if (!entry->type) continue;
        const std::string method = "objects['" + entry->type->name + "']." + entry->function->name;
        const std::string expected = "test:1: bad argument #1 to '" + entry->function->name +
                                     "' (" + entry->type->name +
                                     " expected, got nil) [invalid_argument]";
        CHECK(lua.eval("select(2, pcall(" + method + ", nil))") == expected);
        for (const char* other : {"1", "{}", "io.stdout", "print", "closed"}) {
            CAPTURE(other);
            CHECK(lua.eval("pcall(" + method + ", " + other + ")") == "false");
        }
    }
}

// A function with a parameter of every kind, whose body says what it read.
int describe(Call& call) {
    lua_State* L = call.lua();
    lua_newtable(L);
    const auto put = [&](const char* name, int pushed) { call.set_field(name, pushed); };
    if (call.has("flag")) put("flag", call.push(call.boolean("flag")));
    if (call.has("count")) put("count", call.push(call.integer("count")));
    if (call.has("length")) put("length", call.push(call.number("length")));
    if (call.has("mode")) put("mode", call.push(call.integer("mode")));
    if (call.has("id")) put("id", call.push(call.id("id")));
    if (call.has("scale")) put("scale", call.push_vector(call.vector("scale")));
    if (call.has("axis")) put("axis", call.push_vector(call.vector("axis")));
    if (call.has("ids")) put("ids", call.push(static_cast<int>(call.ids("ids").back())));
    if (call.has("lists")) put("lists", call.push(static_cast<int>(call.id_lists("lists").ids[3])));
    if (call.has("points")) put("points", call.push_vector(call.points("points")[1]));
    if (call.has("matrix")) put("matrix", call.push_affine(call.affine("matrix")));
    if (call.has("inner.deep")) put("deep", call.push(call.number("inner.deep")));
    if (call.has("names")) put("names", call.push(call.strings("names")[0]));
    return 1;
}

HostOptions described_host() {
    Library library{.name = "test"};
    library.functions = {
        {.name = "describe",
         .body = describe,
         .summary = "Reads a parameter of every kind.",
         .options = {boolean("flag", "f").defaults(true),
                     integer("count", "c").defaults(3).between(0, 10),
                     number("length", "l").optional().above(0),
                     choice("mode", {"soft", "crisp"}, "m").defaults("crisp"),
                     id("id", "i").optional(), factors("scale", "s").optional(),
                     axis("axis", "a").optional(), ids("ids", "ids").optional(),
                     id_lists("lists", "lists").optional(), points("points", "points").optional(),
                     affine("matrix", "matrix").optional(),
                     options("inner", {number("deep", "d")}, "inner").optional(),
                     strings("names", "names").optional()},
         .example = "lissom.describe()"}};
    auto registry = std::make_shared<Registry>(kernel_registry());
    registry->add(std::move(library));
    HostOptions options;
    options.registry = registry;
    return options;
}

TEST_CASE("values are read and defaults filled in") {
    LuaState lua(described_host());
    CHECK(lua.eval("lissom.describe().count") == "3");
    CHECK(lua.eval("lissom.describe().mode") == "1");
    CHECK(lua.eval("lissom.describe().flag") == "true");
    CHECK(lua.eval("lissom.describe().length") == "nil");
    CHECK(lua.eval("lissom.describe{ mode = 'soft' }.mode") == "0");
    CHECK(lua.eval("lissom.describe{ count = 4.0 }.count") == "4");
    CHECK(lua.eval("lissom.describe{ id = 7 }.id") == "6");
    CHECK(lua.eval("lissom.describe{ scale = 2 }.scale[3]") == "2.0");
    CHECK(lua.eval("lissom.describe{ scale = { 1, 2, 3 } }.scale[3]") == "3.0");
    CHECK(lua.eval("lissom.describe{ axis = 'y' }.axis[2]") == "1.0");
    CHECK(lua.eval("lissom.describe{ ids = { 4, 5 } }.ids") == "4");
    CHECK(lua.eval("lissom.describe{ lists = { { 1, 2, 3 }, { 8 } } }.lists") == "7");
    CHECK(lua.eval("lissom.describe{ points = { { 1, 2, 3 }, { 4, 5, 6 } } }.points[2]") == "5.0");
    CHECK(lua.eval("lissom.describe{ inner = { deep = 2 } }.deep") == "2.0");
    CHECK(lua.eval("lissom.describe{ names = { 'a', 'b' } }.names") == "a");
    CHECK(lua.eval("lissom.describe{ matrix = { { 1, 0, 0, 5 }, { 0, 1, 0, 6 }, { 0, 0, 1, 7 }, "
                   "{ 0, 0, 0, 1 } } }.matrix[2][4]") == "6.0");
}

TEST_CASE("what does not fit is named with what is expected") {
    LuaState lua(described_host());
    const auto refuses = [&](const std::string& options, const std::string& message) {
        CHECK(lua.run("lissom.describe{ " + options + " }") ==
              "test:1: " + message + " [invalid_argument]");
    };
    refuses("count = 11",
            "bad option 'count' of 'describe' (integer from 0 to 10 expected, got 11)");
    refuses("count = '3'",
            "bad option 'count' of 'describe' (integer from 0 to 10 expected, got \"3\")");
    refuses("length = 0",
            "bad option 'length' of 'describe' (finite number above 0 expected, got 0)");
    refuses("length = 1/0",
            "bad option 'length' of 'describe' (finite number above 0 expected, got inf)");
    refuses("mode = 'sofd'",
            "bad option 'mode' of 'describe' (\"soft\" or \"crisp\" expected, got "
            "\"sofd\", did you mean \"soft\"?)");
    refuses("id = 0", "bad option 'id' of 'describe' (id from 1 expected, got 0)");
    refuses("ids = { 1, 'a' }",
            "bad option 'ids' of 'describe' (list of ids expected at [2], got \"a\")");
    refuses("axis = { 0, 0, 0 }",
            "bad option 'axis' of 'describe' (\"x\", \"-y\", ... or {x, y, z} "
            "with a length expected, got table)");
    refuses("inner = { }", "missing option 'inner.deep' of 'describe' (finite number)");
    refuses("inner = { depe = 1 }",
            "unknown option 'inner.depe' of 'describe', did you mean 'deep'?");
    refuses("cuont = 1", "unknown option 'cuont' of 'describe', did you mean 'count'?");
    refuses("5",
            "unknown option '1' of 'describe'; there is: flag, count, length, mode, id, scale, "
            "axis, ids, lists, points, matrix, inner, names");
    refuses(
        "matrix = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 1, 1 } }",
        "bad option 'matrix' of 'describe' (4 rows of 4 numbers, the last 0, 0, 0, 1 expected, got "
        "table)");
}

TEST_CASE("an argument that is missing after a list has no value") {
    test::LuaState lua;
    const char* const bar =
        "local bar = lissom.shapes.bar{} local d = lissom.deformer(bar) "
        "local h = d:add_handle(bar:region{ vertices = { 1 } }) ";
    CHECK(lua.run((bar + std::string("h:follow{ { 0, 0, 0 }, { 0, 1, 0 } }")).c_str()) ==
          "test:1: bad argument #2 to 'follow' (finite number expected, got no value) "
          "[invalid_argument]");
}

TEST_CASE("arguments by position") {
    LuaState lua;
    CHECK(lua.run("lissom.load()") ==
          "test:1: bad argument #1 to 'load' (string expected, got no value) [invalid_argument]");
    CHECK(
        lua.run("lissom.load('a', 5)") ==
        "test:1: bad argument #2 to 'load' (table of options expected, got 5) [invalid_argument]");
    CHECK(
        lua.run("lissom.load('a', 5, 6)") ==
        "test:1: bad argument #2 to 'load' (table of options expected, got 5) [invalid_argument]");
    CHECK(lua.run("lissom.load('a', {}, 5)") ==
          "test:1: bad argument #3 to 'load' (no further argument expected, got 5) "
          "[invalid_argument]");
    CHECK(lua.run("lissom.shapes.box():subdivide{ scheme = 'loop' }") == "");
    CHECK(lua.run("lissom.shapes.box():set_position(1, 2, 'x', 3)") ==
          "test:1: bad argument #3 to 'set_position' ({x, y, z} expected, got \"x\") "
          "[invalid_argument]");
    CHECK(lua.run("lissom.shapes.box():position(9)") ==
          "test:1: vertex 9 is not one of the 8 of the mesh [out_of_range]");
}

TEST_CASE("work that comes later is an unknown name") {
    LuaState lua;
    CHECK(lua.run("lissom.shapes.box():paste()").find("no method 'paste'") != std::string::npos);
}

}  // namespace
}  // namespace lissom::lua
