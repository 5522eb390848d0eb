// Tools of a session: what a hand does reaches them in order, becomes steps, and can be repeated.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "kernel/io/mesh_file.h"
#include "kernel/io/strand_file.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/window/session/session_host.h"
#include "viewer/window/panel/tool_panel.h"
#include "viewer/window/session/tool_input.h"

using namespace lissom;
using namespace lissom::window;

namespace {

using Kind = ToolInput::Kind;

// Pulls the vertex under the cursor.
constexpr const char* kPull = R"(local lissom = require "lissom"
return lissom.tool{ name = "pull", params = { step = { type = "number", default = 0.1, max = 5 } },
    press = function(self, ev) self.hit = ev:hit() end,
    drag = function(self)
        local x, y, z = self.hit.mesh:position(self.hit.vertex)
        self.hit.mesh:set_position(self.hit.vertex, x, y, z + self.params.step)
        self.state.drags = (self.state.drags or 0) + 1
    end,
    wheel = function(self, ev) self.params.step = self.params.step + 0.1 * ev.lines end,
    key = function(self, ev)
        if ev.key == "s" then print("drags", self.state.drags, self.params.step) end
        if ev.key == "l" then while true do end end
        if ev.key == "e" then ev.scene:get("ball"):transform{ scale = 2 } error("oops") end
    end,
    draw = function(self, view)
        if self.hit then view:points{ points = { self.hit.position } } end
        view:label{ at = { 0, 0, 0 }, text = "here" }
    end }
)";

ToolInput input(Kind kind, double x = 320.0, double y = 240.0) {
    ToolInput made;
    made.kind = kind;
    made.at = {x, y};
    return made;
}

ToolInput key(const char* name) {
    ToolInput made;
    made.kind = Kind::key;
    made.key = name;
    return made;
}

// A session with a ball in front of its camera.
struct ToolHost : test::SessionHost {
    explicit ToolHost(SessionOptions chosen = {}) : SessionHost(std::move(chosen)) {
        save_mesh(make_sphere(), ball);
    }

    std::string ball = folder.path("ball.obj");

    void open(const std::string& tool = {}) {
        session.open({ball});
        wait();
        ToolInput look = input(Kind::look);
        look.camera = Camera({.eye = {0.0, 0.0, 5.0}});
        look.size = {640, 480};
        session.post(look);
        if (!tool.empty()) session.use_tool(tool);
        wait();
    }
    void drag(int moves) {
        session.post(input(Kind::press));
        wait();
        for (int i = 0; i < moves; ++i) {
            session.post(input(Kind::move, 320.0 + i));
            wait();
        }
        session.post(input(Kind::release));
        wait();
    }
    // The positions that are shown.
    std::vector<Vec3> shown() {
        if (auto next = session.take_shown()) last = std::move(next);
        REQUIRE(last);
        REQUIRE(last->picture->meshes.size() == 1);
        const auto positions = last->picture->meshes[0].mesh->positions();
        return {positions.begin(), positions.end()};
    }
    ToolState state() {
        if (auto next = session.take_tool_state()) known = std::move(*next);
        return known;
    }
    std::optional<Shown> last;
    ToolState known;
};

constexpr const char* kGhost = R"(local lissom = require "lissom"
local box = lissom.shapes.box()
local place = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 3 }, { 0, 0, 0, 1 } }
return lissom.tool{ name = "ghost",
    press = function(self) self.held = true end,
    release = function(self) self.held = false end,
    draw = function(self, view)
        if self.held then view:mesh{ mesh = box, transform = place, color = "#ff0000" } end
    end }
)";

ToolInput played(std::size_t event) {
    ToolInput made;
    made.kind = Kind::play;
    made.event = event;
    return made;
}

// Opens a recording and plays all of it; the number of its events.
std::size_t play_all(test::SessionHost& host, const std::string& record) {
    host.session.open({record});
    host.wait();
    const auto playback = host.session.take_playback();
    if (!playback) return 0;
    for (std::size_t i = 0; i < playback->times.size(); ++i) host.session.post(played(i));
    host.wait();
    return playback->times.size();
}

std::string host_tool(const test::ProgramFolder& folder) {
    return folder.write("pull.lua", kPull);
}

std::string content_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

}  // namespace

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

