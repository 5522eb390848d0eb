// What tools do, as recordings and journals that repeat it.
#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/viewer/window/session/tool_host.h"

using namespace lissom;
using namespace lissom::window;
using namespace lissom::test;

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
    const auto playback = host.take(&SessionNews::playback);
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
    const auto shown = again.take(&SessionNews::shown);
    REQUIRE(shown);
    const auto positions = shown->picture->meshes.at(0).mesh->positions();
    CHECK(std::vector<Vec3>(positions.begin(), positions.end()) == after);
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
