// Life of objects: closing, collecting, several states, coroutines.
#include "bindings/lua/mesh/mesh_object.h"
#include "tests/unit/bindings/lua_state.h"

namespace lissom::lua {
namespace {

using test::LuaState;

// Counts, in `live`, the objects that the collector has left.
const char* const kCounting = "live = setmetatable({}, { __mode = 'k' }) ";
const char* const kCount =
    "(function() local n = 0 for _ in pairs(live) do n = n + 1 end return n end)()";

TEST_CASE("objects close once and for all") {
    LuaState lua;
    CHECK(lua.run("mesh = lissom.shapes.box() region = mesh:region('top') "
                  "buffer = mesh:positions() mesh:close() mesh:close()") == "");
    CHECK(lua.eval("tostring(mesh)") == "lissom.Mesh (closed)");
    CHECK(lua.run("mesh:area()") ==
          "test:1: bad argument #1 to 'area' (lissom.Mesh expected, got a closed lissom.Mesh) "
          "[invalid_argument]");
    CHECK(lua.run("return #mesh").find("closed") != std::string::npos);
    CHECK(lua.run("return #region").find("the mesh of the region was closed") != std::string::npos);
    CHECK(lua.run("return buffer[1]").find("the mesh of the buffer was closed") !=
          std::string::npos);
    CHECK(lua.run("region:mesh()").find("the mesh was closed") != std::string::npos);
    CHECK(lua.run("lissom.deformer(mesh)").find("a closed lissom.Mesh") != std::string::npos);
    CHECK(lua.eval("mesh == mesh:close()") == "false");
}

TEST_CASE("a closed deformation frees its handles") {
    LuaState lua;
    CHECK(lua.run("box = lissom.shapes.box() deformer = lissom.deformer(box) "
                  "handle = deformer:add_handle(box:region('top')) deformer:close()") == "");
    CHECK(lua.run("handle:translate(1, 0, 0)").find("[handle_removed]") != std::string::npos);
    CHECK(lua.eval("tostring(handle)") == "lissom.Handle (removed)");
}

#if LUA_VERSION_NUM >= 504
TEST_CASE("a to-be-closed variable closes its object") {
    LuaState lua;
    CHECK(lua.run("do local mesh <close> = lissom.shapes.box() kept = mesh end") == "");
    CHECK(lua.eval("tostring(kept)") == "lissom.Mesh (closed)");
}
#endif

TEST_CASE("dependents keep their mesh alive") {
    LuaState lua;
    CHECK(lua.run("top = lissom.shapes.box():region('top')") == "");
    lua.collect();
    lua.collect();
    CHECK(lua.eval("top:center()[2]") == "0.5");
    CHECK(lua.eval("rawequal(top:mesh(), top:mesh())") == "true");
}

TEST_CASE("the metatable of an object shows its type alone") {
    LuaState lua;
    CHECK(lua.eval("getmetatable(lissom.shapes.box())") == "lissom.Mesh");
    CHECK(lua.run("setmetatable(lissom.shapes.box(), {})") != "");
}

TEST_CASE("finalizers called by hand do no harm") {
    LuaState lua;
    CHECK(lua.run("local mesh = lissom.shapes.box() local gc = debug.getmetatable(mesh).__gc "
                  "gc(mesh) gc(mesh) gc({}) gc(io.stdout) pcall(gc)") == "");
}

TEST_CASE("a metatable that a script has set on an object of another type is an error") {
    LuaState lua;
    CHECK(lua.run("mesh = lissom.shapes.box() region = mesh:region('top') "
                  "area, grow = mesh.area, region.grow "
                  "debug.setmetatable(region, debug.getmetatable(mesh))") == "");
    CHECK(lua.run("region:area()") ==
          "test:1: bad argument #1 to 'area' (lissom.Mesh expected, got lissom.Region) "
          "[invalid_argument]");
    CHECK(lua.run("return #region").find("lissom.Mesh expected") != std::string::npos);
    CHECK(lua.run("lissom.deformer(region)").find("got lissom.Region") != std::string::npos);
    CHECK(lua.run("return region == mesh") == "");
    CHECK(lua.eval("tostring(region)") == "lissom.Mesh");
    // What it is, it still is.
    CHECK(lua.eval("#grow(region):vertices()") == "8");
    CHECK(lua.run("region:close()").find("got userdata") != std::string::npos);
    CHECK(lua.run("region = nil") == "");
    lua.collect();
}

TEST_CASE("our metatables on foreign userdata do no harm") {
    LuaState lua;
    CHECK(lua.run("mesh = lissom.shapes.box() meta = debug.getmetatable(mesh)") == "");
    // A file of Lua's, and one of our own values that is no object.
    lua_newuserdata(lua.get(), 256);
    lua_setglobal(lua.get(), "large");
    lua_newuserdata(lua.get(), 1);
    lua_setglobal(lua.get(), "small");
    for (const char* name : {"large", "small", "io.stdout"}) {
        CAPTURE(name);
        CHECK(lua.run("other = " + std::string(name) +
                      " old = debug.getmetatable(other) debug.setmetatable(other, meta)") == "");
        CHECK(lua.run("other:area()").find("lissom.Mesh expected") != std::string::npos);
        CHECK(lua.run("return #other").find("lissom.Mesh expected") != std::string::npos);
        CHECK(lua.run("other:close()").find("lissom.Mesh expected") != std::string::npos);
        CHECK(lua.run("local s = tostring(other) return other == mesh") == "");
        CHECK(lua.run("meta.__gc(other) debug.setmetatable(other, old) other = nil") == "");
    }
    lua.collect();
    CHECK(lua.eval("mesh:area()") == "6.0");
}

TEST_CASE("an object without its metatable is still what it is") {
    LuaState lua;
    CHECK(lua.run("mesh = lissom.shapes.box() area, meta = mesh.area, debug.getmetatable(mesh) "
                  "debug.setmetatable(mesh, nil)") == "");
    CHECK(lua.eval("area(mesh)") == "6.0");
    // Without one Lua would never free it.
    CHECK(lua.run("debug.setmetatable(mesh, meta)") == "");
}

TEST_CASE("strings with zero bytes are refused, not cut") {
    LuaState lua;
    CHECK(lua.run("lissom.load('a.obj\\0.txt')").find("string without zero bytes expected") !=
          std::string::npos);
    CHECK(lua.run("lissom.shapes.box():save('a.obj\\0.txt')").find("zero bytes") !=
          std::string::npos);
    CHECK(lua.run("lissom.shapes.box():region('top\\0')").find("zero bytes") != std::string::npos);
    CHECK(lua.run("lissom.shapes.box():save('a.obj', { up = 'z\\0' })").find("zero bytes") !=
          std::string::npos);
    CHECK(lua.run("lissom.shapes.box():transform{ rotate = { axis = 'x\\0', angle = 1 } }") != "");
}

TEST_CASE("native memory makes the collector work") {
    LuaState lua;
    // 300 meshes of about 3 MB each, and next to nothing for Lua.
    CHECK(lua.run(std::string(kCounting) +
                  "for i = 1, 300 do "
                  "live[lissom.shapes.grid{ segments = 100 }] = true end") == "");
    CHECK(std::stoi(lua.eval(kCount)) < 30);
}

TEST_CASE("a mesh that grows is charged again") {
    LuaState lua;
    CHECK(lua.run(std::string(kCounting) +
                  "local big = lissom.shapes.grid{ segments = 60 } "
                  "for i = 1, 200 do live[lissom.shapes.box():append(big)] = true end") == "");
    CHECK(std::stoi(lua.eval(kCount)) < 30);
}

TEST_CASE("a stopped collector stays stopped") {
    LuaState lua;
    CHECK(lua.run("collectgarbage('stop') local gone = setmetatable({}, { __gc = function() "
                  "collected = true end }) gone = nil "
                  "for i = 1, 20 do lissom.shapes.grid{ segments = 60 } end") == "");
    CHECK(lua.eval("collected") == "nil");
}

TEST_CASE("two states have nothing in common") {
    LuaState a, b;
    CHECK(a.run("mesh = lissom.shapes.box()") == "");
    CHECK(b.run("mesh = lissom.shapes.torus()") == "");
    CHECK(a.run("lissom.listen{ progress = function() return false end }") == "");
    CHECK(a.eval("select(2, lissom.try(lissom.shapes.cactus, { vertices = 2000 })).code") ==
          "cancelled");
    CHECK(b.eval("lissom.shapes.cactus{ vertices = 2000 } ~= nil") == "true");
    CHECK(a.eval("#mesh") == "8");
    a.binding().context.cancel();
    CHECK(b.eval("#mesh:copy() > 8") == "true");
}

TEST_CASE("coroutines call the binding") {
    LuaState lua;
    CHECK(lua.run(R"(
local box = lissom.shapes.box()
local names = coroutine.wrap(function()
    for _, name in ipairs(box:regions()) do coroutine.yield(#box:region(name), name) end
    box:smoth()
end)
for i = 1, 6 do assert(names() == 4) end
local done, problem = pcall(names)
assert(not done and problem.message:find("did you mean 'smooth'"), problem)
)") == "");
}

TEST_CASE("opening twice gives the same module") {
    LuaState lua;
    open(lua.get(), {});
    lua_setglobal(lua.get(), "again");
    CHECK(lua.eval("rawequal(again, lissom)") == "true");
}

TEST_CASE("an object made in a state outlives its context's operations") {
    // The collector frees objects after the binding's state would be gone, were it not collected
    // last.
    for (int i = 0; i < 10; ++i) {
        LuaState lua;
        CHECK(lua.run("keep = {} for i = 1, 20 do keep[i] = lissom.shapes.box():region('top') end "
                      "deformer = lissom.deformer(keep[1]:mesh())") == "");
    }
}

}  // namespace
}  // namespace lissom::lua
