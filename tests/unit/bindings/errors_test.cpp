// Errors across the border between C++ and Lua.
#include "bindings/lua/core/call.h"
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
    CHECK(lua.eval("select(2, lissom.standard())") == "from the standard library");
    CHECK(lua.eval("select(3, lissom.number())") == "internal");
}

TEST_CASE("the world's faults come with elements") {
    LuaState lua(throwing_host());
    CHECK(lua.eval("lissom.elements()") == "nil");
    CHECK(lua.eval("select(2, lissom.elements())") == "edges 1-2 and 5-6");
    CHECK(lua.eval("select(3, lissom.elements())") == "nonmanifold_edge");
    CHECK(lua.eval("select(4, lissom.elements()).kind") == "edge");
    CHECK(lua.eval("select(4, lissom.elements()).ids[2][1]") == "5");
    const State& state = lua.binding();
    CHECK(state.has_failed);
    CHECK(std::string(state.last_failure_place) == "test:1: ");
}

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
    CHECK(lua.eval("select(3, lissom.work())") == "cancelled");
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
    CHECK(lua.run("sphere = lissom.shapes.sphere() collect, heard = getmetatable(sphere).__gc, 0 "
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
    CHECK(lua.eval("select(3, lissom.work())") == "cancelled");
    CHECK(lua.eval("select(3, lissom.work())") == "cancelled");
    lua.binding().context.clear_cancel();
    CHECK(lua.eval("lissom.work()") == "true");
}

TEST_CASE("a memory limit of the host is a fault of the world") {
    HostOptions options;
    options.context.memory_limit = 1000;
    LuaState lua(options);
    CHECK(lua.eval("select(3, lissom.shapes.cactus())") == "memory_limit");
}

}  // namespace
}  // namespace lissom::lua
