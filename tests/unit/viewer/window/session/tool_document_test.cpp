// Scenes of a session: opened, saved, exported, and made by scripts.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "kernel/io/strand_file.h"
#include "kernel/mesh/measure/measures.h"
#include "tests/unit/viewer/window/session/tool_host.h"

using namespace lissom;
using namespace lissom::window;
using namespace lissom::test;

TEST_CASE(
    "export: the mesh in hand is written by its ending, as it stands; what fails changes nothing") {
    ToolHost host;
    host.open("navigate");
    const std::string path = host.folder.path("out.glb");
    host.session.evaluate(
        "scene:set('ball', { transform = { { 1, 0, 0, 3 }, { 0, 0, -1, 0 }, "
        "{ 0, 1, 0, 0 }, { 0, 0, 0, 1 } } })");
    host.session.evaluate("before = scene:hash()");
    host.session.export_object(path);
    host.session.evaluate("print('same', before == scene:hash())");
    host.wait();
    CHECK(host.says(LineKind::message, "same\ttrue"));
    CHECK(host.says(LineKind::result, "exported ball to " + path + ": "));
    const Mesh written = load_mesh(path);
    CHECK(written.vertex_count() == make_sphere().vertex_count());
    CHECK(bounds(written).center().x() == doctest::Approx(3.0).epsilon(1e-6));
    // Again over what was written here, but not over other files, nor with an unknown ending.
    host.session.export_object(path);
    host.session.export_object(host.ball);
    host.session.export_object(host.folder.path("out.xyzzy"));
    host.wait();
    CHECK(std::count_if(host.lines.begin(), host.lines.end(), [](const ConsoleLine& line) {
              return line.text.starts_with("exported ball to ");
          }) == 2);
    CHECK(host.says(LineKind::error, "was not written by this window"));
    CHECK(host.says(LineKind::error, "xyzzy"));
    CHECK(load_mesh(host.ball).vertex_count() == make_sphere().vertex_count());
    CHECK(!std::filesystem::exists(host.folder.path("out.xyzzy")));
}

TEST_CASE("export: an ending of hair writes the visible hair as it stands; others the mesh") {
    ToolHost host;
    host.open("navigate");
    host.session.evaluate(
        "scene:add('hair', lissom.strands{ points = { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, "
        "{ 1, 1, 0 } }, counts = { 2, 2 } }, { transform = { { 1, 0, 0, 5 }, { 0, 1, 0, 0 }, "
        "{ 0, 0, 1, 0 }, { 0, 0, 0, 1 } } })");
    host.session.evaluate("before = scene:hash()");
    for (const std::string ending : {".usda", ".hair", ".data"}) {
        host.session.export_object(host.folder.path("out" + ending));
    }
    host.session.export_object(host.folder.path("both.obj"));
    host.session.evaluate("print('same', before == scene:hash())");
    host.wait();
    CHECK(host.says(LineKind::message, "same\ttrue"));
    for (const std::string ending : {".usda", ".hair", ".data"}) {
        const Strands written = load_strands(host.folder.path("out" + ending));
        CHECK(written.size() == 2);
        CHECK(written.points()[0] == doctest::Approx(5.0).epsilon(1e-6));
    }
    CHECK(load_mesh(host.folder.path("both.obj")).vertex_count() == make_sphere().vertex_count());
    // What can hold both is written for the hair once no mesh is to be seen.
    host.session.evaluate("scene:set('ball', { visible = false })");
    host.session.export_object(host.folder.path("lines.obj"));
    host.session.evaluate("scene:set('hair', { visible = false })");
    host.session.export_object(host.folder.path("none.usda"));
    host.wait();
    CHECK(host.says(LineKind::result, "exported hair to " + host.folder.path("lines.obj")));
    CHECK(host.says(LineKind::error, "no hair is to be seen"));
    CHECK(!std::filesystem::exists(host.folder.path("none.usda")));
}

TEST_CASE("z up: a saved scene opens with it, and the mesh keeps its coordinates") {
    ToolHost host;
    host.open("navigate");
    ToolInput look = input(Kind::look);
    look.camera = Camera({.eye = {0.0, -5.0, 0.0}, .up = {0.0, 0.0, 1.0}});
    look.size = {640, 480};
    look.up = ViewUp::z;
    host.session.post(look);
    const std::string path = host.folder.path("turned.lissom"), mesh = host.folder.path("same.obj");
    host.session.save_scene(path);
    host.session.export_object(mesh);
    host.wait();
    CHECK(load_mesh(mesh).positions()[5] == load_mesh(host.ball).positions()[5]);
    host.take(&SessionNews::tool_state);
    host.session.open({path});
    host.wait();
    const std::optional<ToolState> state = host.take(&SessionNews::tool_state);
    REQUIRE(state);
    REQUIRE(state->camera);
    CHECK(state->camera->up().z() == doctest::Approx(1.0));
    CHECK(state->up == ViewUp::z);
    // Another scene says nothing of it.
    host.session.open({host.ball});
    host.wait();
    CHECK(!host.take(&SessionNews::tool_state)->up);
}

