#include "viewer/window/view_arguments.h"

#include <doctest/doctest.h>

#include "tests/unit/bindings/cli/program_run.h"

using namespace lissom;
using window::split_arguments;

namespace {

using Words = std::vector<std::string>;

void check_split(const Words& words, const Words& own, const Words& scripts) {
    const window::ViewArguments split = split_arguments(words);
    CHECK(split.own == own);
    CHECK(split.scripts == scripts);
}

}  // namespace

TEST_CASE("view words: all are the window's where no script is named") {
    check_split({}, {}, {});
    check_split({"a.obj", "b.obj", "--size", "800x600"}, {"a.obj", "b.obj", "--size", "800x600"},
                {});
    check_split({"a.obj", "--tool", "select"}, {"a.obj", "--tool", "select"}, {});
    // Nothing that could be told apart.
    check_split({"a.obj", "--", "b.obj"}, {"a.obj", "--", "b.obj"}, {});
}

TEST_CASE("view words: behind a script they are the script's, but for tools and records") {
    check_split({"--tell", "s.lua", "--size=2", "x.obj"}, {"--tell", "s.lua"},
                {"--size=2", "x.obj"});
    check_split({"s.lua", "--tool", "select", "--n", "3"}, {"s.lua", "--tool", "select"},
                {"--n", "3"});
    check_split({"s.lua", "--n=3", "--tool=select", "--journal=j.lua"},
                {"s.lua", "--tool=select", "--journal=j.lua"}, {"--n=3"});
    check_split({"s.lua", "--record", "e.lua", "--journal", "j.lua", "x"},
                {"s.lua", "--record", "e.lua", "--journal", "j.lua"}, {"x"});
    // Options that only begin like these.
    check_split({"s.lua", "--tools", "a", "--recorder=b"}, {"s.lua"},
                {"--tools", "a", "--recorder=b"});
    check_split({"s.lua", "--tool"}, {"s.lua", "--tool"}, {});
}

TEST_CASE("view words: what an option is given is no script, and no option") {
    check_split({"--tool", "own.lua", "a.obj", "x"}, {"--tool", "own.lua", "a.obj", "x"}, {});
    check_split({"--tool", "own.lua", "s.lua", "x"}, {"--tool", "own.lua", "s.lua"}, {"x"});
    check_split({"--record", "e.lua", "a.obj"}, {"--record", "e.lua", "a.obj"}, {});
    check_split({"s.lua", "--record", "--tool", "x"}, {"s.lua", "--record", "--tool"}, {"x"});
    check_split({"s.lua", "--tool", "--", "x"}, {"s.lua", "--tool", "--"}, {"x"});
}

TEST_CASE("view words: behind a double dash all are the script's") {
    check_split({"s.lua", "--", "--tool", "select", "--"}, {"s.lua"}, {"--tool", "select", "--"});
    check_split({"s.lua", "a", "--tool=cut", "--", "--record=x"}, {"s.lua", "--tool=cut"},
                {"a", "--record=x"});
    check_split({"s.lua", "--"}, {"s.lua"}, {});
}

TEST_CASE("view words: a second script is a word of the first, a recording is the window's") {
    check_split({"s.lua", "t.lua"}, {"s.lua"}, {"t.lua"});
    const test::ProgramFolder folder;
    const std::string events =
        folder.write("events.lua", "-- What a hand did.\nreturn (require(\"lissom\").replay{})\n");
    check_split({events, "--speed", "2"}, {events, "--speed", "2"}, {});
}
