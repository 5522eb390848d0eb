#include "bindings/cli/program.h"

#include <csignal>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bindings/lua/core/compat.h"
#include "tests/unit/bindings/cli/program_run.h"
#include "tests/unit/support.h"

namespace lissom::cli {
namespace {

using Json = nlohmann::json;
using test::Ended;
using Folder = test::ProgramFolder;

Ended run(const std::vector<std::string>& words) {
    return test::run_program(words);
}

const char* const kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const char* const kTwisted = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n";

TEST_CASE("the command line itself") {
    CHECK(run({}).status == kUsage);
    CHECK(run({"--help"}).status == kSuccess);
    CHECK(run({"--help"}).out.find("lissom inspect FILE...") != std::string::npos);
    CHECK(run({"--version"}).out.find("lissom ") == 0);
    CHECK(Json::parse(run({"--version", "--json"}).out)["name"] == "lissom");
    const Ended unknown = run({"inspct"});
    CHECK(unknown.status == kUsage);
    CHECK(unknown.err == "lissom: no verb 'inspct', did you mean 'inspect'?\n");
    CHECK(run({"demo.lua"}).err.find("lissom run demo.lua") != std::string::npos);
    for (const Verb& verb : kernel_parts().verbs) {
        CAPTURE(verb.name);
        const Ended help = run({verb.name, "--help"});
        CHECK(help.status == kSuccess);
        CHECK(help.out.find("--json") != std::string::npos);
        CHECK(run({verb.name, "--no-such-option"}).status == kUsage);
    }
}

TEST_CASE("help prints the usage of a verb, and of the function of its name") {
    for (const Verb& verb : kernel_parts().verbs) {
        CAPTURE(verb.name);
        const std::string usage = run({verb.name, "--help"}).out;
        CHECK(run({"help", verb.name}).out.find(usage) == 0);
        const Json json = Json::parse(run({"help", verb.name, "--json"}).out);
        CHECK(json["help"].get<std::string>().find(usage) == 0);
    }
    CHECK(run({"help", "inspct"}).err.find("did you mean 'inspect'?") != std::string::npos);
    CHECK(run({"help", "test"}).out.find("lissom test") != std::string::npos);
    CHECK(run({"help", "deformer.report"}).out.find("deformer:report") == 0);
}

TEST_CASE("inspect answers in text and JSON") {
    const Folder folder;
    const std::string good = folder.write("a.obj", kTriangle);
    const std::string bad = folder.write("b.obj", kTwisted);
    CHECK(run({"inspect", good}).status == kSuccess);
    CHECK(run({"inspect", bad}).status == kSuccess);
    CHECK(run({"inspect", bad, "--no-repair"}).status == kFailure);
    const Ended both =
        run({"inspect", good, bad, folder.path("none.obj"), "--no-repair", "--json"});
    CHECK(both.status == kFailure);
    const Json answer = Json::parse(both.out);
    CHECK(answer["meshes"][0]["vertices"] == 3);
    CHECK(answer["meshes"][0]["boundaries"][0]["vertices"] == 3);
    CHECK(answer["meshes"][0]["bounds"]["max"][0] == 1.0);
    const Json& error = answer["meshes"][1]["error"];
    CHECK(error["code"] == "inconsistent_orientation");
    CHECK(error["elements"]["ids"] == Json::parse("[[1, 2]]"));
    CHECK(answer["meshes"][2]["error"]["code"] == "file_not_found");
    CHECK(Json::parse(run({"inspect", "--json"}).out)["error"]["code"] == "usage");
}

TEST_CASE("convert writes another format") {
    const Folder folder;
    const std::string in = folder.write("a.obj", kTriangle);
    const Ended ended = run({"convert", in, folder.path("a.ply"), "--unit", "0.5", "--json"});
    CHECK(ended.status == kSuccess);
    CHECK(Json::parse(ended.out)["vertices"] == 3);
    const Json answer = Json::parse(run({"inspect", folder.path("a.ply"), "--json"}).out);
    CHECK(answer["meshes"][0]["bounds"]["max"][0] == 2.0);
    CHECK(run({"convert", in}).status == kUsage);
    CHECK(run({"convert", in, folder.path("a.ply"), "--unit", "0"}).status == kUsage);
    CHECK(run({"convert", in, folder.path("a.nope")}).status == kFailure);
    const Ended missing = run({"convert", folder.path("x.obj"), folder.path("y.obj"), "--json"});
    CHECK(missing.status == kFailure);
    CHECK(Json::parse(missing.out)["error"]["code"] == "file_not_found");
}

TEST_CASE("explain knows every code") {
    for (const ErrorCode code : all_codes()) {
        const Ended ended = run({"explain", std::string(code_name(code)), "--json"});
        CHECK(ended.status == kSuccess);
        CHECK(Json::parse(ended.out)["code"] == std::string(code_name(code)));
    }
    CHECK(Json::parse(run({"explain", "--json"}).out)["codes"].size() == all_codes().size());
    CHECK(run({"explain", "unconstraned"}).err.find("did you mean 'unconstrained'?") !=
          std::string::npos);
}

TEST_CASE("a recording that is run says that it went well, and where it did not") {
    const Folder folder;
    const std::string make = folder.write("make.lua", R"(local lissom = require "lissom"
local ball = lissom.shapes.sphere()
assert(ball:save(arg[1] .. "/ball.ply"))
local scene = lissom.scene{}
scene:add("ball", ball)
local camera = lissom.camera{ eye = { 0, 0, 5 } }
local host = lissom.tool_host{ scene = scene, camera = camera }:record{ "ball.ply" }
host:use(lissom.load_tool(arg[2]), "tool.lua")
host:click{ x = 640, y = 480 }
io.open(arg[1] .. "/events.lua", "w"):write(host:recording()):close())");
    const std::string tool = R"(return require("lissom").tool{ name = "mark",
    press = function(_, ev) ev:hit().mesh:set_position(1, 0, 0, HEIGHT) end })";
    const auto with_height = [&](const std::string& height) {
        return folder.write("tool.lua", "local HEIGHT = " + height + "\n" + tool);
    };
    const Ended made = run({"run", make, folder.path(""), with_height("1.5")});
    REQUIRE_MESSAGE(made.status == kSuccess, made.err);
    const std::string events = folder.path("events.lua");
    CHECK(run({"run", events}).out.find("the scene is as it was recorded") != std::string::npos);
    with_height("2.5");
    const Ended other = run({"run", events});
    CHECK(other.status == kFailure);
    CHECK(other.out.empty());
    CAPTURE(other.err);
    CHECK(other.err.find("the recording differs") != std::string::npos);
    // The press is on the ninth line of the file; with the release the ball has moved.
    CHECK(other.err.find("events.lua:10: 'ball' differs: ") != std::string::npos);
    with_height("\"high\"");
    const Ended failed = run({"run", events});
    CAPTURE(failed.err);
    CHECK(failed.err.find("tool.lua:3: event 3, press: ") != std::string::npos);
    CHECK(failed.err.find("(the event is events.lua:9)") != std::string::npos);
    CHECK(failed.err.find("lissom tools") == std::string::npos);
}