TEST_CASE("session: what cannot be opened changes nothing of what is open") {
    ToolHost host;
    host.open(host_tool(host.folder));
    host.drag(2);
    REQUIRE(host.take(&SessionNews::opened));
    REQUIRE(host.take(&SessionNews::parameters));
    const std::vector<Vec3> before = host.shown();
    const ToolState known = host.state();
    const std::string drawing =
        "local lissom = require 'lissom'\n"
        "lissom.render{ lissom.shapes.torus{}, file = 'x.png', size = { 8, 8 } }\n";
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {host.folder.write("jobs.txt", "to do")},
             {host.folder.write("broken.ply", "ply")},
             {host.folder.path("missing.obj")},
             {host.ball, host.folder.path("broken.ply")},
             {host.folder.write("syntax.lua", "this is no Lua")},
             {host.folder.write("fails.lua", drawing + "error('no')")},
             {host.folder.write("quiet.lua", "x = 1")},
             {host.folder.write("bad_events.lua", "return require('lissom').replay{ 1 }")}}) {
        CAPTURE(words.front());
        host.lines.clear();
        host.session.open(words);
        host.wait();
        CHECK_FALSE(host.session.is_opening());
        CHECK_FALSE(host.lines.empty());
        CHECK_FALSE(host.take(&SessionNews::opened));
        CHECK_FALSE(host.take(&SessionNews::parameters));
        CHECK(host.session.files() == std::vector<std::filesystem::path>{host.ball});
        CHECK(host.shown() == before);
        CHECK(host.state().scene == known.scene);
        CHECK(host.state().tool == "pull");
        CHECK(host.state().steps == known.steps);
    }
    // Tools still work, and can be stopped.
    host.lines.clear();
    host.session.post(key("l"));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    host.session.cancel();
    CHECK(host.wait() < 10000.0);
    CHECK(host.says(LineKind::error, "cancelled"));
    host.drag(2);
    CHECK(host.state().steps.size() == 2);
    // F5 reads what is open, not what has failed.
    host.session.run_again({});
    host.wait();
    CHECK(host.state().steps.empty());
    CHECK(host.state().scene != known.scene);
    // What is opened takes its place.
    host.session.open({host.ball});
    host.wait();
    CHECK(host.take(&SessionNews::opened));
}

TEST_CASE("session: the first thing that is opened stays to be mended where it fails") {
    test::SessionHost host;
    host.session.open({host.folder.write("script.lua", "error('no')")});
    host.wait();
    CHECK(host.take(&SessionNews::opened));
    CHECK(host.session.files().size() == 1);
    host.folder.write("script.lua", "return require('lissom').shapes.box{}");
    host.session.run_again({});
    host.wait();
    CHECK(host.take(&SessionNews::shown));
    CHECK(host.says(LineKind::result, "works again"));
}

TEST_CASE("session: a scene is saved though something else is opened at once, and never as that") {
    ToolHost host;
    host.open(host_tool(host.folder));
    host.drag(2);
    const std::uint64_t scene = host.state().scene;
    const std::vector<Vec3> moved = host.shown();
    const std::string path = host.folder.path("kept.lissom");
    const std::string other = host.folder.path("other.obj");
    save_mesh(make_box(), other);
    host.session.save_scene(path, scene, 7);
    host.session.open({other});
    host.wait();
    CHECK(host.take(&SessionNews::saved) == 7);
    host.session.save_scene(path, scene, 8);
    host.wait();
    CHECK_FALSE(host.take(&SessionNews::saved));
    CHECK(host.says(LineKind::warning, "nothing was saved"));
    host.session.open({path});
    host.wait();
    CHECK(host.shown().size() == moved.size());
    // A cancel at any moment of a save, and a second save behind it.
    for (int trial = 0; trial < 50; ++trial) {
        host.session.save_scene(path, 0, 9);
        std::this_thread::sleep_for(std::chrono::microseconds(40 * trial));
        host.session.cancel();
        host.session.save_scene(path, 0, 10);
        host.session.cancel();
        host.wait();
        CAPTURE(trial);
        CHECK(host.take(&SessionNews::saved) == 10);
    }
    CHECK_FALSE(host.says(LineKind::error, "interrupted"));
}

TEST_CASE("session: a scene that was saved opens with its view") {
    ToolHost host;
    host.open();
    ToolInput look = input(Kind::look);
    look.camera = Camera({.eye = {3.0, 4.0, 5.0}, .ortho = 2.5});
    look.size = {640, 480};
    host.session.post(look);
    const std::string path = host.folder.path("seen.lissom");
    host.session.save_scene(path);
    host.wait();
    ToolHost other;
    other.open();
    CHECK_FALSE(other.state().camera);
    other.session.open({path});
    other.wait();
    const ToolState state = other.state();
    REQUIRE(state.camera);
    CHECK((state.camera->eye() - look.camera.eye()).norm() < 1e-12);
    CHECK(state.camera->options().ortho == 2.5);
    // From then on the hand moves it.
    look.camera = Camera({.eye = {0.0, 0.0, 9.0}});
    other.session.post(look);
    other.session.use_tool("select");
    other.wait();
    CHECK_FALSE(other.state().camera);
}

