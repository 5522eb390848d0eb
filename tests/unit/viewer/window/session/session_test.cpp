#include "viewer/window/session/session.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/picture_folder.h"
#include "tests/unit/viewer/window/session/session_host.h"

using namespace lissom;
using namespace lissom::window;

namespace {

using Host = test::SessionHost;

constexpr const char* kBar = "local lissom = require 'lissom'\n";

}  // namespace

TEST_CASE("session: what a script returns is shown, tables and scenes too") {
    Host host;
    host.run(std::string(kBar) + "return lissom.shapes.box{}");
    auto shown = host.take(&SessionNews::shown);
    REQUIRE(shown);
    CHECK(shown->picture->meshes.size() == 1);
    CHECK_FALSE(shown->bounds.empty());
    CHECK(host.wakes > 0);
    host.run(std::string(kBar) +
             "local box = lissom.shapes.box{}\n"
             "return { box, again = box, { deeper = lissom.shapes.torus{} } }");
    shown = host.take(&SessionNews::shown);
    REQUIRE(shown);
    CHECK(shown->picture->meshes.size() == 2);
    host.run(std::string(kBar) +
             "local scene = lissom.scene{}\n"
             "scene:add('box', lissom.shapes.box{}, { transform = "
             "{ {1, 0, 0, 5}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1} } })\n"
             "return scene");
    shown = host.take(&SessionNews::shown);
    REQUIRE(shown);
    REQUIRE(shown->picture->meshes.size() == 1);
    CHECK(shown->bounds.center().x() == doctest::Approx(5.0));
    CHECK(host.lines.empty());
}

TEST_CASE("session: what is shown stays as it was whatever the script does then") {
    Host host;
    host.run(std::string(kBar) + "box = lissom.shapes.box{}\nreturn box");
    const auto shown = host.take(&SessionNews::shown);
    REQUIRE(shown);
    const Vec3 before = shown->picture->meshes[0].mesh->position(0);
    host.session.evaluate("box:transform{ translate = {9, 9, 9} }");
    host.wait();
    CHECK(shown->picture->meshes[0].mesh->position(0) == before);
    const auto moved = host.take(&SessionNews::shown);
    REQUIRE(moved);
    CHECK(moved->number > shown->number);
    CHECK(moved->picture->meshes[0].mesh->position(0).x() == doctest::Approx(before.x() + 9.0));
}

TEST_CASE("session: parameters come with the script, and its command line sets them") {
    Host host;
    host.run(std::string(kBar) +
                 "local p = lissom.params{ size = { type = 'number', default = 1, min = 0.1, "
                 "max = 9 } }\nprint('size', p.size)\nreturn lissom.shapes.box{}",
             {"--size=3"});
    const auto parameters = host.take(&SessionNews::parameters);
    REQUIRE(parameters);
    REQUIRE(parameters->size() == 1);
    CHECK(std::get<double>(*parameters->front().value) == 3.0);
    CHECK(host.says(LineKind::message, "size\t3"));
    host.session.run_again({"--size=4"});
    host.wait();
    CHECK(host.says(LineKind::message, "size\t4"));
}

TEST_CASE("session: an error tells file and line, and what was shown is not taken away") {
    Host host;
    host.run(std::string(kBar) + "return lissom.shapes.box{}");
    REQUIRE(host.take(&SessionNews::shown));
    host.run("local x = nil\nx()");
    CHECK(host.says(LineKind::error, "script.lua:2:"));
    CHECK_FALSE(host.take(&SessionNews::shown));
    host.run("this is no Lua");
    CHECK(host.says(LineKind::error, "script.lua:1:"));
    host.run("print 'nothing to see'");
    CHECK(host.says(LineKind::warning, "shows nothing"));
    host.session.open({host.folder.path("missing.obj")});
    host.wait();
    CHECK(host.says(LineKind::error, "[file_not_found]"));
    host.session.open({host.folder.write("broken.ply", "ply\nnonsense")});
    host.wait();
    CHECK(host.says(LineKind::error, "broken.ply"));
}

TEST_CASE("session: a script that has broken its globals ends well") {
    Host host;
    host.run(
        "package = nil; require = nil; setmetatable(_G, { __index = function() error('no') end })");
    host.session.evaluate("1 + 1");
    host.wait();
    CHECK(host.says(LineKind::result, "2"));
}

TEST_CASE("session: nothing that a script does holds it up for long") {
    for (const char* text :
         {"print 'on'\nwhile true do end",
          "print 'on'\nwhile true do pcall(function() while true do end end) end",
          "print 'on'\nlocal c = coroutine.wrap(function() while true do end end)\nc()",
          "local lissom = require 'lissom'\nprint 'on'\nlocal m = "
          "lissom.shapes.torus{}:subdivide(4)\n"
          "while true do m:smooth{ iterations = 1000 } end"}) {
        CAPTURE(text);
        Host host;
        // The second script of a session is stopped as the first one is.
        host.run("return 1");
        host.lines.clear();
        host.session.open({host.folder.write("script.lua", text)});
        host.wait_for_line();
        CHECK(host.session.busy());
        host.session.cancel();
        CHECK(host.wait() < 5000.0);
        // It works again at once.
        host.session.evaluate("6 * 7");
        host.wait();
        CHECK(host.says(LineKind::result, "42"));
    }
}

