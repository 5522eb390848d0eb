// Gestures with tools: what a hand does reaches them in order and becomes steps.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/unit/support.h"
#include "tests/unit/viewer/window/session/tool_host.h"

using namespace lissom;
using namespace lissom::window;
using namespace lissom::test;

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

TEST_CASE("session: hovering shows nothing new where a tool draws the same") {
    ToolHost host;
    host.open(host.folder.write("pull.lua", kPull));
    host.drag(1);
    (void)host.shown();
    for (int i = 0; i < 5; ++i) {
        host.session.post(input(Kind::move, 10.0 * i));
        host.wait();
    }
    CHECK_FALSE(host.take(&SessionNews::shown));
}

TEST_CASE("session: a mesh that a tool draws is seen while it does, and is no object") {
    ToolHost host;
    host.open(host.folder.write("ghost.lua", kGhost));
    host.take(&SessionNews::shown);
    host.session.post(input(Kind::press));
    host.wait();
    const auto held = host.take(&SessionNews::shown);
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
