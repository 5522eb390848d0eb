#include "viewer/window/session/presets.h"

#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "kernel/core/error.h"
#include "tests/unit/bindings/cli/program_run.h"

using namespace lissom;
using namespace lissom::window;
using lua::ParameterType;

namespace {

std::vector<lua::ScriptParameter> some_parameters() {
    std::vector<lua::ScriptParameter> list(4);
    list[0].name = "angle";
    list[0].default_value = 70.0;
    list[0].min = -180.0;
    list[0].max = 180.0;
    list[1].name = "count";
    list[1].type = ParameterType::integer;
    list[1].default_value = 3.0;
    list[2].name = "mode";
    list[2].type = ParameterType::choice;
    list[2].choices = {"soft", "hard"};
    list[2].default_value = std::string("soft");
    list[3].name = "mirror";
    list[3].type = ParameterType::boolean;
    list[3].default_value = false;
    return list;
}

ErrorCode code_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.code();
    }
    return ErrorCode::internal;
}

}  // namespace

TEST_CASE("presets: what is kept under a name comes back, also for another run") {
    const test::ProgramFolder folder;
    const std::string script = folder.write("bend.lua", "");
    const Presets presets(script);
    CHECK(presets.names().empty());
    auto parameters = some_parameters();
    parameters[0].value = 12.345678901234567;
    parameters[2].value = std::string("hard");
    parameters[3].value = true;
    presets.save("half \"way\"", values_of(parameters));
    presets.save("zero", {{"angle", 0.0}});
    CHECK(folder.has("bend.presets.json"));
    CHECK(presets.names() == std::vector<std::string>{"half \"way\"", "zero"});
    auto other = some_parameters();
    CHECK(apply_preset(Presets(script).load("half \"way\""), other).empty());
    CHECK(values_of(other) == values_of(parameters));
    // What a preset does not name has its default.
    CHECK(apply_preset(presets.load("zero"), other).empty());
    CHECK(std::get<double>(*other[0].value) == 0.0);
    CHECK(std::get<std::string>(*other[2].value) == "soft");
    presets.remove("zero");
    presets.remove("never was");
    CHECK(presets.names().size() == 1);
    CHECK(code_of([&] { presets.load("zero"); }) == ErrorCode::out_of_range);
    CHECK(code_of([&] { presets.save("", {}); }) == ErrorCode::invalid_argument);
}

TEST_CASE("presets: values that a parameter refuses are left out and told") {
    auto parameters = some_parameters();
    parameters[0].value = 5.0;
    const auto refused = apply_preset({{"angle", 500.0},
                                       {"count", 2.5},
                                       {"mode", std::string("wild")},
                                       {"mirror", std::string("yes")},
                                       {"gone", 1.0}},
                                      parameters);
    REQUIRE(refused.size() == 5);
    CHECK(refused[0].find("angle") != std::string::npos);
    CHECK(refused[0].find("-180 to 180") != std::string::npos);
    CHECK(refused[4].find("gone") != std::string::npos);
    CHECK(std::get<double>(*parameters[0].value) == 5.0);
    CHECK_FALSE(parameters[1].value);
}

TEST_CASE("presets: a broken file is told and not written over") {
    const test::ProgramFolder folder;
    const Presets presets(folder.write("bend.lua", ""));
    for (const char* text : {"", "{", "[1]", "{\"a\": 3}", "{\"a\": {\"angle\": [1]}}",
                             "{\"a\": {\"angle\": null}}"}) {
        CAPTURE(text);
        const std::string file = folder.write("bend.presets.json", text);
        CHECK_THROWS_AS(presets.names(), Error);
        CHECK_THROWS_AS(presets.save("b", {{"angle", 1.0}}), Error);
        std::ostringstream content;
        content << std::ifstream(file).rdbuf();
        CHECK(content.str() == text);
    }
    CHECK(code_of([&] { presets.names(); }) == ErrorCode::file_syntax);
    CHECK(Presets().names().empty());
    CHECK(code_of([&] { Presets("/nowhere/x.lua").save("a", {}); }) ==
          ErrorCode::file_write_failed);
}
