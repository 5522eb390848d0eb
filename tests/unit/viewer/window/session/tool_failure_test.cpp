// Tools that fail, hang or ask: the scene stays, and other tools work.
#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/viewer/window/session/tool_host.h"

using namespace lissom;
using namespace lissom::window;
using namespace lissom::test;

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
