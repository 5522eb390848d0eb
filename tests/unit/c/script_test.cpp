#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/c/host.h"

namespace lissom::test {
namespace {

using Json = nlohmann::json;

Json parsed(const lissom_bytes& bytes) {
    return Json::parse(std::string(static_cast<const char*>(bytes.data), bytes.size));
}

Json call(const Host& host, const char* name, const Json& arguments) {
    lissom_bytes bytes{};
    const auto status = lissom_call(host, name, arguments.dump().c_str(), &bytes);
    CAPTURE(host.message());
    REQUIRE(status == LISSOM_OK);
    return parsed(bytes);
}

Json object(std::uint64_t id) {
    return Json{{"object", id}};
}

lissom_script load(const Host& host, const std::string& text) {
    lissom_script script{};
    const auto status = lissom_script_load(host, text.data(), text.size(), "tool.lua", &script);
    CAPTURE(host.message());
    REQUIRE(status == LISSOM_OK);
    return script;
}

lissom_status run(const Host& host, const std::string& text) {
    return lissom_script_run(host, load(host, text), nullptr, nullptr);
}

}  // namespace

TEST_CASE("calls by name share objects with the functions of C") {
    const Host host;
    CHECK(lissom_has_scripts());
    const Json made = call(host, "shapes.box", Json::array());
    REQUIRE(made.size() == 1);
    CHECK(made[0]["type"] == "lissom.Mesh");
    const lissom_mesh mesh{made[0]["object"].get<std::uint64_t>()};
    CHECK(lissom_mesh_vertex_count(host, mesh) == 8);
    const Json finer = call(host, "Mesh.subdivide", {object(mesh.id), 1});
    CHECK(lissom_mesh_vertex_count(host, {finer[0]["object"].get<std::uint64_t>()}) == 26);
    // A mesh of C in Lua: changed in place, and told by its own handle.
    const lissom_mesh own = host.add(make_box({}));
    const Json same = call(host, "Mesh.transform", {object(own.id), {{"translate", {1, 2, 3}}}});
    CHECK(same[0]["object"].get<std::uint64_t>() == own.id);
    CHECK(host.positions(own)[0].x() == doctest::Approx(make_box({}).position(0).x() + 1));
    const Json point = call(host, "Mesh.position", {object(own.id), 1});
    CHECK(point.size() == 3);
}

TEST_CASE("regions, deformations, hairstyles and strands of C work in calls") {
    const Host host;
    const lissom_mesh bar = host.add(make_bar({}));
    lissom_region all{};
    REQUIRE(lissom_region_all(host, bar, &all) == LISSOM_OK);
    CHECK(call(host, "Region.vertices", Json::array({object(all.id)}))[0].size() ==
          at(lissom_mesh_vertex_count(host, bar)));
    const Json shrunk = call(host, "Region.shrink", {object(all.id), 1});
    CHECK(lissom_region_is_valid(host, {shrunk[0]["object"].get<std::uint64_t>()}));
    lissom_deformer deformer{};
    REQUIRE(lissom_deformer_create(host, bar, all, nullptr, &deformer) == LISSOM_OK);
    CHECK(call(host, "Deformer.stats", Json::array({object(deformer.id)}))[0].is_object());
    // Other kinds stay objects of Lua.
    const Json scalp =
        call(host, "scalp", Json::array({call(host, "shapes.head", Json::array())[0]}));
    CHECK(scalp[0]["type"] == "lissom.Scalp");
    CHECK(lissom_object_is_valid(host, {scalp[0]["object"].get<std::uint64_t>()}));
    CHECK(call(host, "Scalp.confidence", Json::array({scalp[0]}))[0].is_number());
    CHECK(lissom_object_release(host, {scalp[0]["object"].get<std::uint64_t>()}) == LISSOM_OK);
    lissom_bytes bytes{};
    CHECK(lissom_call(host, "Scalp.confidence", Json::array({scalp[0]}).dump().c_str(), &bytes) ==
          LISSOM_INVALID_HANDLE);
}

TEST_CASE("failures of calls have the status of the function") {
    const Host host;
    lissom_bytes bytes{};
    CHECK(lissom_call(host, "shapes.bux", "[]", &bytes) == LISSOM_OUT_OF_RANGE);
    CHECK(host.message().find("shapes.box") != std::string::npos);
    CHECK(lissom_call(host, "load", "[\"/nowhere/a.obj\"]", &bytes) == LISSOM_FILE_NOT_FOUND);
    CHECK(lissom_call(host, "shapes.box", "[{\"sise\": 2}]", &bytes) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_call(host, "shapes.box", "{", &bytes) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_call(host, "shapes.box", "{}", &bytes) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_call(host, "Mesh.area", "[]", &bytes) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_call(host, "Mesh.area", "[{\"object\": 12}]", &bytes) == LISSOM_INVALID_HANDLE);
    std::string deep(5000, '[');
    deep += std::string(5000, ']');
    CHECK(lissom_call(host, "shapes.box", deep.c_str(), &bytes) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_call(host, nullptr, "[]", &bytes) == LISSOM_INVALID_ARGUMENT);
}

TEST_CASE("a script tells its parameters before it works, and runs with those that were set") {
    const Host host;
    const lissom_script script = load(host, R"(
local lissom = require "lissom"
local p = lissom.params{ size = { type = "number", default = 2, min = 1, max = 9, unit = "m", help = "Edge." } }
worked = (worked or 0) + 1
local box = lissom.shapes.box{ size = p.size }
return box, worked, p.size
)");
    lissom_bytes bytes{};
    REQUIRE(lissom_script_parameters(host, script, &bytes) == LISSOM_OK);
    const Json parameters = parsed(bytes);
    REQUIRE(parameters.size() == 1);
    CHECK(parameters[0]["name"] == "size");
    CHECK(parameters[0]["max"] == 9.0);
    CHECK(lissom_script_set(host, script, "sise", "3") == LISSOM_INVALID_ARGUMENT);
    CHECK(host.message().find("size") != std::string::npos);
    CHECK(lissom_script_set(host, script, "size", "30") == LISSOM_INVALID_ARGUMENT);
    REQUIRE(lissom_script_set(host, script, "size", "3") == LISSOM_OK);
    REQUIRE(lissom_script_run(host, script, nullptr, &bytes) == LISSOM_OK);
    const Json results = parsed(bytes);
    CHECK(results[1] == 1);
    CHECK(results[2] == 3.0);
    double least[3], greatest[3];
    const lissom_mesh box{results[0]["object"].get<std::uint64_t>()};
    REQUIRE(lissom_mesh_bounds(host, box, least, greatest) == LISSOM_OK);
    CHECK(greatest[0] - least[0] == doctest::Approx(3.0));
}

TEST_CASE("calls take and return lists of numbers without JSON") {
    const Host host;
    const lissom_mesh mesh = host.add(make_box({}));
    std::vector<Vec3> points = host.positions(mesh);
    for (Vec3& point : points) point *= 2.0;
    const lissom_input in{points.data(), points.size(), 0, LISSOM_FLOAT64};
    lissom_object list{};
    REQUIRE(lissom_numbers_create(host, &in, 3, &list) == LISSOM_OK);
    CHECK(lissom_numbers_size(host, list) == 8);
    CHECK(lissom_numbers_width(host, list) == 3);
    // A mesh by the reference's own function.
    const std::string call = "[{\"positions\": {\"object\": " + std::to_string(list.id) +
                             "}, \"faces\": [[1, 3, 2], [1, 2, 4], [8, 7, 6]]}]";
    lissom_bytes bytes{};
    REQUIRE_MESSAGE(lissom_call(host, "mesh", call.c_str(), &bytes) == LISSOM_OK, host.message());
    const lissom_mesh made{parsed(bytes)[0]["object"].get<std::uint64_t>()};
    CHECK(host.positions(made) == points);
    const std::string object = "{\"object\": " + std::to_string(made.id) + "}";
    const std::string one = "[" + object + "]";
    const lissom_status got = lissom_call(host, "Mesh.positions", one.c_str(), &bytes);
    REQUIRE_MESSAGE(got == LISSOM_OK, host.message());
    const lissom_object view{parsed(bytes)[0]["object"].get<std::uint64_t>()};
    float read[8][4];
    const lissom_output out{read, 8, 16, LISSOM_FLOAT32};
    REQUIRE_MESSAGE(lissom_numbers_read(host, view, &out) == LISSOM_OK, host.message());
    for (std::size_t i = 0; i < 8; ++i) {
        for (int k = 0; k < 3; ++k) CHECK(read[i][k] == static_cast<float>(points[i][k]));
    }
    const lissom_output narrow{read, 8, 8, LISSOM_FLOAT32};
    CHECK(lissom_numbers_read(host, view, &narrow) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_numbers_size(host, {mesh.id}) == -1);
    CHECK(lissom_numbers_create(host, &in, 0, &list) == LISSOM_INVALID_ARGUMENT);
    // The list keeps its mesh.
    CHECK(lissom_mesh_release(host, made) == LISSOM_OK);
    CHECK(lissom_numbers_read(host, view, &out) == LISSOM_OK);
    CHECK(lissom_object_release(host, view) == LISSOM_OK);
    CHECK(lissom_numbers_read(host, view, &out) == LISSOM_INVALID_HANDLE);
}

TEST_CASE("parameters say which picker a host shows, and on which mesh") {
    const Host host;
    const lissom_script script = load(host, R"(
local lissom = require "lissom"
local p = lissom.params{
    arm = { type = "mesh", default = "arm.obj" }, face = { type = "head", default = "" },
    hand = { type = "region", default = "hand", of = "arm" },
    rim = { type = "boundary", default = "1", of = "arm" },
    fringe = { type = "curve", default = "", of = "face" } }
return p.arm, p.hand, p.rim, p.fringe, p.face
)");
    lissom_bytes bytes{};
    REQUIRE(lissom_script_parameters(host, script, &bytes) == LISSOM_OK);
    const Json parameters = parsed(bytes);
    REQUIRE(parameters.size() == 5);
    const char* wanted[][3] = {{"arm", "mesh", ""},
                               {"face", "head", ""},
                               {"fringe", "curve", "face"},
                               {"hand", "region", "arm"},
                               {"rim", "boundary", "arm"}};
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(parameters[i]["name"] == wanted[i][0]);
        CHECK(parameters[i]["type"] == wanted[i][1]);
        CHECK(parameters[i].value("of", "") == wanted[i][2]);
    }
    REQUIRE(lissom_script_set(host, script, "hand", "fingers") == LISSOM_OK);
    REQUIRE(lissom_script_set(host, script, "rim", "3") == LISSOM_OK);
    REQUIRE(lissom_script_run(host, script, nullptr, &bytes) == LISSOM_OK);
    CHECK(parsed(bytes) == Json({"arm.obj", "fingers", "3", "", ""}));
    for (const char* wrong : {"{ type = 'region', of = 'b', default = '' }",
                              "{ type = 'number', of = 'a', default = 1 }"}) {
        const std::string text = std::string("require('lissom').params{ a = ") + wrong + " }";
        lissom_script none{};
        CHECK(lissom_script_load(host, text.data(), text.size(), "wrong.lua", &none) ==
              LISSOM_SCRIPT_ERROR);
        CHECK(host.message().find("parameter 'a'") != std::string::npos);
    }
}