TEST_CASE("session: a new run gives up the old one, and the last of many is done") {
    Host host;
    host.session.open({host.folder.write("script.lua", "print 'on'\nwhile true do end")});
    host.wait_for_line();
    host.folder.write("script.lua", "print('word', ...)");
    for (int i = 0; i < 50; ++i) host.session.run_again({std::to_string(i)});
    host.wait();
    CHECK(host.says(LineKind::message, "word"));
    std::size_t runs = 0;
    for (const ConsoleLine& line : host.lines) runs += line.text.starts_with("word") ? 1 : 0;
    CHECK(runs < 50);
}

TEST_CASE("session: warnings that differ in their numbers alone are one line") {
    std::vector<ConsoleLine> lines;
    add_line(lines, {LineKind::warning, "12 of 500 strands left the volume"});
    add_line(lines, {LineKind::warning, "251 of 500 strands left the volume"});
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].text == "251 of 500 strands left the volume");
    CHECK(lines[0].times == 2);
    add_line(lines, {LineKind::warning, "a tail left the volume"});
    add_line(lines, {LineKind::message, "1"});
    add_line(lines, {LineKind::message, "2"});
    add_line(lines, {LineKind::warning, "7 of 500 strands left the volume"});
    CHECK(lines.size() == 5);
    CHECK(lines.back().times == 1);
}

TEST_CASE("session: the console has the library, and keeps its variables") {
    Host host;
    host.session.evaluate("local t = lissom.shapes.torus{}");
    host.session.evaluate("#t > 10");
    host.wait();
    CHECK(host.says(LineKind::result, "true"));
    host.session.evaluate("t");
    host.wait();
    CHECK(host.take(&SessionNews::shown));
    host.session.evaluate("t:nothing()");
    host.wait();
    CHECK(host.says(LineKind::error, "nothing"));
}

TEST_CASE("session: lines are completed from what can be called and from the script's variables") {
    Host host;
    const auto words_for = [&](const std::string& text) {
        host.session.complete(text);
        host.wait();
        const auto completion = host.take(&SessionNews::completion);
        REQUIRE(completion);
        CHECK(completion->text == text);
        return completion->found.words;
    };
    const auto has = [](const std::vector<std::string>& words, const std::string& word) {
        return std::find(words.begin(), words.end(), word) != words.end();
    };
    // Before anything has run.
    CHECK(has(words_for("lissom.sha"), "shapes"));
    CHECK(has(words_for("lissom.render{ me"), "mesh = "));
    host.run(std::string(kBar) + "my_mesh = lissom.shapes.box{}");
    CHECK(words_for("my_") == std::vector<std::string>{"my_mesh"});
    CHECK(has(words_for("my_mesh:sub"), "subdivide"));
    CHECK(words_for("nothing_like_this").empty());
    CHECK_FALSE(host.take(&SessionNews::completion));
    // What runs goes on, and the answer comes after it.
    host.lines.clear();
    host.session.open({host.folder.write("script.lua", "print 'on'\nwhile true do end")});
    host.wait_for_line();
    host.session.complete("lissom.sha");
    CHECK_FALSE(host.take(&SessionNews::completion));
    host.session.cancel();
    host.wait();
    CHECK(host.take(&SessionNews::completion));
}

TEST_CASE("session: mesh files are turned and scaled as they are asked to be, in recordings too") {
    const test::ProgramFolder folder;
    LoadOptions options;
    options.up = UpAxis::z;
    options.unit = 10.0;
    Host host({.record = folder.path("done.lua"), .load = options});
    host.session.open({folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 0 2\nf 1 2 3\n")});
    host.wait();
    const auto shown = host.take(&SessionNews::shown);
    REQUIRE(shown);
    CHECK(shown->bounds.max.y() == doctest::Approx(20.0));
    CHECK(shown->bounds.max.x() == doctest::Approx(10.0));
    REQUIRE(folder.has("done.lua"));
    host.session.evaluate("dofile('" + folder.path("done.lua") + "')");
    host.wait();
    for (const ConsoleLine& line : host.lines) CHECK(line.kind != LineKind::error);
}

TEST_CASE("session: what a script requires is read for it") {
    Host host;
    host.folder.write("part.lua", "return 5");
    host.run("print(require 'part')");
    bool found = false;
    for (const auto& file : host.session.files()) found = found || file.filename() == "part.lua";
    CHECK(found);
}

TEST_CASE("session: what a script draws is shown, but for a picture that cannot be written") {
    Host host;
    const std::string boxes =
        "lissom.render{ meshes = { lissom.shapes.box{}, lissom.shapes.torus{} }, "
        "columns = 2, size = { 64, 48 }, file = ";
    host.run(std::string(kBar) + boxes + "'/nowhere/a.png' }");
    CHECK_FALSE(host.take(&SessionNews::shown));
    if (!test::can_draw()) return;
    host.run(std::string(kBar) + boxes + "'" + host.folder.path("a.png") + "' }");
    const auto shown = host.take(&SessionNews::shown);
    REQUIRE(shown);
    CHECK(shown->picture->meshes.size() == 2);
    CHECK_FALSE(host.says(LineKind::warning, "shows nothing"));
}
