// Tools of a session: which there are, which is in hand, and their parameters.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/unit/viewer/window/session/tool_host.h"
#include "viewer/window/panel/tool_panel.h"
#include "viewer/window/tools/tool_list.h"

using namespace lissom;
using namespace lissom::window;
using namespace lissom::test;

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
    host.take(&SessionNews::tool_state);
    host.session.find_tools({pull, bad, plain, push});
    host.wait();
    const auto tools = host.take(&SessionNews::tools);
    REQUIRE(tools.size() == 2);
    CHECK(tools[0] == std::pair<std::string, std::string>{pull, "pull"});
    CHECK(tools[1] == std::pair<std::string, std::string>{push, "pusher"});
    CHECK(host.take(&SessionNews::tools).empty());
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

TEST_CASE("session: a tool that is opened is taken in hand, and the scene stays") {
    ToolHost host;
    host.open("select");
    host.drag(1);
    const ToolState before = host.state();
    host.take(&SessionNews::opened);
    const std::string own = host_tool(host.folder);
    host.session.open({own});
    host.wait();
    CHECK_FALSE(host.take(&SessionNews::opened));
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
