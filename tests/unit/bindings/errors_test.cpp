// Errors across the border between C++ and Lua.
#include "bindings/lua/core/call.h"
#include "bindings/lua/core/error_object.h"
#include "tests/unit/bindings/lua_state.h"

namespace lissom::lua {
namespace {

using test::LuaState;

TEST_CASE("messages count elements from one") {
    const Error one(ErrorCode::out_of_range, "vertex 7 is not there; vertex 70 is",
                    {ElementKind::vertex, 1, {7}});
    CHECK(lua_message(one) == "vertex 8 is not there; vertex 70 is");
    const Error many(ErrorCode::nonmanifold_edge, "edges 0-1 and 2-3 have more than two faces",
                     {ElementKind::edge, 2, {0, 1, 2, 3}});
    CHECK(lua_message(many) == "edges 1-2 and 3-4 have more than two faces");
    const Error apart(ErrorCode::invalid_argument,
                      "no way from vertex 1 to vertex 2, but to vertex 3",
                      {ElementKind::vertex, 2, {1, 2}});
    CHECK(lua_message(apart) == "no way from vertex 2 to vertex 3, but to vertex 3");
    Elements lots{ElementKind::face, 0, {}};
    for (Index i = 0; i < 300; ++i) lots.add(i);
    const Error counted(ErrorCode::face_index, describe(lots) + " are bad", lots);
    CHECK(lua_message(counted) == describe(lots, 1) + " are bad");
    const Error rows(ErrorCode::unconstrained, "row 3", {ElementKind::row, 1, {3}});
    CHECK(lua_message(rows) == "row 3");
}

TEST_CASE("fidelity = thesis works in builds with kernel/thesis, and is refused as unsupported") {
    LuaState lua;
    const std::string shape = "local m = lissom.shapes.grid{} ";
    for (const char* use : {"lissom.deformer(m, { fidelity = 'thesis' })",
                            "lissom.merge(m, m:copy(), { fidelity = 'thesis' })",
                            "lissom.paste{ source = m, target = m:copy(), region = "
                            "m:region{ vertices = { 1, 2, 3 } }, placement = { at = { 0, 0, 0 } }, "
                            "fidelity = 'thesis' }"}) {
        CAPTURE(use);
        const std::string error = lua.run(shape + use);
#ifdef LISSOM_HAS_THESIS
        CHECK(error.find("unsupported") == std::string::npos);
#else
        CHECK(error.find("unsupported") != std::string::npos);
        CHECK(error.find("leave it out") != std::string::npos);
#endif
    }
    CHECK(lua.run("lissom.hairstyle(lissom.shapes.head{}, { fidelity = 'thesis' })") == "");
}

TEST_CASE("a long message is cut, not overrun") {
    Failure failure;
    failure.set(Error(ErrorCode::internal, std::string(10000, 'x')));
    CHECK(std::string(failure.message).size() == sizeof failure.message - 1);
}

int throw_standard(Call& call) {
    return call.attempt([] { throw std::runtime_error("from the standard library"); })
               ? 0
               : call.fail();
}

int throw_number(Call& call) {
    return call.attempt([] { throw 42; }) ? 0 : call.fail();
}

int throw_elements(Call& call) {
    const bool done = call.attempt([] {
        throw Error(ErrorCode::nonmanifold_edge, "edges 0-1 and 4-5",
                    {ElementKind::edge, 2, {0, 1, 4, 5}});
    });
    return done ? 0 : call.fail();
}

// Reports progress and a message, then a value that needs a destructor is alive while it ends.
int work(Call& call) {
    const bool done = call.attempt([&] {
        const std::vector<double> alive(1000, 1.0);
        call.context().log(LogLevel::info, "about to work");
        Progress progress(call.context(), "work");
        for (int i = 0; i < 10; ++i) progress.update(i / 10.0);
        CHECK(alive.size() == 1000);
    });
    return done ? call.push(true) : call.fail();
}

Function described(const std::string& name, Body body) {
    return {.name = name, .body = body, .summary = "For a test.", .example = "-- none"};
}

HostOptions throwing_host() {
    Library library{.name = "test"};
    library.functions = {described("standard", throw_standard), described("number", throw_number),
                         described("elements", throw_elements), described("work", work)};
    auto registry = std::make_shared<Registry>(kernel_registry());
    registry->add(std::move(library));
    HostOptions options;
    options.registry = registry;
    return options;
}

TEST_CASE("no exception leaves a function") {
    LuaState lua(throwing_host());
    CHECK(lua.eval("select(2, pcall(lissom.standard)).message") == "from the standard library");
    CHECK(lua.eval("select(2, pcall(lissom.number)).code") == "internal");
}

TEST_CASE("what fails raises an error object with code, elements and place") {
    LuaState lua(throwing_host());
    CHECK(lua.run("lissom.elements()") == "test:1: edges 1-2 and 5-6 [nonmanifold_edge]");
    REQUIRE(lua.run("_, problem = pcall(function() lissom.elements() end)") == "");
    CHECK(lua.eval("tostring(problem)") == "edges 1-2 and 5-6");
    CHECK(lua.eval("problem.message") == "edges 1-2 and 5-6");
    CHECK(lua.eval("'it says ' .. problem .. '.'") == "it says edges 1-2 and 5-6.");
    CHECK(lua.eval("problem.code") == "nonmanifold_edge");
    CHECK(lua.eval("problem.place") == "test:1");
    CHECK(lua.eval("problem.elements.kind") == "edge");
    CHECK(lua.eval("problem.elements.count") == "2");
    CHECK(lua.eval("problem.elements.ids[2][1]") == "5");
    CHECK(lua.eval("problem == select(2, pcall(error, problem))") == "true");
    CHECK(lua.eval("problem == select(2, pcall(lissom.elements))") == "false");
}

TEST_CASE("an error object can be read back, even where a script has changed it") {
    LuaState lua(throwing_host());
    lua_State* L = lua.get();
    REQUIRE(
        lua.run("_, problem = pcall(lissom.elements) _, spoilt = pcall(lissom.elements) "
                "spoilt.code, spoilt.message, spoilt.elements = 7, {}, { ids = { {}, 'x' } }") ==
        "");
    lua_getglobal(L, "problem");
    REQUIRE(is_error_object(L, -1));
    Failure read;
    read_error(L, -1, read);
    CHECK(read.code == ErrorCode::nonmanifold_edge);
    CHECK(std::string(read.message) == "edges 1-2 and 5-6");
    CHECK(read.kind == ElementKind::edge);
    CHECK(read.count == 2);
    REQUIRE(read.id_count == 4);
    CHECK(read.ids[2] == 4);
    lua_getglobal(L, "spoilt");
    read_error(L, -1, read);
    CHECK(read.code == ErrorCode::internal);
    CHECK(read.id_count == 0);
    CHECK(std::string(push_error_text(L, -1)).find("[internal]") != std::string::npos);
    lua_settop(L, 0);
    CHECK(lua.run("setmetatable(problem, nil)").find("protected") != std::string::npos);
}

TEST_CASE("an error names the file that was read, and its line") {
    LuaState lua;
    CHECK(lua.eval("select(2, pcall(lissom.load, 'none.obj')).file") == "none.obj");
    CHECK(lua.eval("select(2, pcall(lissom.load, 'none.obj')).line") == "nil");
    REQUIRE(lua.run("file = os.tmpname() local f = io.open(file .. '.obj', 'w') "
                    "f:write('v 0 0 0\\nv 1 x 0\\n') f:close() "
                    "_, problem = pcall(lissom.load, file .. '.obj') "
                    "os.remove(file) os.remove(file .. '.obj')") == "");
    CHECK(lua.eval("problem.code") == "file_syntax");
    CHECK(lua.eval("problem.file == file .. '.obj'") == "true");
    CHECK(lua.eval("problem.line") == "2");
}

TEST_CASE("try returns what a function returns, or nil and its error") {
    LuaState lua(throwing_host());
    CHECK(lua.eval("select('#', lissom.try(function(...) return ... end, 1, nil, 3, nil))") == "4");
    CHECK(lua.eval("select('#', lissom.try(function() end))") == "0");
    CHECK(lua.eval("select('#', lissom.try(lissom.elements))") == "2");
    CHECK(lua.eval("lissom.try(lissom.elements)") == "nil");
    CHECK(lua.eval("select(2, lissom.try(lissom.elements)).code") == "nonmanifold_edge");
    CHECK(lua.eval("select(2, lissom.try(error, 'text', 0))") == "text");
    CHECK(lua.eval("select(2, lissom.try(lissom.try)).code") == "invalid_argument");
    CHECK(lua.run("assert(lissom.try(lissom.elements))").find("test:1: edges 1-2 and 5-6") == 0);
}

TEST_CASE("error raises an object at the line that is to be blamed") {
    LuaState lua;
    CHECK(lua.run("\nlissom.error{ message = 'no' }") == "test:2: no [invalid_argument]");
    CHECK(
        lua.run("local function f() lissom.error{ message = 'no', level = 2, code = 'zero_area' } "
                "end\nf()\n") == "test:2: no [zero_area]");
    CHECK(lua.run("lissom.error{ message = 'no', code = 'zero_aria' }").find("zero_area") !=
          std::string::npos);
}

#if LUA_VERSION_NUM >= 504
TEST_CASE("an error passes through coroutines, and try lets its function yield") {
    LuaState lua(throwing_host());
    CHECK(lua.run("local co = coroutine.create(function() lissom.elements() end) "
                  "local done, problem = coroutine.resume(co) "
                  "assert(not done and problem.code == 'nonmanifold_edge') "
                  "local f = coroutine.wrap(function() "
                  "  return lissom.try(function() coroutine.yield(1) lissom.elements() end) end) "
                  "assert(f() == 1) local result, raised = f() "
                  "assert(result == nil and raised.code == 'nonmanifold_edge')") == "");
}
#endif

TEST_CASE("an error in a function of where passes through") {
    LuaState lua;
    CHECK(lua.run("lissom.shapes.box():region{ where = function() error('inside') end }") ==
          "test:1: inside");
    CHECK(lua.eval("select(2, pcall(lissom.shapes.box().region, lissom.shapes.box(), "
                   "{ where = function() error({ code = 3 }) end })).code") == "3");
    CHECK(lua.run("local box = lissom.shapes.box() "
                  "box:region{ where = function() box:close() return true end }")
              .find("must not") != std::string::npos);
    CHECK(lua.run("local box = lissom.shapes.box() box:region{ where = function(i) if i == 8 then "
                  "box:close() end end }")
              .find("must not") != std::string::npos);
    CHECK(lua.run("local box = lissom.shapes.box() box:region{ where = function() box:flip() end }")
              .find("must not") != std::string::npos);
    CHECK(
        lua.eval("#lissom.shapes.box():region{ where = function(i, x, y, z) return y > 0 end }") ==
        "4");
}

TEST_CASE("a listener's error is raised when the operation has unwound") {
    LuaState lua(throwing_host());
    CHECK(lua.run("lissom.listen{ progress = function(label, x) if x > 0.5 then error('stop') end "
                  "end }") == "");
    CHECK(lua.run("lissom.work()") == "test:1: stop");
    CHECK(lua.run("lissom.listen{ progress = function() error({}) end }") == "");
    CHECK(lua.eval("type(select(2, pcall(lissom.work)))") == "table");
    CHECK(lua.run("lissom.listen{}") == "");
    CHECK(lua.eval("lissom.work()") == "true");
}

TEST_CASE("a progress listener cancels by returning false") {
    LuaState lua(throwing_host());
    CHECK(lua.run("lissom.listen{ progress = function(label, x) return x < 0.5 end }") == "");
    CHECK(lua.eval("select(2, pcall(lissom.work)).code") == "cancelled");
    CHECK(lua.run("lissom.listen{}") == "");
    CHECK(lua.eval("lissom.work()") == "true");
}

TEST_CASE("listeners hear everything in order") {
    LuaState lua(throwing_host());
    CHECK(lua.run("heard = {} lissom.listen{ "
                  "progress = function(label, x) heard[#heard + 1] = label .. x end, "
                  "log = function(level, text) heard[#heard + 1] = level .. ' ' .. text end } "
                  "lissom.work()") == "");
    CHECK(lua.eval("heard[#heard]") == "info about to work");
    CHECK(lua.eval("heard[#heard - 1]") == "work0.9");
    CHECK(lua.run("lissom.listen{ log = function() error('log') end } lissom.work()") ==
          "test:1: log");
    CHECK(lua.run("lissom.listen{} lissom.work()") == "");
}

TEST_CASE("a listener cannot call the binding") {
    LuaState lua(throwing_host());
    CHECK(lua.run("box = lissom.shapes.box() "
                  "lissom.listen{ progress = function() box:area() end } lissom.work()")
              .find("a listener cannot call lissom") != std::string::npos);
    CHECK(lua.run("lissom.listen{} "
                  "lissom.listen{ progress = function() box:close() end } lissom.work()")
              .find("a listener cannot close") != std::string::npos);
    CHECK(lua.eval("lissom.listen{} or box:area() > 5") == "true");
}

TEST_CASE("what a listener collects by hand lives until the operation has ended") {
    LuaState lua;
    CHECK(lua.run(
              "sphere = lissom.shapes.sphere() collect, heard = debug.getmetatable(sphere).__gc, 0 "
              "lissom.listen{ progress = function() "
              "  heard = heard + 1 collect(sphere) collectgarbage() "
              "end } "
              "copy = sphere:subdivide(3) lissom.listen{}") == "");
    CHECK(lua.eval("heard > 0") == "true");
    CHECK(lua.eval("copy:vertex_count() > 1000") == "true");
    CHECK(lua.run("sphere:area()").find("closed") != std::string::npos);
}

TEST_CASE("the host's callbacks hear too, and its cancel is sticky") {
    int reports = 0, ends = 0;
    HostOptions options = throwing_host();
    options.context.progress = [&](std::string_view, double) { ++reports; };
    options.operation_ended = [&] { ++ends; };
    LuaState lua(options);
    CHECK(lua.eval("lissom.work()") == "true");
    CHECK(reports > 5);
    CHECK(ends == 1);
    lua.binding().context.cancel();
    CHECK(lua.eval("select(2, pcall(lissom.work)).code") == "cancelled");
    CHECK(lua.eval("select(2, pcall(lissom.work)).code") == "cancelled");
    lua.binding().context.clear_cancel();
    CHECK(lua.eval("lissom.work()") == "true");
}

TEST_CASE("a memory limit of the host is an error with that code") {
    HostOptions options;
    options.context.memory_limit = 1000;
    LuaState lua(options);
    CHECK(lua.eval("select(2, pcall(function() return lissom.shapes.cactus() end)).code") ==
          "memory_limit");
}

}  // namespace
}  // namespace lissom::lua