TEST_CASE("session: objects of a scene are hidden and shown again, which is a step too") {
    ToolHost host;
    host.open();
    REQUIRE(host.state().objects.size() == 1);
    CHECK(host.state().objects.front().label.find("faces") != std::string::npos);
    (void)host.shown();
    host.session.show_object("ball", false);
    host.session.show_object("no such object", false);
    host.wait();
    CHECK_FALSE(host.state().objects.front().visible);
    CHECK(host.take(&SessionNews::shown)->picture->meshes.empty());
    host.session.post(input(Kind::undo));
    host.wait();
    CHECK(host.state().objects.front().visible);
    CHECK(host.take(&SessionNews::shown)->picture->meshes.size() == 1);
    CHECK(host.lines.empty());
}

TEST_CASE("session: a script that runs again finds selection, tool, parameters and state") {
    ToolHost host;
    const std::string tool = host_tool(host.folder);
    const std::string script =
        "local lissom = require 'lissom'\nlocal p = lissom.params{ size = { type = 'number', "
        "default = 1 } }\nlocal ball = lissom.shapes.sphere{}\nball:transform{ scale = p.size }\n"
        "return { ball = ball }\n";
    host.run(script);
    ToolInput look = input(Kind::look);
    look.camera = Camera({.eye = {0.0, 0.0, 5.0}});
    look.size = {640, 480};
    host.session.post(look);
    host.session.use_tool(tool);
    host.session.set_tool_parameter("step", 0.25);
    host.wait();
    host.drag(3);
    host.session.evaluate(
        "local b = scene:get('ball'); "
        "b:set_region('selected', b:region{ vertices = { 3, 5 } })");
    host.wait();
    const auto asks = [&](const std::string& answer) {
        host.lines.clear();
        host.session.post(key("s"));
        host.session.evaluate("#scene:get('ball'):region('selected')");
        host.wait();
        CHECK(host.says(LineKind::message, answer));
        CHECK(host.says(LineKind::result, "2"));
    };
    asks("drags\t3\t0.25");
    host.run(script, {"--size=2"});
    CHECK(host.state().steps.empty());
    asks("drags\t3\t0.25");
    // A version that fails leaves the scene to the tools, and what follows finds all of it.
    host.run("error('broken')");
    CHECK(host.says(LineKind::error, "script.lua:1: broken"));
    host.drag(1);
    CHECK(host.state().steps.size() == 1);
    host.run(script);
    CHECK(host.state().steps.empty());
    asks("drags\t4\t0.25");
    // Other faces have no selection, and another script nothing of it.
    host.run("return { ball = require('lissom').shapes.box{} }");
    host.session.evaluate(
        "require('lissom').try(function() return scene:get('ball'):region('selected') end)");
    host.wait();
    CHECK(host.says(LineKind::result, "nil"));
    host.run(script);
    host.session.open({host.folder.write("other.lua", script)});
    host.lines.clear();
    host.session.post(key("s"));
    host.wait();
    CHECK(host.says(LineKind::message, "drags\tnil\t0.1"));
}

TEST_CASE("session: a script's scene comes without steps to undo") {
    ToolHost host;
    host.run(
        "local lissom = require 'lissom'\nlocal scene = lissom.scene{}\n"
        "scene:add('ball', lissom.shapes.sphere{})\nreturn scene");
    CHECK(host.state().steps.empty());
    host.session.post(input(Kind::undo));
    host.wait();
    CHECK(host.shown().size() > 10);
}

TEST_CASE("session: a scene is saved, and opened again as it was") {
    ToolHost host;
    host.open(host.folder.write("pull.lua", kPull));
    host.drag(3);
    const std::vector<Vec3> after = host.shown();
    const std::string path = host.folder.path("scene.lissom");
    host.session.save_scene(path);
    host.session.save_scene("/no such folder/scene.lissom");
    host.wait();
    CHECK(host.says(LineKind::result, "saved"));
    CHECK(host.says(LineKind::error, "file_write_failed"));
    host.session.open({path});
    host.wait();
    CHECK(host.shown() == after);
    CHECK(host.state().has_scene);
}

TEST_CASE("session: a tool or a script cannot end the window") {
    test::ProgramFolder outside;
    ToolHost host;
    host.open(outside.write("end.lua",
                            "return require('lissom').tool{ name = 'end',\n"
                            "press = function() os.exit(true) end }"));
    host.session.post(input(Kind::press));
    host.wait();
    CHECK(host.says(LineKind::error, "end.lua:2: os.exit does not end the window"));
    host.run("os.exit()");
    CHECK(host.says(LineKind::error, "script.lua:1: os.exit does not end the window"));
}

TEST_CASE("session: a scene that a script closes is still the window's") {
    ToolHost host;
    host.open(host.folder.write("pull.lua", kPull));
    host.session.evaluate("scene:close()");
    host.wait();
    const std::vector<Vec3> before = host.shown();
    host.drag(2);
    CHECK(host.shown() != before);
    CHECK(host.state().steps.size() == 1);
}