TEST_CASE("a new tool runs as it is written, and nothing is overwritten") {
    const Folder folder;
    CHECK(run({"new", "tool", folder.path("bulge")}).status == kSuccess);
    REQUIRE(folder.has("bulge.lua"));
    const std::string script = folder.write("try.lua", R"(local lissom = require "lissom"
local scene = lissom.scene{}
local ball = scene:add("ball", lissom.shapes.sphere())
local tool = lissom.load_tool(arg[1])
local before, low = scene:hash(), ball:bounds().max[3]
local camera = lissom.camera{ eye = { 0, 0, 5 } }
local host = lissom.tool_host{ scene = scene, camera = camera, tool = tool }
host:move{ x = 640, y = 480 }:press{ x = 640, y = 480 }:move{ x = 641, y = 480 }
host:release{ x = 641, y = 480 }
assert(#host:draw().circles == 1 and tool.name == "bulge")
assert(ball:bounds().max[3] > low and host:undo() == "bulge" and scene:hash() == before))");
    const Ended ended = run({"run", script, folder.path("bulge.lua")});
    CHECK(ended.err == "");
    CHECK(ended.status == kSuccess);
    CHECK(run({"new", "tool", folder.path("bulge")}).err.find("exists already") !=
          std::string::npos);
    CHECK(run({"new", "tool", folder.path("no folder/bulge")}).status == kFailure);
    CHECK(run({"new", "tool", folder.path("a name")}).status == kUsage);
    CHECK(run({"new", "toll", "a"}).err.find("there is: tool") != std::string::npos);
}

TEST_CASE("scripts end with a status and the place of their error") {
    const Folder folder;
    const auto ends = [&](const std::string& code, std::vector<std::string> words = {}) {
        words.insert(words.begin(), {"run", folder.write("s.lua", code)});
        Ended ended = run(words);
        for (std::size_t at; (at = ended.err.find(folder.path(""))) != std::string::npos;) {
            ended.err.erase(at, folder.path("").size());
        }
        return ended;
    };
    CHECK(ends("local lissom = require 'lissom'").status == kSuccess);
    CHECK(ends("\nerror('no')").err == "s.lua:2: no\n");
    CHECK(ends("\nerror('no')").status == kFailure);
    // A value without a text is told by its type, never by its address.
    CHECK(ends("\nerror{}").err == "s.lua:2: the error is a table without a text\n");
    CHECK(ends("error(print)").err == "s.lua:1: the error is a function without a text\n");
    CHECK(ends("error(setmetatable({}, { __tostring = function() return 'own' end }))").err ==
          "s.lua:1: own\n");
    const std::string flood = ends("error(('x'):rep(5e6))").err;
    CHECK(flood.size() < 70'000);
    CHECK(flood.find("... (4882 KB)") != std::string::npos);
    for (const std::string before : {"", "a", "ab"}) {
        const std::string cut = ends("error('" + before + "' .. ('\xc3\xa9'):rep(1e6))").err;
        CHECK(cut.find("\xc3\xa9... (") != std::string::npos);
    }
    CHECK(ends("x = = 1").err.find("s.lua:1:") == 0);
    CHECK(ends("\n\nassert(require 'lissom'.load('none.obj'))").err.find("s.lua:3: none.obj") == 0);
    folder.write("part.lua", "return function()\n  local t\n  return t.x\nend");
    CHECK(ends("require 'part'()").err.find("part.lua:3: attempt to index a nil") == 0);
    CHECK(run({"run", folder.path("s.lua"), "--debug"}).err.find("traceback") == std::string::npos);
    CHECK(run({"run", "--debug", folder.path("s.lua")}).err.find("traceback") != std::string::npos);
    CHECK(run({"run", folder.path("none.lua")}).status == kFailure);
    CHECK(run({"run"}).status == kUsage);
}

TEST_CASE("a script that uses lissom without loading it is told how to") {
    const Folder folder;
    const auto message = [&](const std::string& text) {
        return run({"run", folder.write("s.lua", text)}).err;
    };
    const std::string hint =
        "\na script loads the library first: local lissom = require \"lissom\"\n";
    for (const char* text : {"local m = lissom.shapes.box()", "lissom()"}) {
        const std::string told = message(text);
        CHECK(told.find("s.lua:1: attempt to ") != std::string::npos);
        CHECK(told.ends_with("a nil value (global 'lissom')" + hint));
    }
    CHECK(message("local box = bax.box").find("require") == std::string::npos);
    CHECK(message("require 'lissom'\nassert(lissom == nil)").empty());
}

TEST_CASE("a script ends at the first failure, with its place and status 1") {
    const Folder folder;
    const std::string script =
        folder.write("s.lua",
                     "local lissom = require 'lissom'\nlocal box = lissom.shapes.box()\n"
                     "lissom.try(box.save, box, 'no/folder.obj')\nprint('goes on')\n"
                     "box:save('no/folder.obj')\nprint('never')\n");
    const Ended ended = run({"run", script});
    CHECK(ended.status == kFailure);
    CHECK(ended.err.find(script + ":5: no/folder.obj: ") == 0);
    CHECK(ended.err.ends_with(" [file_write_failed]\n"));
    const Ended json = run({"run", "--json", script});
    const Json error = Json::parse(json.err.substr(json.err.rfind("{\"error\"")))["error"];
    CHECK(error["code"] == "file_write_failed");
    CHECK(error["file"] == script);
    CHECK(error["line"] == 5);
    for (const char* last : {"require 'lissom'.shapes.box{}:save('no/such/x.obj')",
                             "return require 'lissom'.shapes.box{}:save('no/such/x.obj')",
                             "local _ = require 'lissom'.shapes.box{}:save('no/such/x.obj')"}) {
        const std::string path = folder.write("t.lua", last);
        const Ended told = run({"run", path});
        CHECK(told.status == kFailure);
        CHECK(told.err.find(path + ":1: no/such/x.obj: ") == 0);
    }
    const std::string good = folder.write("u.lua", "return require 'lissom'.shapes.box()");
    CHECK(run({"run", good}).status == kSuccess);
    const Ended traced = run({"run", "--debug", script});
    CHECK(traced.err.find(script + ":5: in main chunk") != std::string::npos);
}

TEST_CASE("a missing file gets the nearest name") {
    const Folder folder;
    const std::string mesh = folder.write("models/armadillo.obj", kTriangle);
    folder.write("first.lua", "local x = 1");
    const auto said = [&](const std::vector<std::string>& words) {
        const Ended ended = run(words);
        CHECK(ended.status == kFailure);
        return ended.err;
    };
    CHECK(
        said({"run", folder.path("frist.lua")}).find("did you mean '" + folder.path("first.lua")) !=
        std::string::npos);
    CHECK(said({"inspect", folder.path("models/armadilo.obj")})
              .find("did you mean '" + mesh + "'?") != std::string::npos);
    CHECK(said({"inspect", folder.path("models/armadillo")}).find("did you mean '" + mesh + "'?") !=
          std::string::npos);
    CHECK(said({"inspect", folder.path("model/armadillo.obj")})
              .find("there is no folder '" + folder.path("model") + "', did you mean '" +
                    folder.path("models") + "'?") != std::string::npos);
}

TEST_CASE("errors of scripts as JSON") {
    const Folder folder;
    const std::string script =
        folder.write("s.lua", "local lissom = require 'lissom'\nlissom.load('none.obj')");
    const Ended ended = run({"run", "--json", script});
    const Json error = Json::parse(ended.err)["error"];
    CHECK(error["file"] == script);
    CHECK(error["line"] == 2);
    CHECK(error["code"] == "file_not_found");
    CHECK(ended.status == kFailure);
}

TEST_CASE("scripts have parameters") {
    const Folder folder;
    const std::string script = folder.write(
        "s.lua",
        "local lissom = require 'lissom'\n"
        "local p = lissom.params{ n = { type = 'integer', default = 1, help = 'Number' } }\n"
        "if p.n == 7 then error('seven') end\n"
        "if p.n == 1 and #arg == 0 then return end\n"
        "assert(arg[1] == '--n')");
    CHECK(run({"run", script}).status == kSuccess);
    CHECK(run({"run", script, "--n", "2"}).status == kSuccess);
    CHECK(run({"run", script, "--n", "7"}).status == kFailure);
    const Ended wrong = run({"run", script, "--m", "7"});
    CHECK(wrong.status == kUsage);
    CHECK(wrong.err.find("no parameter '--m', did you mean 'n'?") == std::string::npos);
    CHECK(Json::parse(run({"run", "--json", script, "--n", "x"}).err)["error"]["code"] == "usage");
    const Ended help = run({"run", script, "--help"});
    CHECK(help.status == kSuccess);
    CHECK(help.out.find("--n integer  Number (default: 1)") != std::string::npos);
    const Json schema = Json::parse(run({"run", "--json", script, "--help"}).out);
    CHECK(schema["parameters"][0]["name"] == "n");
}

TEST_CASE("Ctrl-C stops Lua, in coroutines and past pcall") {
    const Folder folder;
    for (const char* loop :
         {"while true do end", "while true do pcall(function() while true do end end) end",
          "coroutine.wrap(function() while true do end end)()",
          "while true do coroutine.resume(coroutine.create(function() while true do end end)) "
          "end"}) {
        CAPTURE(loop);
        ProgramParts parts = kernel_parts();
        parts.libraries.push_back([] {
            lua::Library library{.name = "test"};
            library.functions = {{.name = "press",
                                  .body = [](lua::Call&) { return std::raise(SIGINT); },
                                  .summary = "Presses Ctrl-C.",
                                  .example = "-- none"}};
            return library;
        });
        std::string path = folder.write("s.lua", "require 'lissom'.press() " + std::string(loop));
        std::string name = "lissom", verb = "run";
        char* argv[] = {name.data(), verb.data(), path.data()};
        std::ostringstream err;
        std::streambuf* const old = std::cerr.rdbuf(err.rdbuf());
        CHECK(run_program(3, argv, parts) == kInterrupted);
        std::cerr.rdbuf(old);
        CHECK(err.str().find("cancelled") != std::string::npos);
    }
}

TEST_CASE("--help never runs the script") {
    const Folder folder;
    const std::string mark = folder.path("mark");
    const auto help_of = [&](const std::string& code) {
        return run({"run", folder.write("s.lua", code), "--help"});
    };
    const std::string open = "io.open('" + mark + "', 'w'):close() ";
    const std::string lissom = "local lissom = require 'lissom' ";
    const std::string declare = "lissom.params{ n = { type = 'integer', default = 1 } } ";
    const Ended plain = help_of(open + "error('ran')");
    CHECK(plain.status == kSuccess);
    CHECK(plain.out.find("declares no parameters") != std::string::npos);
    const Ended late = help_of(lissom + open + declare + "error('ran')");
    CHECK(late.status == kSuccess);
    CHECK(late.out.find("works before it declares parameters") != std::string::npos);
    for (const char* work : {"os.remove('x')", "os.execute('true')", "os.exit(3)", "io.write('x')",
                             "lissom.shapes.box()", "pcall(lissom.load, 'x.obj') os.exit(3)",
                             "io.stdout:write('x')"}) {
        CAPTURE(work);
        const Ended ended = help_of(lissom + work + " " + declare);
        CHECK(ended.status == kSuccess);
        CHECK(ended.out.find("works before it declares parameters") != std::string::npos);
    }
    const Ended good = help_of(lissom + "print('hello') local now = os.time() " + declare + open);
    CHECK(good.status == kSuccess);
    CHECK(good.out.find("--n integer") != std::string::npos);
    CHECK(!folder.has("mark"));
    CHECK(help_of("x = = 1 -- params").status == kFailure);
    CHECK(run({"run", folder.path("none.lua"), "--help"}).status == kFailure);
    const std::string script = folder.write("s.lua", "error('ran')");
    CHECK(Json::parse(run({"run", "--json", script, "-h"}).out)["parameters"].empty());
}

TEST_CASE("flags that a script does not declare are refused") {
    const Folder folder;
    const std::string mark = folder.path("mark");
    const std::string open = "io.open('" + mark + "', 'w'):close() ";
    const std::string plain = folder.write("plain.lua", open);
    const Ended refused = run({"run", plain, "--size", "3"});
    CHECK(refused.status == kUsage);
    CHECK(refused.err.find("no parameter '--size': the script declares none") != std::string::npos);
    CHECK(!folder.has("mark"));
    CHECK(run({"run", plain, "--", "--size"}).status == kSuccess);
    // It may be declared in another file, which is known in the end.
    folder.write("part.lua", "return 1");
    CHECK(run({"run", folder.write("s.lua", "require 'part'"), "--size"}).status == kUsage);
    folder.write("part.lua", "require 'lissom'.params{ size = { type = 'integer', default = 1 } }");
    CHECK(run({"run", folder.write("s.lua", "require 'part'"), "--size", "3"}).status == kSuccess);
    // A script that reads its words by itself knows them.
    CHECK(run({"run", folder.write("own.lua", "assert(arg[1] == '--size')"), "--size"}).status ==
          kSuccess);
}

TEST_CASE("words that a script never looks at are refused before it works") {
    const Folder folder;
    const std::string mark = folder.path("mark");
    const std::string lissom = "local lissom = require 'lissom'\n";
    const std::string fields = "params{ wire = { type = 'boolean', default = false } }\n";
    const std::string work = "io.open('" + mark + "', 'w'):close()";
    const auto status = [&](const std::string& code, std::vector<std::string> words) {
        words.insert(words.begin(), {"run", folder.write("s.lua", code)});
        return run(words).status;
    };
    CHECK(status(work, {"word"}) == kUsage);
    folder.write("part.lua",
                 "local lissom, t = require 'lissom', {} function t.params(list)\n"
                 "return lissom.params(list) end return t");
    for (const std::string& first :
         {lissom + "local p = lissom.", std::string("p = require('lissom')."),
          std::string("print(1) local p=require\"lissom\"."),
          std::string("local p = require('part').")}) {
        CAPTURE(first);
        CHECK(status(first + fields + work, {"word"}) == kUsage);
        CHECK(status(first + fields + work, {"--wire", "maybe"}) == kUsage);
        CHECK(!folder.has("mark"));
        CHECK(status(first + fields, {"--wire", "false"}) == kSuccess);
    }
    const Ended stray = run({"run", folder.write("s.lua", work), "word"});
    CHECK(stray.err.find("'word' is no flag") != std::string::npos);
    // Who may look at them gets them.
    CHECK(status(lissom + "local p, rest = lissom.params({}, { words = true }) "
                          "assert(rest[1] == 'word')",
                 {"word"}) == kSuccess);
    CHECK(status(lissom + "print(#arg) local p = lissom." + fields, {"word"}) == kSuccess);
}

TEST_CASE("run - reads the script from the standard input") {
    const auto typed = [](const std::string& code, std::vector<std::string> words) {
        std::istringstream input(code);
        std::streambuf* const old = std::cin.rdbuf(input.rdbuf());
        words.insert(words.begin(), {"run", "-"});
        const Ended ended = run(words);
        std::cin.rdbuf(old);
        return ended;
    };
    CHECK(typed("local lissom = require 'lissom'", {}).status == kSuccess);
    CHECK(typed("#!/usr/bin/env lissom\nerror('no')", {}).err == "stdin:2: no\n");
    CHECK(typed("x = = 1", {}).err.find("stdin:1:") == 0);
    const std::string declare =
        "local p = require 'lissom'.params{ n = { type = 'integer', default = 1 } } ";
    CHECK(typed(declare + "assert(p.n == 3)", {"--n", "3"}).status == kSuccess);
    CHECK(typed(declare, {"--help"}).out.find("Usage: lissom run -") == 0);
    CHECK(typed("", {"--m"}).status == kUsage);
    CHECK(typed("\xef\xbb\xbf#!/usr/bin/env lissom\nerror('no')", {}).err == "stdin:2: no\n");
}

TEST_CASE("a byte order mark before Lua is passed over: run, test, repl, require") {
    const Folder folder;
    const std::string mark = "\xef\xbb\xbf";
    const std::string script = folder.write("a.lua", mark + "assert(require('b') == 3)");
    folder.write("b.lua", mark + "return 3");
    CHECK(run({"run", script}).status == kSuccess);
    const Ended sandboxed =
        run({"run", "--sandbox", "--wall", "off", "--read", folder.path(""), script});
    CHECK_MESSAGE(sandboxed.status == kSuccess, sandboxed.err);
    std::istringstream typed(mark + "x = 2\nassert(x == 2)\n" + mark + "error('no')\n");
    std::streambuf* const old = std::cin.rdbuf(typed.rdbuf());
    const Ended ended = run({"repl"});
    std::cin.rdbuf(old);
    CHECK(ended.err == "repl:1: no\n");
    CHECK(run({"run", folder.write("c.lua", "x = " + mark + "1")}).status == kFailure);
}

TEST_CASE("inspect knows hair files and scenes") {
    const Folder folder;
    folder.write("two.usda",
                 "#usda 1.0\ndef BasisCurves \"h\"\n{\nuniform token type = \"linear\"\nint[] "
                 "curveVertexCounts = [2, 3]\npoint3f[] points = [(0,0,0),(1,0,0),(0,1,0),(0,2,0),"
                 "(0,3,0)]\n}\n");
    const std::string make = folder.write("make.lua", R"(local lissom = require "lissom"
local ball = lissom.shapes.sphere()
local hair = assert(lissom.load_strands(arg[1] .. "/two.usda"))
assert(hair:save(arg[1] .. "/a.hair") and hair:save(arg[1] .. "/a.usda") and hair:save(arg[1] .. "/a.data"))
local scene = lissom.scene{}
scene:add("ball", ball)
scene:add("hair", hair)
scene:add("line", lissom.polyline and lissom.polyline{ points = { { 0, 0, 0 }, { 1, 0, 0 } } } or ball:copy())
assert(scene:save(arg[1] .. "/a.lissom")))");
    const Ended made = run({"run", make, folder.path("")});
    REQUIRE_MESSAGE(made.status == kSuccess, made.err);
    for (const char* name : {"a.hair", "a.usda", "a.data"}) {
        CAPTURE(name);
        const Ended text = run({"inspect", folder.path(name)});
        CHECK(text.status == kSuccess);
        CHECK(text.out.find("strands      2\n") != std::string::npos);
        const Json answer = Json::parse(run({"inspect", folder.path(name), "--json"}).out);
        CHECK(answer["hair"][0]["strands"] == 2);
        CHECK(answer["hair"][0]["length"]["max"].get<double>() > 0.01);
    }
    const Json scene =
        Json::parse(run({"inspect", folder.path("a.lissom"), "--json"}).out)["scenes"][0];
    CHECK(scene["objects"].size() == 3);
    CHECK(scene["objects"][0]["name"] == "ball");
    CHECK(scene["objects"][0]["faces"].get<int>() > 10);
    CHECK(scene["objects"][1]["strands"] == 2);
    CHECK(run({"inspect", folder.path("a.lissom")}).out.find("a.lissom: ball (mesh)") !=
          std::string::npos);
    const std::string gap = std::string("\2\0\0\0\0\0\0\0\0\0\0\0", 12);
    CHECK(run({"inspect", folder.write("gap.data", gap)}).out.find("2 of 2 strands") !=
          std::string::npos);
    const Ended bad = run(
        {"inspect", folder.write("b.usda", "text"), folder.write("c.lissom", "text"), "--json"});
    CHECK(bad.status == kFailure);
    CHECK(Json::parse(bad.out)["hair"][0]["error"]["code"] == "file_syntax");
    CHECK(Json::parse(bad.out)["scenes"][0].contains("error"));

    const Ended converted = run({"convert", folder.path("a.lissom"), folder.path("a.obj")});
    CHECK_MESSAGE(converted.status == kSuccess, converted.err);
    const Json mesh =
        Json::parse(run({"inspect", folder.path("a.obj"), "--json"}).out)["meshes"][0];
    CHECK(mesh["labels"]["object"].contains("ball"));
    CHECK(mesh["vertices"].get<int>() >= scene["objects"][0]["vertices"].get<int>());
}

TEST_CASE("an option of a verb behind the script is told its place") {
    const Folder folder;
    const std::string script = folder.write(
        "a.lua", "local p = require 'lissom'.params{ n = { type = 'integer', default = 1 } }");
    CHECK(
        run({"run", script, "--sandbox"}).err.find("--sandbox belongs before the script's name") !=
        std::string::npos);
    CHECK(run({"run", script, "--size", "80x60"})
              .err.find("as an option of lissom view --size belongs before") != std::string::npos);
    CHECK(run({"run", folder.write("b.lua", "x = 1"), "--up=z"})
              .err.find("lissom view --up belongs before") != std::string::npos);
    CHECK(run({"run", script, "--m"}).err.find("belongs") == std::string::npos);
}

TEST_CASE("a folder to write to is made before the work") {
    const Folder folder;
    const std::string code =
        "local lissom = require 'lissom' "
        "local p = lissom.params{ out = { type = 'folder', default = '' } } "
        "assert(lissom.shapes.box():save(p.out .. '/box.obj')) ";
    const std::string script = folder.write("s.lua", code);
    CHECK(run({"run", script, "--out", folder.path("a/b")}).status == kSuccess);
    CHECK(folder.has("a/b/box.obj"));
    CHECK(run({"run", script, "--out", folder.path("a/b")}).status == kSuccess);
    const Ended refused = run({"run", script, "--out", folder.path("s.lua")});
    CHECK(refused.status == kUsage);
    CHECK(refused.err.find("parameter 'out': ") != std::string::npos);
    CHECK(run({"run", script, "--help"}).out.find("--out folder") != std::string::npos);
    const std::string in = folder.write("a.obj", kTriangle);
    CHECK(run({"convert", in, folder.path("c/d/a.ply")}).status == kSuccess);
    CHECK(folder.has("c/d/a.ply"));
}

TEST_CASE("inspect says what exceeds the range of numbers") {
    const Folder folder;
    const std::string huge =
        folder.write("a.obj",
                     "v 0 0 0\nv 1e200 0 0\nv 0 1e200 0\nv 0 0 1e200\nf 1 3 2\nf 1 2 4\n"
                     "f 1 4 3\nf 2 3 4\n");
    const std::string text = run({"inspect", huge}).out;
    CHECK(text.find("beyond the range of numbers") != std::string::npos);
    CHECK(text.find("nan") == std::string::npos);
    const Json mesh = Json::parse(run({"inspect", huge, "--json"}).out)["meshes"][0];
    CHECK(mesh["volume"].is_null());
}

TEST_CASE("inspect counts many labels in a time that grows with their number") {
    const Folder folder;
    std::string text;
    constexpr int kCount = 60000;
    for (int i = 0; i <= kCount + 1; ++i) {
        text += "v " + std::to_string(i) + " " + std::to_string(i % 2) + " 0\n";
    }
    for (int i = 1; i <= kCount; ++i) {
        text += "g a_group_of_one_face_" + std::to_string(i) + "\nf " + std::to_string(i) + " " +
                std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n";
    }
    const std::string path = folder.write("a.obj", text);
    const std::clock_t start = std::clock();
    const Json mesh =
        Json::parse(run({"inspect", path, "--json", "--threads", "1"}).out)["meshes"][0];
    // Adding each name to a list that is searched took 20 times as long.
    CHECK(double(std::clock() - start) / CLOCKS_PER_SEC < 5.0);
    CHECK(mesh["labels"]["group"].size() == kCount);
}

TEST_CASE("convert refuses what single precision destroys, and moves the origin") {
    const Folder folder;
    const std::string in =
        folder.write("a.obj", "v 4000000 0 0\nv 4000000.01 0 0\nv 4000000 0.01 0\nf 1 2 3\n");
    const Ended refused = run({"convert", in, folder.path("a.stl"), "--json"});
    CHECK(refused.status == kFailure);
    CHECK(Json::parse(refused.out)["error"]["code"] == "unsupported");
    const Ended moved = run({"convert", in, folder.path("a.stl"), "--origin", "auto", "--json"});
    CHECK(moved.status == kSuccess);
    CHECK(Json::parse(moved.out)["origin"][0] == 4000000.0);
    CHECK(Json::parse(moved.out)["lost"].size() == 1);
    const std::string points = folder.write("p.obj", "v 0 0 0\nv 1 0 0\n");
    const Ended cloud = run({"convert", points, folder.path("p.stl"), "--json"});
    CHECK(cloud.status == kFailure);
    CHECK(Json::parse(cloud.out)["error"]["code"] == "unsupported");
}

TEST_CASE("the prompt evaluates, continues and goes on after errors") {
    std::istringstream typed("1 + 1\nfor i = 1, 2 do\nx = i\nend\nerror('no')\nx\n");
    std::streambuf* const old = std::cin.rdbuf(typed.rdbuf());
    const Ended ended = run({"repl"});
    std::cin.rdbuf(old);
    CHECK(ended.status == kFailure);
    CHECK(ended.err == "repl:1: no\n");
}

TEST_CASE("lines of a script that are pasted at the prompt find the locals of those before") {
    std::istringstream typed(
        "local lissom = require 'lissom'\nlocal a <const>, b = 1, { x = 2 } -- two\n"
        "local c\nlocal function f(n)\nlocal d = n\nreturn d + a\nend\n"
        "do local e = 5 end for i = 1, 2 do local g = i end\n"
        "f(b.x), c, d, e, g, lissom.shapes ~= nil\n");
    std::streambuf* const old = std::cin.rdbuf(typed.rdbuf());
    const Ended ended = run({"repl"});
    std::cin.rdbuf(old);
    CHECK(ended.status == kSuccess);
    CHECK(ended.out == "3\tnil\tnil\tnil\tnil\ttrue\n");
}

}  // namespace
}  // namespace lissom::cli
