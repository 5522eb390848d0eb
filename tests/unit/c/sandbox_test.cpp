// Scripts of a host that nobody vouches for.
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/c/host.h"

namespace lissom::test {
namespace {

using Json = nlohmann::json;

// How a script ended, and what was said about it.
struct Outcome {
    lissom_status status;
    std::string message;

    friend bool operator==(const Outcome& outcome, lissom_status status) {
        return outcome.status == status;
    }
    bool says(const char* text) const { return message.find(text) != std::string::npos; }
};

Outcome run_sandboxed(const Host& host, const std::string& text, lissom_bytes* results = nullptr) {
    lissom_script script{};
    const lissom_status loaded =
        lissom_script_load(host, text.data(), text.size(), "tool.lua", &script);
    if (loaded != LISSOM_OK) return {loaded, host.message()};
    const lissom_status status = lissom_script_run(host, script, nullptr, results);
    Outcome outcome{status, status == LISSOM_OK ? std::string() : host.message()};
    CHECK(lissom_script_release(host, script) == LISSOM_OK);
    return outcome;
}

bool is_true(const Host& host, const std::string& text) {
    lissom_bytes bytes{};
    if (run_sandboxed(host, text, &bytes).status != LISSOM_OK) return false;
    return Json::parse(std::string(static_cast<const char*>(bytes.data), bytes.size))[0] == true;
}

using Files = std::map<std::string, std::string>;

lissom_context_options with_files(Files& files) {
    auto options = lissom_default_context_options();
    options.user = &files;
    options.read_file = [](void* user, const char* path, lissom_sink* sink, void* argument) {
        const auto& table = *static_cast<Files*>(user);
        const auto found = table.find(path);
        if (found == table.end()) return false;
        sink(argument, found->second.data(), found->second.size());
        return true;
    };
    options.write_file = [](void* user, const char* path, const void* bytes, std::size_t size) {
        (*static_cast<Files*>(user))[path] = std::string(static_cast<const char*>(bytes), size);
        return true;
    };
    return options;
}

}  // namespace

TEST_CASE("sandbox of C: without the system, with the library, on objects of the host") {
    const Host host;
    REQUIRE(lissom_sandbox_scripts(host, nullptr) == LISSOM_OK);
    CHECK(is_true(host, "return io == nil and os.execute == nil and debug.sethook == nil"));
    CHECK(is_true(host, "return require('lissom').shapes.box():vertex_count() == 8"));
    {
        const Outcome outcome =
            run_sandboxed(host, "assert(require('lissom').load('/etc/passwd.obj'))");
        CHECK(outcome == LISSOM_SCRIPT_ERROR);
        CHECK(outcome.says("may not read"));
    }
    const lissom_mesh mesh = host.add(make_box({}));
    const Json arguments = Json::array({Json{{"object", mesh.id}}, Json{{"translate", {1, 0, 0}}}});
    const std::uint64_t before = host.hash(mesh);
    CHECK(lissom_call(host, "Mesh.transform", arguments.dump().c_str(), nullptr) == LISSOM_OK);
    CHECK(host.hash(mesh) != before);
}

TEST_CASE("sandbox of C: limits end a script, and the next one runs") {
    auto options = lissom_default_sandbox_options();
    options.instructions = 100'000;
    options.memory = std::size_t{16} << 20;
    options.output = 10'000;
    const Host host;
    REQUIRE(lissom_sandbox_scripts(host, &options) == LISSOM_OK);
    {
        const Outcome outcome = run_sandboxed(host, "while true do end");
        CHECK(outcome == LISSOM_CANCELLED);
        CHECK(outcome.says("instructions"));
    }
    CHECK(run_sandboxed(host, "while true do pcall(function() while true do end end) end") ==
          LISSOM_CANCELLED);
    {
        const Outcome outcome = run_sandboxed(host, "while true do print(('x'):rep(1000)) end");
        CHECK(outcome == LISSOM_CANCELLED);
        CHECK(outcome.says("written"));
    }
    CHECK(run_sandboxed(host, "return ('x'):rep(1e8)") == LISSOM_MEMORY_LIMIT);
    {
        const Outcome outcome = run_sandboxed(
            host,
            "local m = require('lissom').shapes.bar{ across = 10, along = 100 } local t = {} "
            "for i = 1, 1000 do t[i] = assert(m:copy()) end");
        CHECK(outcome == LISSOM_MEMORY_LIMIT);
        CHECK(outcome.says("of the limit of"));
    }
    CHECK(lissom_call(host, "shapes.grid", R"([{"segments": 5000}])", nullptr) ==
          LISSOM_MEMORY_LIMIT);
    CHECK(is_true(host, "return true"));
    CHECK(lissom_memory_peak(host) <= options.memory);
}

TEST_CASE("sandbox of C: warnings are output, those of the host's own calls are not") {
    // A face without area is told.
    std::string model = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\n";
    struct Shown {
        Files files;
        std::size_t warned = 0;
    } shown{{{"odd.obj", model}}};
    auto given = lissom_default_context_options();
    given.user = &shown;
    given.read_file = [](void* user, const char* path, lissom_sink* sink, void* argument) {
        const Files& files = static_cast<Shown*>(user)->files;
        const auto found = files.find(path);
        if (found == files.end()) return false;
        sink(argument, found->second.data(), found->second.size());
        return true;
    };
    given.log = [](void* user, lissom_log_level level, const char* message) {
        if (level == LISSOM_WARNING) static_cast<Shown*>(user)->warned += std::strlen(message);
    };
    const Host host(given);
    auto options = lissom_default_sandbox_options();
    options.output = 1000;
    options.seconds = 60.0;
    REQUIRE(lissom_sandbox_scripts(host, &options) == LISSOM_OK);
    const Outcome outcome =
        run_sandboxed(host, "while true do require('lissom').load('odd.obj') end");
    CHECK(outcome == LISSOM_CANCELLED);
    CHECK(outcome.says("written"));
    CHECK(shown.warned > 0);
    CHECK(shown.warned <= options.output);
    const std::size_t before = shown.warned;
    lissom_mesh mesh{};
    REQUIRE(lissom_mesh_load(host, "odd.obj", nullptr, &mesh) == LISSOM_OK);
    CHECK(shown.warned > before);
}

TEST_CASE("sandbox of C: a time ends a script, and is not the host's cancel") {
    auto options = lissom_default_sandbox_options();
    options.seconds = 0.05;
    const Host host;
    REQUIRE(lissom_sandbox_scripts(host, &options) == LISSOM_OK);
    {
        const Outcome outcome = run_sandboxed(host, "while true do end");
        CHECK(outcome == LISSOM_CANCELLED);
        CHECK(outcome.says("time"));
    }
    CHECK(is_true(host, "return true"));
    lissom_cancel(host);
    CHECK(run_sandboxed(host, "while true do end") == LISSOM_CANCELLED);
    lissom_clear_cancel(host);
    CHECK(is_true(host, "return true"));
}

TEST_CASE("sandbox of C: its memory is the context's too") {
    auto given = lissom_default_context_options();
    given.memory_limit = std::size_t{8} << 20;
    const Host host(given);
    REQUIRE(lissom_sandbox_scripts(host, nullptr) == LISSOM_OK);
    CHECK(run_sandboxed(host, "return ('x'):rep(2e7)") == LISSOM_MEMORY_LIMIT);
    CHECK(is_true(host, "return #('x'):rep(1e5) == 1e5"));
    CHECK(lissom_memory_peak(host) <= given.memory_limit);
}

TEST_CASE("sandbox of C: files are the host's where it opens them") {
    Files files{{"parts/wheel.lua", "return { spokes = 7 }"},
                {"tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
                {"tool.lua", "return require('lissom').tool{ name = 'nothing' }"}};
    const Host host(with_files(files));
    const char* modules[] = {"parts"};
    auto options = lissom_default_sandbox_options();
    options.module_folders = modules;
    options.module_folder_count = 1;
    options.output = 1000;
    REQUIRE(lissom_sandbox_scripts(host, &options) == LISSOM_OK);
    CHECK(is_true(host, "return require('wheel').spokes == 7"));
    CHECK(is_true(host, "return require('lissom').load('tri.obj'):vertex_count() == 3"));
    CHECK(is_true(host, "return require('lissom').load_tool('tool.lua').name == 'nothing'"));
    CHECK(is_true(host,
                  "return select(2, pcall(function() return "
                  "require('lissom').load('/etc/passwd.obj') end)).code == "
                  "'file_not_found'"));
    CHECK(is_true(host, "return require('lissom').shapes.box():save('out.stl') ~= nil"));
    CHECK(files.count("out.stl") == 1);
    CHECK(is_true(host,
                  "return select(2, pcall(function() return "
                  "require('lissom').shapes.box():save('more.stl') end)).code == "
                  "'file_write_failed'"));
    CHECK(files.count("more.stl") == 0);
}

TEST_CASE("sandbox of C: what it refuses") {
    const Host host;
    auto options = lissom_default_sandbox_options();
    options.seconds = -1.0;
    CHECK(lissom_sandbox_scripts(host, &options) == LISSOM_INVALID_ARGUMENT);
    options = lissom_default_sandbox_options();
    options.read_folder_count = 1;
    CHECK(lissom_sandbox_scripts(host, &options) == LISSOM_INVALID_ARGUMENT);
    for (const auto count :
         {&lissom_sandbox_options::read_folder_count, &lissom_sandbox_options::write_folder_count,
          &lissom_sandbox_options::module_folder_count}) {
        options = lissom_default_sandbox_options();
        options.*count = -3;
        CHECK(lissom_sandbox_scripts(host, &options) == LISSOM_INVALID_ARGUMENT);
    }
    lissom_sandbox_options zeros{};
    CHECK(lissom_sandbox_scripts(host, &zeros) == LISSOM_BAD_STRUCT);
    CHECK(run_sandboxed(host, "return true") == LISSOM_OK);
    CHECK(lissom_sandbox_scripts(host, nullptr) == LISSOM_INVALID_ARGUMENT);
    CHECK(host.message().find("scripts have run") != std::string::npos);
    const Host second;
    CHECK(lissom_sandbox_scripts(second, nullptr) == LISSOM_OK);
    CHECK(lissom_sandbox_scripts(second, nullptr) == LISSOM_INVALID_ARGUMENT);
    CHECK(second.message().find("sandbox already") != std::string::npos);
}

TEST_CASE("results that stand in many places of a table are refused before they fill the memory") {
    const Host host;
    lissom_bytes bytes{};
    {
        const Outcome outcome = run_sandboxed(
            host, "local t = { 1 } for i = 1, 60 do t = { t, t } end return t", &bytes);
        CHECK(outcome == LISSOM_INVALID_ARGUMENT);
        CHECK(outcome.says("values"));
    }
}

TEST_CASE("a file that a mesh refers to comes from the host too") {
    Files files{{"a/tri.obj", "mtllib tri.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n"},
                {"a/tri.mtl", "newmtl red\nKd 1 0 0\n"}};
    const Host host(with_files(files));
    lissom_mesh mesh{};
    REQUIRE(lissom_mesh_load(host, "a/tri.obj", nullptr, &mesh) == LISSOM_OK);
    REQUIRE(lissom_mesh_save(host, mesh, "tri.glb", nullptr) == LISSOM_OK);
    CHECK(files["tri.glb"].find("\"red\"") != std::string::npos);
    files.erase("a/tri.mtl");
    REQUIRE(lissom_mesh_load(host, "a/tri.obj", nullptr, &mesh) == LISSOM_OK);
}

}  // namespace lissom::test
