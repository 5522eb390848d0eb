#include "viewer/window/session/source_place.h"

#include <doctest/doctest.h>

#include <chrono>
#include <set>
#include <thread>

using namespace lissom::window;
using Words = std::vector<std::string>;

namespace {

std::optional<SourcePlace> find(const std::string& text) {
    const std::set<std::string> files{"a.lua", "/my files/b c.lua", "c.lua", "scan.obj"};
    return find_place(text, [&](const std::string& name) { return files.contains(name); });
}

// What was started, by whoever opens a place.
struct Desk {
    std::string visual, editor, answer;
    Words started;

    std::string open(const SourcePlace& place) {
        const EditorHost host{[this](const char* name) -> const char* {
                                  const std::string& value =
                                      std::string(name) == "VISUAL" ? visual : editor;
                                  return value.empty() ? nullptr : value.c_str();
                              },
                              [this](const Words& words) {
                                  started = words;
                                  return answer;
                              }};
        return open_in_editor(place, host);
    }
};

}  // namespace

TEST_CASE("source places: a file that is there and a line") {
    CHECK(find("a.lua:12: attempt to call a nil value") == SourcePlace{"a.lua", 12});
    CHECK(find("error in 'c.lua:3' of many") == SourcePlace{"c.lua", 3});
    CHECK(find("/my files/b c.lua:7: no") == SourcePlace{"/my files/b c.lua", 7});
    CHECK(find("see /my files/b c.lua:7") == SourcePlace{"/my files/b c.lua", 7});
    CHECK(find("12:30 missing.lua:4: but a.lua:5: calls") == SourcePlace{"a.lua", 5});
    CHECK(find("scan.obj:1: bad vertex") == SourcePlace{"scan.obj", 1});
    CHECK_FALSE(find("missing.lua:4: no"));
    CHECK_FALSE(find("a.lua has 4 lines: none"));
    CHECK_FALSE(find("a.lua:0"));
    CHECK_FALSE(find("xa.lua:3"));
    CHECK_FALSE(find(":3"));
    CHECK_FALSE(find("a.lua:"));
    CHECK(find("a.lua:99999999999999999999")->line > 0);
}

TEST_CASE("source places: every editor is told the line in its own way") {
    const SourcePlace place{"a b.lua", 12};
    CHECK(editor_command("vim", place) == Words{"vim", "+12", "a b.lua"});
    CHECK(editor_command("emacsclient -n", place) == Words{"emacsclient", "-n", "+12", "a b.lua"});
    CHECK(editor_command("/usr/bin/code --wait", place) ==
          Words{"/usr/bin/code", "--wait", "-g", "a b.lua:12"});
    CHECK(editor_command("subl", place) == Words{"subl", "a b.lua:12"});
    CHECK(editor_command("kate", place) == Words{"kate", "-l", "12", "a b.lua"});
    CHECK(editor_command(" ", place).empty());
    // The name of a file is never an option, and a shell never sees it.
    CHECK(editor_command("vi", {"-c:!rm.lua", 1}) == Words{"vi", "+1", "./-c:!rm.lua"});
    CHECK(editor_command("vi", {"$(rm x);.lua", 1}) == Words{"vi", "+1", "$(rm x);.lua"});
}

TEST_CASE("source places: VISUAL comes before EDITOR, and without both a person is told") {
    Desk desk;
    CHECK(desk.open({"a.lua", 2}).find("VISUAL or EDITOR") != std::string::npos);
    CHECK(desk.started.empty());
    desk.editor = "nano";
    CHECK(desk.open({"a.lua", 2}).empty());
    CHECK(desk.started == Words{"nano", "+2", "a.lua"});
    desk.visual = "gedit";
    CHECK(desk.open({"a.lua", 2}).empty());
    CHECK(desk.started.front() == "gedit");
    desk.answer = "it is not there";
    CHECK(desk.open({"a.lua", 2}) == "the editor of $VISUAL: it is not there");
}

TEST_CASE("source places: programs that do not start or end badly are told") {
    StartedPrograms programs;
    CHECK(programs.start({"/nowhere/editor", "x"}).find("does not start") != std::string::npos);
    CHECK(programs.start({"true"}).empty());
    CHECK(programs.start({"false"}).empty());
    Words failures;
    for (int i = 0; i < 500 && failures.empty(); ++i) {
        failures = programs.failures();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    CHECK(failures == Words{"'false' ended with an error"});
}