TEST_CASE("several tools: each is found, none is taken in hand, and what fails is told") {
    ToolHost host;
    host.open("navigate");
    const std::string pull = host.folder.path("pull.lua"), push = host.folder.path("push.lua"),
                      bad = host.folder.path("bad.lua"), plain = host.folder.path("plain.lua");
    std::ofstream(pull) << kPull;
    std::ofstream(push)
        << "return require('lissom').tool{ name = 'pusher', press = function() end }";
    std::ofstream(bad) << "error('broken')";
    std::ofstream(plain) << "return 7";
    host.session.take_tool_state();
    host.session.find_tools({pull, bad, plain, push});
    host.wait();
    const auto tools = host.session.take_tools();
    REQUIRE(tools.size() == 2);
    CHECK(tools[0] == std::pair<std::string, std::string>{pull, "pull"});
    CHECK(tools[1] == std::pair<std::string, std::string>{push, "pusher"});
    CHECK(host.session.take_tools().empty());
    CHECK(host.says(LineKind::result, "pull, pusher"));
    CHECK(host.says(LineKind::error, "broken"));
    CHECK(host.says(LineKind::warning, "plain.lua is no tool"));
    host.session.evaluate("print('still', scene:get('ball'):face_count() > 0)");
    host.wait();
    CHECK(host.says(LineKind::message, "still\ttrue"));
    std::vector<ToolButton> buttons{{"navigate", "navigate"}};
    for (const auto& [word, name] : tools) keep_button(buttons, word, name);
    CHECK(buttons.size() == 3);
    CHECK(buttons.back() == ToolButton{push, "pusher"});
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
    host.session.take_tool_state();
    host.session.open({path});
    host.wait();
    const std::optional<ToolState> state = host.session.take_tool_state();
    REQUIRE(state);
    REQUIRE(state->camera);
    CHECK(state->camera->up().z() == doctest::Approx(1.0));
    CHECK(state->up == ViewUp::z);
    // Another scene says nothing of it.
    host.session.open({host.ball});
    host.wait();
    CHECK(!host.session.take_tool_state()->up);
}

TEST_CASE("tool input: looks and turns of the wheel do not pile up, and no move is lost") {
    std::vector<ToolInput> inputs;
    push_input(inputs, input(Kind::move, 1.0));
    push_input(inputs, input(Kind::move, 2.0));
    push_input(inputs, input(Kind::press, 2.0));
    for (int i = 0; i < 100; ++i) push_input(inputs, input(Kind::move, i));
    push_input(inputs, key("a"));
    push_input(inputs, key("a"));
    push_input(inputs, input(Kind::look));
    push_input(inputs, input(Kind::look));
    ToolInput shifted = input(Kind::move, 7.0);
    push_input(inputs, input(Kind::move, 6.0));
    shifted.modifiers.shift = true;
    push_input(inputs, shifted);
    ToolInput turned = input(Kind::wheel);
    for (const double lines : {1.0, 2.0, -0.5}) {
        turned.lines = lines;
        push_input(inputs, turned);
    }
    REQUIRE(inputs.size() == 109);
    CHECK(inputs[0].at.x() == 1.0);
    CHECK(inputs[102].at.x() == 99.0);
    CHECK(inputs[108].lines == 2.5);
    CHECK(is_followed(inputs, 0));
    CHECK_FALSE(is_followed(inputs, 1));
    CHECK_FALSE(is_followed(inputs, 2));
    // The modifiers of the next one differ.
    CHECK_FALSE(is_followed(inputs, 106));
}

TEST_CASE("tool input: keys have the names that tools know") {
    Input typed;
    typed.kind = Input::Kind::text;
    typed.character = U'P';
    CHECK(tool_key(typed) == "p");
    typed.character = U'+';
    CHECK(tool_key(typed) == "+");
    typed.character = U'é';
    typed.letter = U'2';
    CHECK(tool_key(typed).empty());
    typed.character = U'ц';
    typed.letter = U'W';
    CHECK(tool_key(typed) == "w");
    Input pressed;
    pressed.kind = Input::Kind::key_down;
    pressed.key = Key::enter;
    CHECK(tool_key(pressed) == "enter");
}

TEST_CASE("session: a drag with a tool is one step, which undo takes back and redo does again") {
    ToolHost host;
    host.open(host.folder.write("pull.lua", kPull));
    CHECK(host.state().tool == "pull");
    const std::vector<Vec3> before = host.shown();
    host.drag(4);
    const std::vector<Vec3> after = host.shown();
    CHECK(after != before);
    CHECK(host.state().steps == std::vector<std::string>{"pull"});
    CHECK(host.state().marks.labels.size() == 1);
    CHECK(host.state().overlay.points.size() == 1);
    host.session.post(input(Kind::undo));
    host.wait();
    CHECK(host.shown() == before);
    CHECK(host.state().place == 0);
    host.session.post(input(Kind::redo));
    host.wait();
    CHECK(host.shown() == after);
    CHECK(host.lines.empty());
}

TEST_CASE("session: what cannot be opened changes nothing of what is open") {
    ToolHost host;
    host.open(host_tool(host.folder));
    host.drag(2);
    REQUIRE(host.session.take_opened());
    REQUIRE(host.session.take_parameters());
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
        CHECK_FALSE(host.session.take_opened());
        CHECK_FALSE(host.session.take_parameters());
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
    CHECK(host.session.take_opened());
}

TEST_CASE("session: the first thing that is opened stays to be mended where it fails") {
    test::SessionHost host;
    host.session.open({host.folder.write("script.lua", "error('no')")});
    host.wait();
    CHECK(host.session.take_opened());
    CHECK(host.session.files().size() == 1);
    host.folder.write("script.lua", "return require('lissom').shapes.box{}");
    host.session.run_again({});
    host.wait();
    CHECK(host.session.take_shown());
    CHECK(host.says(LineKind::result, "works again"));
}