TEST_CASE("errors of scripts have file and line, and leave the state usable") {
    const Host host;
    CHECK(run(host, "local x = 1\nerror('no')") == LISSOM_SCRIPT_ERROR);
    CHECK(host.message().find("tool.lua:2: no") != std::string::npos);
    lissom_script script{};
    const std::string broken = "local = 3";
    CHECK(lissom_script_load(host, broken.data(), broken.size(), "tool.lua", &script) ==
          LISSOM_SCRIPT_ERROR);
    const std::string bytecode = "\x1bLua nonsense";
    CHECK(lissom_script_load(host, bytecode.data(), bytecode.size(), "tool.lua", &script) ==
          LISSOM_SCRIPT_ERROR);
    CHECK(run(host, "os.exit(3)") == LISSOM_SCRIPT_ERROR);
    CHECK(run(host, "return 1") == LISSOM_OK);
}

TEST_CASE("print goes to the log") {
    std::string told;
    auto options = lissom_default_context_options();
    options.user = &told;
    options.log = [](void* user, lissom_log_level, const char* message) {
        *static_cast<std::string*>(user) += message;
    };
    const Host host(options);
    CHECK(run(host, "print('length', 3)") == LISSOM_OK);
    CHECK(told == "length\t3");
}

// Scripts that catch every error, and work that no hook of Lua sees.
const char* const kStubborn[] = {
    "while true do pcall(function() while true do end end) end",
    "while true do xpcall(function() while true do end end, function() while true do end end) end",
    "while true do pcall(coroutine.wrap(function() pcall(function() while true do end end) end)) "
    "end",
    "while true do coroutine.resume(coroutine.create(function() while true do end end)) end",
    "return ('a'):rep(300):find('a*a*a*a*a*a*b')",
    "while true do pcall(string.gsub, ('a'):rep(300), 'a*a*a*a*a*a*b', '') end",
    "for _ in ('a'):rep(300):gmatch('a*a*a*a*a*a*b') do end",
    "while true do string.rep('', math.maxinteger) end",
    "table.move({}, 1, math.maxinteger - 1, 2)",
    "setmetatable({}, { __gc = function() while true do end end }) collectgarbage() "
    "while true do end",
    "while true do setmetatable({}, { __gc = function() while true do "
    "pcall(function() while true do end end) end end }) end",
    "while true do local c = coroutine.create(function() local x <close> = setmetatable({}, "
    "{ __close = function() while true do end end }) while true do end end) "
    "coroutine.resume(c) coroutine.close(c) end",
};

