// Values that calls by name refuse, and handles of many contexts.
#include <cstring>
#include <set>
#include <thread>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/c/world.h"

namespace lissom::test {
namespace {

lissom_status run_text(const Host& host, const std::string& text, const char* arguments,
                       lissom_bytes* bytes) {
    lissom_script script{};
    REQUIRE(lissom_script_load(host, text.data(), text.size(), "tool.lua", &script) == LISSOM_OK);
    return lissom_script_run(host, script, arguments, bytes);
}

std::string text_of(const lissom_bytes& bytes) {
    return {static_cast<const char*>(bytes.data), bytes.size};
}

}  // namespace

TEST_CASE("a handle of one of 70,000 contexts is no handle of another, and fits in 2^53") {
    const Host host;
    const lissom_mesh mesh = host.add(make_box({}));
    CHECK(mesh.id < (std::uint64_t{1} << 53));
    std::set<std::uint64_t> ids;
    for (int i = 0; i < 70000; ++i) {
        lissom_context* other = nullptr;
        REQUIRE(lissom_context_create(nullptr, &other) == LISSOM_OK);
        REQUIRE_FALSE(lissom_mesh_is_valid(other, mesh));
        if (i % 1000 == 0) {
            const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
            const std::int32_t corners[] = {0, 1, 2};
            const lissom_input p = triples(points, 3), c{corners, 3, 0, LISSOM_INT32};
            lissom_mesh own{};
            REQUIRE(lissom_mesh_create(other, &p, &c, nullptr, &own) == LISSOM_OK);
            REQUIRE(ids.insert(own.id).second);
            REQUIRE_FALSE(lissom_mesh_is_valid(host, own));
        }
        lissom_context_destroy(other);
    }
    CHECK(*ids.rbegin() < (std::uint64_t{1} << 53));
    CHECK(lissom_mesh_is_valid(host, mesh));
}

TEST_CASE("results that JSON cannot hold are refused, not changed") {
    if (!lissom_has_scripts()) return;
    const Host host;
    for (const char* text :
         {"return {1, 2, name = 3}", "return {[1] = 1, [3] = 3}", "return {[2.5] = 1}",
          "return {{name = 1, [true] = 2}}", "return 0/0", "return 1/0", "return {-1/0}",
          "return print", "return '\\xff\\xfe'", "return {['\\xff'] = 1}",
          "return {{'\\xed\\xa0\\x80'}}", "local t = {} t.t = t return t"}) {
        CAPTURE(std::string(text));
        lissom_bytes bytes{};
        CHECK(run_text(host, text, nullptr, &bytes) == LISSOM_INVALID_ARGUMENT);
        CHECK(bytes.data == nullptr);
    }
}

TEST_CASE("names of a mesh's attributes that are not UTF-8 are refused as results") {
    if (!lissom_has_scripts()) return;
    const Host host;
    lissom_bytes bytes{};
    const char* text =
        "local mesh = require('lissom').shapes.box() "
        "mesh:add_attribute{ name = 'a\\xff' } return mesh:attributes()";
    CHECK(run_text(host, text, nullptr, &bytes) == LISSOM_INVALID_ARGUMENT);
    CHECK(host.message().find("UTF-8") != std::string::npos);
    CHECK(bytes.data == nullptr);
    REQUIRE(run_text(host, "return '\\u{6ce2}'", nullptr, &bytes) == LISSOM_OK);
    CHECK(text_of(bytes) == "[\"\xe6\xb3\xa2\"]");
}

TEST_CASE("results that are refused leave no handles") {
    if (!lissom_has_scripts()) return;
    const Host host;
    lissom_bytes bytes{};
    const std::string boxes =
        "local shapes = require('lissom').shapes return shapes.box(), shapes.box(), ";
    REQUIRE(run_text(host, boxes + "3", nullptr, &bytes) == LISSOM_OK);
    const std::size_t before = lissom_object_count(host);
    CHECK(run_text(host, boxes + "print", nullptr, &bytes) == LISSOM_INVALID_ARGUMENT);
    // The script itself.
    CHECK(lissom_object_count(host) == before + 1);
}

TEST_CASE("results keep their kinds, and names come in one order") {
    if (!lissom_has_scripts()) return;
    const Host host;
    lissom_bytes bytes{};
    REQUIRE(run_text(host,
                     "return nil, true, -3, 2.0, 1e300, 'a\\n\"\xc3\xa4', {}, {1, {2}}, "
                     "{c = 1, a = {}, b = 2}, math.maxinteger, math.mininteger, 0.1",
                     nullptr, &bytes) == LISSOM_OK);
    CHECK(text_of(bytes) ==
          "[null,true,-3,2.0,1e+300,\"a\\n\\\"\xc3\xa4\",[],[1,[2]],{\"a\":[],\"b\":2,\"c\":1},"
          "9223372036854775807,-9223372036854775808,0.1]");
    // What comes out goes in.
    const std::string first = text_of(bytes);
    REQUIRE(run_text(host, "return ...", first.c_str(), &bytes) == LISSOM_OK);
    CHECK(text_of(bytes) == first);
}

TEST_CASE("arguments that are no list of JSON are refused in words of the library") {
    if (!lissom_has_scripts()) return;
    const Host host;
    const std::string deep = std::string(200, '[') + std::string(200, ']');
    for (const std::string& text :
         {std::string("["), std::string("{}"), std::string("3"), std::string(""),
          std::string("[1,]"), std::string("[1e999]"), std::string("[18446744073709551615]"),
          std::string("[9223372036854775808]"), std::string("[-9223372036854775809]"),
          std::string("[123456789012345678901234567890]"), std::string("[\"\xff\"]"),
          std::string("[\"\\ud800\"]"), std::string("[{\"a\":1,\"a\":2}]"), std::string("[NaN]"),
          deep, std::string("[] []")}) {
        CAPTURE(text);
        lissom_bytes bytes{};
        CHECK(run_text(host, "return ...", text.c_str(), &bytes) == LISSOM_INVALID_ARGUMENT);
        CHECK(host.message().find("json.exception") == std::string::npos);
        CHECK(host.message().find("arguments: ") == 0);
        CHECK(lissom_call(host, "shapes.box", text.c_str(), &bytes) == LISSOM_INVALID_ARGUMENT);
    }
    lissom_bytes bytes{};
    CHECK(run_text(host, "return ...", "[{\"object\":0}]", &bytes) == LISSOM_INVALID_HANDLE);
    CHECK(run_text(host, "return ...", "[{\"object\":4294967297}]", &bytes) ==
          LISSOM_INVALID_HANDLE);
    REQUIRE(run_text(host, "return ...", "[9223372036854775807, 1e3]", &bytes) == LISSOM_OK);
    CHECK(text_of(bytes) == "[9223372036854775807,1000.0]");
}

TEST_CASE("a poll and a cancel tell their error to the thread that uses the context") {
    const Host host;
    lissom_job_state state{};
    CHECK(lissom_job_poll(host, {7}, &state) == LISSOM_INVALID_HANDLE);
    CHECK(lissom_last_error(host)->status == LISSOM_INVALID_HANDLE);
    CHECK(host.message().find("no such job") != std::string::npos);
    host.add(make_box({}));
    CHECK(lissom_last_error(host)->status == LISSOM_OK);
    CHECK(lissom_job_cancel(host, {7}) == LISSOM_INVALID_HANDLE);
    CHECK(lissom_last_error(host)->status == LISSOM_INVALID_HANDLE);

    World world;
    world.make_deformer();
    lissom_job job{};
    REQUIRE(lissom_deformer_begin_prepare(world, world.deformer, &job) == LISSOM_OK);
    CHECK(lissom_job_poll(world, job, nullptr) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_last_error(world)->status == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_job_poll(world, job, &state) == LISSOM_OK);
    CHECK(lissom_last_error(world)->status == LISSOM_OK);
    CHECK(lissom_job_cancel(world, job) == LISSOM_OK);
    std::thread([&] {
        CHECK(lissom_job_poll(world, {7}, &state) == LISSOM_INVALID_HANDLE);
        CHECK(lissom_job_cancel(world, {7}) == LISSOM_INVALID_HANDLE);
    }).join();
    CHECK(lissom_last_error(world)->status == LISSOM_OK);
    CHECK(lissom_job_poll(nullptr, job, &state) == LISSOM_INVALID_HANDLE);
    lissom_job_finish(world, job, nullptr);
}

TEST_CASE("numbers that no enumeration has are refused") {
    World world;
    world.make_deformer();
    auto load = lissom_default_mesh_load_options();
    const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (const int number : {55, 4, -1}) {
        load.weld = static_cast<lissom_weld>(number);
        CHECK(lissom_mesh_decode(world, obj, sizeof obj - 1, "obj", &load, &world.made_mesh) ==
              LISSOM_INVALID_ARGUMENT);
        const auto wrong = static_cast<lissom_quality>(number);
        CHECK(lissom_deformer_solve(world, world.deformer, wrong) == LISSOM_INVALID_ARGUMENT);
        CHECK(lissom_deformer_begin_solve(world, world.deformer, wrong, &world.made_job) ==
              LISSOM_INVALID_ARGUMENT);
        CHECK(lissom_region_combine(world, world.top, world.bottom,
                                    static_cast<lissom_region_operation>(number),
                                    &world.made_region) == LISSOM_INVALID_ARGUMENT);
        auto deform = lissom_default_deformer_options();
        deform.second = static_cast<lissom_second_system>(number);
        CHECK(lissom_deformer_create(world, world.bar, {0}, &deform, &world.made_deformer) ==
              LISSOM_INVALID_ARGUMENT);
        std::vector<double> points(300);
        // 4 is UINT8.
        const auto format = static_cast<lissom_format>(number == 4 ? LISSOM_FLOAT16 + 1 : number);
        const lissom_input in{points.data(), 100, 0, format};
        const lissom_output out{points.data(), 100, 0, format};
        CHECK(lissom_mesh_create(world, &in, &in, nullptr, &world.made_mesh) ==
              LISSOM_INVALID_ARGUMENT);
        CHECK(lissom_mesh_read_positions(world, world.bar, &out) == LISSOM_INVALID_ARGUMENT);
        CHECK(lissom_mesh_read_triangles(world, world.bar, &out) == LISSOM_INVALID_ARGUMENT);
        CHECK(lissom_region_read_vertices(world, world.top, &out) == LISSOM_INVALID_ARGUMENT);
    }
}

TEST_CASE("arguments of very many names are read soon, and hear a cancel") {
    if (!lissom_has_scripts()) return;
    const Host host;
    std::string names = "[{";
    for (int i = 0; i < 300000; ++i) names += "\"k" + std::to_string(i) + "\": 0, ";
    lissom_bytes bytes{};
    const std::string unknown = names + "\"z\": 0}]", twice = names + "\"k7\": 0}]";
    CHECK(lissom_call(host, "shapes.box", unknown.c_str(), &bytes) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_call(host, "shapes.box", twice.c_str(), &bytes) == LISSOM_INVALID_ARGUMENT);
    CHECK(std::string(lissom_last_error(host)->message).find("'k7' twice") != std::string::npos);
    lissom_cancel(host);
    CHECK(lissom_call(host, "shapes.box", unknown.c_str(), &bytes) == LISSOM_CANCELLED);
    lissom_clear_cancel(host);
}

TEST_CASE("a call has at most 250 arguments") {
    if (!lissom_has_scripts()) return;
    const Host host;
    std::string list = "[0";
    for (int i = 0; i < 250; ++i) list += ", 0";
    lissom_bytes bytes{};
    CHECK(lissom_call(host, "shapes.box", (list + "]").c_str(), &bytes) == LISSOM_INVALID_ARGUMENT);
    CHECK(std::string(lissom_last_error(host)->message).find("250") != std::string::npos);
}

}  // namespace lissom::test