TEST_CASE("session: a tool that is opened is taken in hand, and the scene stays") {
    ToolHost host;
    host.open("select");
    host.drag(1);
    const ToolState before = host.state();
    host.session.take_opened();
    const std::string own = host_tool(host.folder);
    host.session.open({own});
    host.wait();
    CHECK_FALSE(host.session.take_opened());
    CHECK(host.state().tool == "pull");
    CHECK(host.state().word == own);
    CHECK(host.state().scene == before.scene);
    host.session.use_tool("select");
    host.wait();
    CHECK(host.state().word == "select");
    CHECK(host.lines.empty());
    // Without a scene it waits for one.
    ToolHost empty;
    empty.session.open({host_tool(empty.folder)});
    empty.wait();
    CHECK(empty.says(LineKind::message, "is a tool"));
    empty.open();
    CHECK(empty.state().tool == "pull");
}

TEST_CASE("session: a tool that cannot begin leaves the one before in hand") {
    ToolHost host;
    host.open(host_tool(host.folder));
    const std::string bad =
        host.folder.write("bad.lua", R"(return require("lissom").tool{ name = "bad",
    activate = function() error("not today") end }
)");
    host.session.use_tool(bad);
    host.wait();
    CHECK(host.says(LineKind::error, "not today"));
    CHECK(host.state().tool == "pull");
    CHECK(host.state().word == host.folder.path("pull.lua"));
    host.drag(2);
    CHECK(host.state().steps == std::vector<std::string>{"pull"});
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
    CHECK(host.session.take_saved() == 7);
    host.session.save_scene(path, scene, 8);
    host.wait();
    CHECK_FALSE(host.session.take_saved());
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
        CHECK(host.session.take_saved() == 10);
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

TEST_CASE("own tools: those of lissom/tools in the folder for data, by name") {
    const test::ProgramFolder folder;
    std::filesystem::create_directories(folder.path("lissom/tools"));
    folder.write("lissom/tools/b.lua", "");
    folder.write("lissom/tools/a.lua", "");
    folder.write("lissom/tools/notes.txt", "");
    REQUIRE(setenv("XDG_DATA_HOME", folder.path(".").c_str(), 1) == 0);
    const std::vector<std::string> tools = own_tools();
    unsetenv("XDG_DATA_HOME");
    REQUIRE(tools.size() == 2);
    CHECK(button_of(tools[0]).label == "a");
    CHECK(button_of(tools[1]).label == "b");
}

TEST_CASE("tool buttons: each tool that was in hand keeps one, with its name") {
    std::vector<ToolButton> buttons{button_of("select"), button_of("/tools/my_own.lua")};
    CHECK(buttons[1].label == "my_own");
    ToolState state;
    state.tool = "own";
    state.word = "/tools/my_own.lua";
    keep_button(buttons, state);
    CHECK(buttons[1].label == "own");
    state.tool = state.word = "select";
    keep_button(buttons, state);
    state.tool = "pull";
    state.word = "pull.lua";
    keep_button(buttons, state);
    keep_button(buttons, ToolState());
    REQUIRE(buttons.size() == 3);
    CHECK(buttons[2] == ToolButton{"pull.lua", "pull"});
}

