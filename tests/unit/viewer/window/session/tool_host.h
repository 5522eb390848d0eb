/// A session with a tool in hand, for tests.
#pragma once

#include <cstddef>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "kernel/io/mesh_file.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/window/session/session_host.h"
#include "viewer/window/tools/tool_input.h"

namespace lissom::test {

using Kind = window::ToolInput::Kind;

// Pulls the vertex under the cursor.
inline constexpr const char* kPull = R"(local lissom = require "lissom"
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

inline window::ToolInput input(Kind kind, double x = 320.0, double y = 240.0) {
    window::ToolInput made;
    made.kind = kind;
    made.at = {x, y};
    return made;
}

inline window::ToolInput key(const char* name) {
    window::ToolInput made;
    made.kind = Kind::key;
    made.key = name;
    return made;
}

// A session with a ball in front of its camera.
struct ToolHost : SessionHost {
    explicit ToolHost(window::SessionOptions chosen = {}) : SessionHost(std::move(chosen)) {
        save_mesh(make_sphere(), ball);
    }

    std::string ball = folder.path("ball.obj");

    void open(const std::string& tool = {}) {
        session.open({ball});
        wait();
        window::ToolInput look = input(Kind::look);
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
        if (auto next = take(&window::SessionNews::shown)) last = std::move(next);
        REQUIRE(last);
        REQUIRE(last->picture->meshes.size() == 1);
        const auto positions = last->picture->meshes[0].mesh->positions();
        return {positions.begin(), positions.end()};
    }
    window::ToolState state() {
        if (auto next = take(&window::SessionNews::tool_state)) known = std::move(*next);
        return known;
    }
    std::optional<window::Shown> last;
    window::ToolState known;
};

inline constexpr const char* kGhost = R"(local lissom = require "lissom"
local box = lissom.shapes.box()
local place = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 3 }, { 0, 0, 0, 1 } }
return lissom.tool{ name = "ghost",
    press = function(self) self.held = true end,
    release = function(self) self.held = false end,
    draw = function(self, view)
        if self.held then view:mesh{ mesh = box, transform = place, color = "#ff0000" } end
    end }
)";

inline window::ToolInput played(std::size_t event) {
    window::ToolInput made;
    made.kind = Kind::play;
    made.event = event;
    return made;
}

// Opens a recording and plays all of it; the number of its events.
inline std::size_t play_all(SessionHost& host, const std::string& record) {
    host.session.open({record});
    host.wait();
    const auto playback = host.take(&window::SessionNews::playback);
    if (!playback) return 0;
    for (std::size_t i = 0; i < playback->times.size(); ++i) host.session.post(played(i));
    host.wait();
    return playback->times.size();
}

inline std::string host_tool(const ProgramFolder& folder) {
    return folder.write("pull.lua", kPull);
}

inline std::string content_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

}  // namespace lissom::test