TEST_CASE("a cancel from another thread ends every script until it is cleared") {
    for (const char* text : kStubborn) {
        CAPTURE(text);
        const Host host;
        const lissom_script script = load(host, text);
        std::jthread other([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(40));
            lissom_cancel(host);
        });
        CHECK(lissom_script_run(host, script, nullptr, nullptr) == LISSOM_CANCELLED);
        other.join();
        CHECK(run(host, "while true do end") == LISSOM_CANCELLED);
        lissom_clear_cancel(host);
        CHECK(run(host, "local n = 0 for i = 1, 1e5 do n = n + i end return n") == LISSOM_OK);
    }
}

TEST_CASE("a context ends, whatever its finalizers do") {
    const Host host;
    CHECK(run(host,
              "kept = setmetatable({}, { __gc = function() while true do "
              "pcall(function() while true do end end) end end })") == LISSOM_OK);
}

TEST_CASE("functions of debug that can crash the host are out of a script's reach") {
    const Host host;
    CHECK(run(host, "debug.sethook()") == LISSOM_SCRIPT_ERROR);
    CHECK(host.message().find("out of a script's reach") != std::string::npos);
    CHECK(run(host,
              "local lissom = require 'lissom' assert(not pcall(debug.getregistry)) "
              "assert(debug.getupvalue(lissom.load, 1) == nil) "
              "assert(debug.setupvalue(lissom.load, 1, 3) == nil) "
              "assert(not pcall(debug.setmetatable, 'x', {})) "
              "local box = lissom.shapes.box() assert(not pcall(debug.setmetatable, box, nil)) "
              "assert(type(debug.getmetatable(box)) == 'string') "
              "table.sort({ 2, 1 }, function(a, b) assert(debug.getlocal(2, 1) == nil) "
              "assert(debug.setlocal(2, 1, 7) == nil) return a < b end) "
              "local mine = 5 local function f() assert(select(2, debug.getlocal(2, 3)) == 5) end "
              "f() local function g() return mine end assert(debug.getupvalue(g, 1) == 'mine') "
              "assert(debug.setmetatable({}, { __index = { a = 1 } }).a == 1)") == LISSOM_OK);
}

TEST_CASE("an endless script ends by a cancel, and one that needs too much memory by an error") {
    auto options = lissom_default_context_options();
    options.memory_limit = 40'000'000;
    const Host host(options);
    const lissom_script endless = load(host, "while true do end");
    std::jthread other([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        lissom_cancel(host);
    });
    CHECK(lissom_script_run(host, endless, nullptr, nullptr) == LISSOM_CANCELLED);
    other.join();
    lissom_clear_cancel(host);
    CHECK(run(host, "local t = {} while true do t[#t + 1] = ('x'):rep(100000) .. #t end") ==
          LISSOM_MEMORY_LIMIT);
    CHECK(run(host, "return 1") == LISSOM_OK);
}

}  // namespace lissom::test