TEST_CASE("session: a slow tool hears every place of a stroke, and which of them are late") {
    ToolHost host;
    host.open(host.folder.write("slow.lua", R"(local lissom = require "lissom"
return lissom.tool{ name = "slow",
    press = function(self) self.path, self.late = {}, 0 end,
    drag = function(self, ev)
        local clock = os.clock()
        while os.clock() - clock < 0.02 do end
        table.insert(self.path, ev.x + 1000 * ev.y)
        if ev.late then self.late = self.late + 1 end
    end,
    release = function(self) print(table.concat(self.path, " ")) print(self.late > 10 and "late" or "soon") end }
)"));
    std::string course;
    host.session.post(input(Kind::press));
    for (int i = 0; i < 40; ++i) {
        const double x = 320.0 + i, y = 240.0 + (i % 10);
        host.session.post(input(Kind::move, x, y));
        course += (i > 0 ? " " : "") + std::to_string(static_cast<int>(x + 1000.0 * y)) + ".0";
    }
    host.session.post(input(Kind::release));
    host.wait();
    CHECK(host.says(LineKind::message, course));
    CHECK(host.says(LineKind::message, "late"));
    CHECK(host.state().steps.size() <= 1);
}

TEST_CASE("session: the wheel turns within a gesture of a tool") {
    ToolHost host;
    host.open(host.folder.write("pull.lua", kPull));
    host.session.post(input(Kind::press));
    ToolInput turned = input(Kind::wheel);
    turned.lines = 2.0;
    host.session.post(turned);
    host.session.post(input(Kind::move, 330.0));
    host.session.post(input(Kind::release));
    host.wait();
    const std::vector<Vec3> after = host.shown();
    double most = 0.0;
    for (const Vec3& p : after) most = std::max(most, p.z());
    CHECK(most == doctest::Approx(1.3).epsilon(0.01));
    CHECK(host.state().steps.size() == 1);
}

TEST_CASE("session: Escape in a drag, and an error in a tool, leave the scene as it was") {
    ToolHost host;
    host.open(host.folder.write("pull.lua", kPull));
    const std::vector<Vec3> before = host.shown();
    host.session.post(input(Kind::press));
    host.session.post(input(Kind::move, 330.0));
    host.wait();
    CHECK(host.shown() != before);
    host.session.post(input(Kind::cancel));
    host.wait();
    CHECK(host.shown() == before);
    host.session.post(key("e"));
    host.wait();
    CHECK(host.says(LineKind::error, "pull.lua:13: oops"));
    CHECK(host.shown() == before);
    host.drag(1);
    CHECK(host.shown() != before);
}

TEST_CASE("session: a tool that fails while it draws is told once, and other tools work") {
    ToolHost host;
    host.open(host.folder.write("bad.lua",
                                "local lissom = require 'lissom'\nreturn lissom.tool{ name "
                                "= 'bad', draw = function()\n    nothing.here()\nend }"));
    const std::vector<Vec3> before = host.shown();
    for (int i = 0; i < 5; ++i) {
        host.session.post(key("a"));
        host.wait();
    }
    std::size_t told = 0;
    for (const ConsoleLine& line : host.lines) {
        told += line.text.find("bad.lua:3:") != std::string::npos ? 1 : 0;
    }
    CHECK(told == 1);
    CHECK(host.shown() == before);
    host.session.use_tool(host.folder.write("pull.lua", kPull));
    host.wait();
    host.drag(1);
    CHECK(host.shown() != before);
    CHECK(host.state().steps.size() == 1);
}

TEST_CASE("session: a tool that removes what it drags is told, and other tools work") {
    ToolHost host;
    host.open(host.folder.write(
        "bad.lua",
        "local lissom = require 'lissom'\nreturn lissom.tool{ name = 'bad', drag = function(self, "
        "ev)\n    local hit = ev:hit()\n    ev.scene:remove(ev.scene:names()[1])\n    "
        "hit.mesh:set_position(1, 0, 0, 0)\n    error('it is gone')\nend }"));
    const std::vector<Vec3> before = host.shown();
    host.drag(3);
    CHECK(host.says(LineKind::error, "bad.lua:6: it is gone"));
    CHECK(host.shown() == before);
    CHECK(host.state().steps.empty());
    host.session.use_tool(host.folder.write("pull.lua", kPull));
    host.wait();
    host.drag(1);
    CHECK(host.shown() != before);
}

TEST_CASE("session: a tool that asks goes on asking after an error") {
    ToolHost host;
    host.open(host.folder.write("ask.lua", R"(local lissom = require "lissom"
return lissom.tool{ name = "ask", run = function()
    lissom.pick.point{ prompt = "Where?" }
    error("not there")
end })"));
    CHECK(host.state().prompt == "Where?");
    for (int i = 0; i < 2; ++i) {
        host.lines.clear();
        host.session.post(input(Kind::press));
        host.session.post(input(Kind::release));
        host.wait();
        CHECK(host.says(LineKind::error, "not there"));
        CHECK(host.state().prompt == "Where?");
    }
}

TEST_CASE("session: a tool that never returns is stopped, and works again") {
    ToolHost host;
    host.open(host.folder.write("pull.lua", kPull));
    const std::vector<Vec3> before = host.shown();
    host.session.post(key("l"));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    CHECK(host.session.busy());
    host.session.cancel();
    host.wait(10.0);
    bool has_place = false;
    for (const ConsoleLine& line : host.lines) {
        has_place = has_place || (line.text.find("pull.lua:") != std::string::npos &&
                                  line.text.find(": cancelled") != std::string::npos);
    }
    CHECK(has_place);
    host.drag(2);
    CHECK(host.shown() != before);
    CHECK(host.state().steps.size() == 1);
}

TEST_CASE("session: a tool that draws without end is stopped once, and draws when it is mended") {
    const std::string begin =
        "local lissom = require 'lissom'\nreturn lissom.tool{ name = 'mark', "
        "draw = function(_, view)\n    ";
    const std::string mark =
        "view:points{ points = { { 0, 0, 0 } } }\nend,\nkey = function() print 'key' end }";
    ToolHost host;
    const std::string file = host.folder.write("mark.lua", begin + mark);
    host.open(file);
    REQUIRE(host.state().overlay.points.size() == 1);
    host.folder.write("mark.lua", begin + "while true do end\n" + mark);
    host.session.read_tool_again();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    REQUIRE(host.session.busy());
    host.session.cancel();
    host.wait(10.0);
    CHECK(host.says(LineKind::error, "mark.lua:3: cancelled"));
    host.session.post(key("a"));
    host.wait(10.0);
    CHECK(host.says(LineKind::message, "key"));
    host.folder.write("mark.lua", begin + mark);
    host.session.read_tool_again();
    host.wait(10.0);
    CHECK(host.state().overlay.points.size() == 1);
}

TEST_CASE("session: what hangs in a tool is given up where its file is mended") {
    const std::string text =
        "local lissom = require 'lissom'\nreturn lissom.tool{ name = 'loop', "
        "key = function()\n    while HANGS do end\nend }";
    const auto with = [&](const std::string& hangs) {
        return "local HANGS = " + hangs + " " + text;
    };
    ToolHost host;
    host.open(host.folder.write("loop.lua", with("true")));
    host.session.post(key("a"));
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    REQUIRE(host.session.busy());
    host.folder.write("loop.lua", with("false"));
    host.session.read_tool_again();
    host.session.post(key("a"));
    host.wait(10.0);
    CHECK(host.says(LineKind::error, "loop.lua:3: cancelled"));
}

TEST_CASE(
    "session: a tool that is read again keeps its parameters and state; a broken one is not "
    "taken") {
    ToolHost host;
    const std::string file = host.folder.write("pull.lua", kPull);
    host.open(file);
    REQUIRE_FALSE(host.session.tool_files().empty());
    host.session.set_tool_parameter("step", 0.5);
    host.drag(3);
    std::string text = kPull;
    text.replace(text.find("\"drags\""), 7, "\"again\"");
    host.folder.write("pull.lua", text);
    host.session.read_tool_again();
    host.session.post(key("s"));
    host.wait();
    CHECK(host.says(LineKind::message, "again\t3\t0.5"));
    host.folder.write("pull.lua", "this is no Lua");
    host.session.read_tool_again();
    host.wait();
    CHECK(host.says(LineKind::error, "pull.lua:1:"));
    CHECK(host.state().tool == "pull");
    const std::vector<Vec3> before = host.shown();
    host.drag(1);
    CHECK(host.shown() != before);
}

TEST_CASE("session: a wrong value of a tool's parameter is told and not taken") {
    ToolHost host;
    host.open(host.folder.write("pull.lua", kPull));
    host.session.set_tool_parameter("step", 50.0);
    host.wait();
    CHECK(host.says(LineKind::error, "at most 5"));
    CHECK(std::get<double>(*host.state().parameters.front().value) == 0.1);
}

TEST_CASE("session: tools want a scene, which scripts give by what they return") {
    ToolHost host;
    const std::string tool = host.folder.write("pull.lua", kPull);
    host.session.use_tool(tool);
    host.wait();
    CHECK(host.says(LineKind::warning, "tools work on a scene"));
    host.run("local lissom = require 'lissom'\nreturn { ball = lissom.shapes.sphere{}, 3 }");
    CHECK(host.state().has_scene);
    host.session.use_tool(tool);
    host.wait();
    CHECK(host.state().tool == "pull");
    CHECK(host.shown().size() > 10);
    host.session.evaluate("print(#scene, scene:names()[1])");
    host.wait();
    CHECK(host.says(LineKind::message, "1\tball"));
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
    CHECK(host.session.take_shown()->picture->meshes.empty());
    host.session.post(input(Kind::undo));
    host.wait();
    CHECK(host.state().objects.front().visible);
    CHECK(host.session.take_shown()->picture->meshes.size() == 1);
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

TEST_CASE("session: hovering shows nothing new where a tool draws the same") {
    ToolHost host;
    host.open(host.folder.write("pull.lua", kPull));
    host.drag(1);
    (void)host.shown();
    for (int i = 0; i < 5; ++i) {
        host.session.post(input(Kind::move, 10.0 * i));
        host.wait();
    }
    CHECK_FALSE(host.session.take_shown());
}

TEST_CASE("session: a mesh that a tool draws is seen while it does, and is no object") {
    ToolHost host;
    host.open(host.folder.write("ghost.lua", kGhost));
    host.session.take_shown();
    host.session.post(input(Kind::press));
    host.wait();
    const auto held = host.session.take_shown();
    REQUIRE(held);
    REQUIRE(held->picture->meshes.size() == 2);
    CHECK(held->picture->meshes[1].style.raised);
    CHECK(held->picture->meshes[1].style.color.r == 1.0);
    CHECK(held->picture->meshes[1].transform.translation == Vec3(0, 0, 3));
    CHECK(!held->picture->meshes[0].style.raised);
    CHECK(held->bounds.max.z() == doctest::Approx(3.5));
    CHECK(host.state().objects.size() == 1);
    host.session.post(input(Kind::release));
    host.wait();
    CHECK(host.shown().size() == static_cast<std::size_t>(make_sphere().vertex_count()));
    CHECK(host.state().steps.empty());
}

TEST_CASE("session: what is recorded is a script that comes to the same scene") {
    test::ProgramFolder outside;
    const std::string record = outside.path("events.lua");
    std::vector<Vec3> after;
    ToolHost host({.record = record});
    host.open(host.folder.write("pull.lua", kPull));
    host.drag(4);
    host.session.set_tool_parameter("step", 0.25);
    host.drag(2);
    host.session.post(input(Kind::undo));
    host.wait();
    after = host.shown();
    CHECK(host.lines.empty());
    REQUIRE(content_of(record).find("replay") != std::string::npos);
    const std::size_t events = play_all(host, record);
    CHECK(events > 8);
    CHECK(host.session.events_played() == events);
    CHECK_FALSE(host.session.is_playing());
    REQUIRE(host.lines.size() == 1);
    CHECK(host.says(LineKind::result, "come to the scene that was recorded"));
    CHECK(host.shown() == after);
    // Not as a recording, but as the script that it is.
    const std::string copied = "require('os') " + content_of(record);
    host.session.open({outside.write("script.lua", copied)});
    host.wait();
    CHECK(host.lines.size() == 1);
    CHECK(host.shown() == after);
}

TEST_CASE("session: events are recorded with their times, and played one by one") {
    test::ProgramFolder outside;
    const std::string record = outside.path("events.lua");
    ToolHost recorder({.record = record});
    recorder.open(host_tool(outside));
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    recorder.drag(3);
    ToolHost host;
    host.session.open({record});
    host.wait();
    const auto playback = host.session.take_playback();
    REQUIRE(playback);
    const std::vector<double>& times = playback->times;
    CHECK(std::is_sorted(times.begin(), times.end()));
    CHECK(times.back() >= 0.06);
    CHECK(times.back() < 60.0);
    // The hand of the recording is seen with its button down; two moves that wait are two.
    std::size_t i = 0;
    while (!(host.state().hand && host.state().hand->is_down)) {
        REQUIRE(i < times.size());
        host.session.post(played(i++));
        host.wait();
    }
    CHECK(host.state().hand->size.width == 640);
    CHECK(host.state().hand->at == Vec2(320.0, 240.0));
    const std::vector<Vec3> before = host.shown();
    host.session.post(played(i));
    host.session.post(played(i + 1));
    host.wait();
    CHECK(host.session.events_played() == i + 2);
    CHECK(host.shown() != before);
    // Stopped there, nothing is held any more, and a hand goes on.
    host.session.stop_playing();
    host.session.post(played(i + 2));
    host.wait();
    CHECK_FALSE(host.session.is_playing());
    CHECK(host.session.events_played() == i + 2);
    CHECK(host.shown() == before);
    CHECK(host.state().place == 0);
    CHECK(host.state().tool == "pull");
    host.drag(1);
    CHECK(host.state().place == 1);
    CHECK(host.lines.empty());
}

TEST_CASE("session: the first difference of a recording is told, and it is played on") {
    test::ProgramFolder outside;
    const std::string record = outside.path("events.lua");
    const std::string tool = host_tool(outside);
    ToolHost recorder({.record = record});
    recorder.open(tool);
    recorder.drag(1);
    recorder.drag(1);
    std::string other = kPull;
    other.replace(other.find("z + self"), 8, "z - self");
    outside.write("pull.lua", other);
    test::SessionHost again;
    const std::size_t events = play_all(again, record);
    CHECK(again.session.events_played() == events);
    REQUIRE(again.lines.size() == 1);
    CHECK(again.says(LineKind::error, "the recording differs at event "));
    CHECK(again.says(LineKind::error, ", release: the scene has the hash "));
    // An error of a tool ends it, and names the event.
    outside.write("pull.lua", "return require('lissom').tool{ name = 'pull', press = error }");
    again.lines.clear();
    CHECK(play_all(again, record) == events);
    CHECK(again.session.events_played() < events);
    CHECK(again.says(LineKind::error, "event "));
    CHECK(again.says(LineKind::error, ", press: "));
    CHECK_FALSE(again.session.is_playing());
}

TEST_CASE("session: a recording finds what lies beside it, and says what it lacks") {
    test::ProgramFolder outside;
    std::filesystem::create_directory(outside.path("models"));
    save_mesh(make_sphere(), outside.path("models/ball.obj"));
    host_tool(outside);
    const std::string record = outside.path("events.lua");
    {
        test::SessionHost host({.tool = outside.path("pull.lua"), .record = record});
        host.session.open({outside.path("models/ball.obj")});
        host.wait();
        ToolInput look = input(Kind::look);
        look.camera = Camera({.eye = {0.0, 0.0, 5.0}});
        look.size = {640, 480};
        host.session.post(look);
        host.session.post(input(Kind::press));
        host.session.post(input(Kind::release));
        host.wait();
        CHECK(host.lines.empty());
    }
    const std::string text = content_of(record);
    CHECK(text.find("open = { \"models/ball.obj\" }") != std::string::npos);
    CHECK(text.find("{ \"tool\", \"pull.lua\"") != std::string::npos);
    // All of it is moved.
    test::ProgramFolder moved;
    std::filesystem::copy(outside.path(""), moved.path(""),
                          std::filesystem::copy_options::recursive);
    test::SessionHost again;
    CHECK(play_all(again, moved.path("events.lua")) > 3);
    CHECK(again.says(LineKind::result, "come to the scene that was recorded"));
    std::filesystem::remove(moved.path("pull.lua"));
    again.lines.clear();
    play_all(again, moved.path("events.lua"));
    CHECK(again.says(LineKind::error, "pull.lua"));
    std::filesystem::remove(moved.path("models/ball.obj"));
    again.lines.clear();
    CHECK(play_all(again, moved.path("events.lua")) == 0);
    CHECK(again.says(LineKind::error, "the recording needs a file that cannot be opened"));
    CHECK(again.says(LineKind::error, "models/ball.obj"));
}

TEST_CASE("session: a journal is a script of calls that comes to the same scene") {
    test::ProgramFolder outside;
    const std::string journal = outside.path("calls.lua");
    ToolHost host({.journal = journal});
    host.open(host.folder.write("pull.lua", kPull));
    host.drag(4);
    host.drag(2);
    host.session.post(input(Kind::undo));
    host.session.show_object("ball", true);
    host.wait();
    const std::vector<Vec3> after = host.shown();
    CHECK(host.lines.empty());
    CHECK(content_of(journal).find("set_position") != std::string::npos);
    host.session.open({journal});
    host.wait();
    CHECK(host.lines.empty());
    CHECK(host.shown() == after);
}

TEST_CASE("session: the copy of a scene comes with its journal, which nobody has asked for") {
    const test::ProgramFolder outside;
    const std::string copy = outside.path("copy.lissom"), journal = outside.path("copy.lua");
    const std::string module = outside.write("shape.lua", "return { across = 6, along = 6 }");
    const std::string script =
        outside.write("scene.lua", "package.path = '" + outside.path("?.lua") +
                                       ";' .. package.path\nlocal lissom = require "
                                       "'lissom'\nreturn { ball = lissom.shapes.sphere{}, bar = "
                                       "lissom.shapes.bar((require 'shape')) }\n");
    ToolHost host;
    const auto check_copy = [&](std::size_t tells) {
        host.lines.clear();
        host.session.copy_scene(copy, journal);
        host.session.evaluate("scene:hash()");
        host.wait();
        REQUIRE(host.lines.size() == 2);
        const std::string hash = host.lines.back().text;
        for (const std::string& path : {copy, journal}) {
            test::SessionHost again;
            again.session.open({path});
            again.session.evaluate("scene:hash()");
            again.wait();
            CHECK(again.lines.size() == 2);
            CHECK(again.lines.back().text == hash);
        }
        const std::string text = content_of(journal);
        CHECK(text.find("set_position") != std::string::npos);
        std::size_t consoles = 0;
        for (std::size_t at = 0; (at = text.find("From the console", at)) != std::string::npos;
             ++at) {
            ++consoles;
        }
        CHECK(consoles == tells);
    };
    // Of files: by their whole paths, wherever the journal lies.
    host.open(host.folder.write("pull.lua", kPull));
    host.drag(4);
    check_copy(0);
    // What the console does is told, with what it needs; what it asks is not.
    host.session.evaluate("#scene");
    host.session.evaluate("local twice = 2");
    host.session.evaluate("scene:get('ball'):transform{ scale = twice }");
    host.session.evaluate("scene:get('ball'):transform{ scale = twice } missing()");
    host.wait();
    check_copy(2);
    // Of a script that returns a table and requires others.
    host.session.open({script});
    host.wait();
    ToolInput look = input(Kind::look);
    look.camera = Camera({.eye = {0.0, 0.0, 5.0}});
    look.size = {640, 480};
    host.session.post(look);
    host.session.use_tool(host.folder.path("pull.lua"));
    host.wait();
    host.drag(2);
    host.session.evaluate(
        "local b = scene:get('ball'); "
        "b:set_region('selected', b:region{ vertices = { 3, 5 } })");
    host.wait();
    check_copy(1);
    // It runs again: what stays selected is in the journal of the new scene.
    host.session.run_again({});
    host.wait();
    host.drag(1);
    check_copy(0);
    CHECK(content_of(journal).find("selected") != std::string::npos);
}

TEST_CASE(
    "session: a copy's journal that cannot be written is told, and one that is kept is enough") {
    const test::ProgramFolder outside;
    const std::string journal = outside.path("calls.lua");
    ToolHost host({.journal = journal});
    host.open(host.folder.write("pull.lua", kPull));
    host.drag(1);
    host.session.copy_scene(outside.path("copy.lissom"), outside.path("copy.lua"));
    host.wait();
    CHECK(outside.has("copy.lissom"));
    CHECK_FALSE(outside.has("copy.lua"));
    ToolHost other;
    other.open(other.folder.write("pull.lua", kPull));
    other.session.copy_scene(outside.path("copy.lissom"), "/no such folder/copy.lua");
    other.wait();
    CHECK(other.says(LineKind::error, "the journal cannot be written"));
}

TEST_CASE("session: a recording of a script's scene runs that script") {
    test::ProgramFolder outside;
    const std::string record = outside.path("events.lua");
    ToolHost host({.tool = host_tool(outside), .record = record});
    const std::string script =
        host.folder.write("scene.lua", "return { ball = require('lissom').shapes.sphere{} }");
    host.session.open({script});
    host.wait();
    ToolInput look = input(Kind::look);
    look.camera = Camera({.eye = {0.0, 0.0, 5.0}});
    look.size = {640, 480};
    host.session.post(look);
    host.drag(3);
    const std::vector<Vec3> after = host.shown();
    CHECK(host.lines.empty());
    test::SessionHost again;
    CHECK(play_all(again, record) > 5);
    CHECK(again.lines.size() == 1);
    CHECK(again.says(LineKind::result, "come to the scene that was recorded"));
    const auto shown = again.session.take_shown();
    REQUIRE(shown);
    const auto positions = shown->picture->meshes.at(0).mesh->positions();
    CHECK(std::vector<Vec3>(positions.begin(), positions.end()) == after);
}

TEST_CASE("session: a hand that moves while a script runs again is heard afterwards") {
    ToolHost host;
    host.open(host.folder.write("pull.lua", kPull));
    for (int i = 0; i < 20; ++i) {
        host.session.post(input(Kind::move, 300.0 + i));
        host.session.run_again({});
        host.session.post(input(Kind::move, 310.0 + i));
    }
    host.wait();
    host.drag(3);
    CHECK(host.state().steps == std::vector<std::string>{"pull"});
}

TEST_CASE("session: on a real model each drag is a step of the tool that is in hand by then") {
    const auto path = test::data_file("models/cow_3k.off");
    if (!path) return;
    const test::ProgramFolder outside;
    const std::string record = outside.path("events.lua");
    ToolHost host({.record = record});
    const std::string model = host.folder.path("cow.off");
    std::filesystem::copy(*path, model);
    host.session.open({model});
    host.wait();
    const std::vector<Vec3> before = host.shown();
    const Box box = host.last->bounds;
    ToolInput look = input(Kind::look);
    look.camera = Camera(
        {.eye = box.center() + Vec3(0.0, 0.0, 1.2 * box.diagonal()), .target = box.center()});
    look.size = {640, 480};
    host.session.post(look);
    // What is nearest is seen. Without waiting between them, as a hand does.
    const auto nearest = std::max_element(before.begin(), before.end(),
                                          [](auto& a, auto& b) { return a.z() < b.z(); });
    const Vec3 at = look.camera.project(*nearest, {640.0, 480.0});
    for (const char* tool : {"select", "smooth", "select", "smooth"}) {
        host.session.use_tool(tool);
        host.session.post(input(Kind::press, at.x(), at.y()));
        for (int i = 1; i <= 8; ++i) {
            host.session.post(input(Kind::move, at.x() + 3 * i, at.y() + i));
        }
        host.session.post(input(Kind::release, at.x() + 24.0, at.y() + 8.0));
    }
    host.wait();
    CHECK(host.lines.empty());
    CHECK(host.state().tool == "smooth");
    CHECK(host.state().steps == std::vector<std::string>{"select", "smooth", "select", "smooth"});
    const std::vector<Vec3> after = host.shown();
    CHECK(after != before);
    for (int i = 0; i < 4; ++i) host.session.post(input(Kind::undo));
    host.wait();
    CHECK(host.shown() == before);
    for (int i = 0; i < 4; ++i) host.session.post(input(Kind::redo));
    host.wait();
    CHECK(host.shown() == after);
    test::SessionHost again;
    play_all(again, record);
    CHECK(again.says(LineKind::result, "come to the scene that was recorded"));
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

TEST_CASE("session: a storm of Escapes leaves no step open") {
    ToolHost host;
    host.open(host.folder.write("pull.lua", kPull));
    // The pulled vertex stays in front of the camera.
    host.session.set_tool_parameter("step", 1e-3);
    host.wait();
    const std::vector<Vec3> before = host.shown();
    for (int round = 0; round < 60; ++round) {
        host.session.post(input(Kind::press));
        for (int i = 0; i < 6; ++i) {
            host.session.post(input(Kind::move, 320.0 + i));
            std::this_thread::sleep_for(std::chrono::microseconds(137 * (round % 7)));
            host.session.cancel();
        }
        host.session.post(input(Kind::release));
    }
    host.wait();
    host.lines.clear();
    host.session.post(input(Kind::cancel));
    host.session.evaluate("print('depth', scene:depth())");
    host.wait();
    CHECK(host.says(LineKind::message, "depth\t0"));
    const std::size_t steps = host.state().steps.size();
    host.drag(2);
    CHECK(host.state().steps.size() == steps + 1);
    while (host.state().place > 0) {
        host.session.post(input(Kind::undo));
        host.wait();
    }
    CHECK(host.shown() == before);
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

TEST_CASE("session: what the console changes while events are recorded is told") {
    test::ProgramFolder outside;
    ToolHost host({.record = outside.path("events.lua")});
    host.open(host.folder.write("pull.lua", kPull));
    host.session.evaluate("#scene");
    host.wait();
    CHECK_FALSE(host.says(LineKind::warning, "recording"));
    host.session.evaluate("scene:get('ball'):transform{ scale = 2 }");
    host.wait();
    CHECK(host.says(LineKind::warning, "the recording does not hold"));
}

TEST_CASE("session: a recording that cannot be written is told once") {
    ToolHost host({.record = "/no such folder/events.lua"});
    host.open(host.folder.write("pull.lua", kPull));
    host.drag(1);
    host.drag(1);
    std::size_t told = 0;
    for (const ConsoleLine& line : host.lines) {
        told += line.text.find("cannot be written") != std::string::npos ? 1 : 0;
    }
    CHECK(told == 1);
}
