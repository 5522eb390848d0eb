#include "bindings/lua/core/script_parameters.h"

#include "tests/unit/bindings/lua_state.h"

namespace lissom::lua {
namespace {

ScriptParameter parameter(const std::string& name, ParameterType type, ParameterValue value) {
    ScriptParameter p;
    p.name = name;
    p.type = type;
    p.default_value = p.value = std::move(value);
    return p;
}

ParameterSet example() {
    ParameterSet set;
    set.list = {parameter("local_size", ParameterType::number, 0.5),
                parameter("count", ParameterType::integer, 3.0),
                parameter("fast", ParameterType::boolean, false),
                parameter("mode", ParameterType::choice, std::string("soft")),
                parameter("out", ParameterType::file, std::string())};
    set.list[0].min = -1;
    set.list[0].max = 1;
    set.list[3].choices = {"soft", "crisp"};
    return set;
}

std::string message_of(ParameterSet set, const std::vector<std::string>& words) {
    try {
        set.take(words);
    } catch (const ParameterError& error) {
        return error.message;
    }
    return "";
}

TEST_CASE("flags give values") {
    ParameterSet set = example();
    const auto rest = set.take({"--local-size", "-0.25", "in.obj", "--count=7", "--fast", "--mode",
                                "crisp", "--", "--out"});
    CHECK(std::get<double>(*set.find("local_size")->value) == -0.25);
    CHECK(std::get<double>(*set.find("count")->value) == 7);
    CHECK(std::get<bool>(*set.find("fast")->value));
    CHECK(std::get<std::string>(*set.find("mode")->value) == "crisp");
    CHECK(rest == std::vector<std::string>{"in.obj", "--out"});
}

TEST_CASE("booleans have a negative flag") {
    ParameterSet set = example();
    set.take({"--fast=yes"});
    CHECK(std::get<bool>(*set.find("fast")->value));
    set.take({"--no-fast"});
    CHECK(!std::get<bool>(*set.find("fast")->value));
}

TEST_CASE("a boolean takes the word that follows as its value") {
    for (const char* word : {"true", "false", "yes", "no", "on", "off", "0", "1"}) {
        CAPTURE(word);
        ParameterSet set = example();
        CHECK(set.take({"--fast", word}).empty());
        CHECK(*set.find("fast")->value == set.find("fast")->from_text(word));
    }
    ParameterSet set = example();
    CHECK(set.take({"--fast", "in.obj", "--no-fast", "off"}) ==
          std::vector<std::string>{"in.obj", "off"});
    CHECK(!std::get<bool>(*set.find("fast")->value));
}

TEST_CASE("what does not fit is refused") {
    CHECK(message_of(example(), {"--local_size", "2"}) ==
          "parameter 'local_size': number from -1 to 1 expected, got '2'");
    CHECK(message_of(example(), {"--count", "1.5"}) ==
          "parameter 'count': integer expected, got '1.5'");
    CHECK(message_of(example(), {"--count", "3x"}) != "");
    CHECK(message_of(example(), {"--count", ""}) != "");
    CHECK(message_of(example(), {"--count", "nan"}) != "");
    CHECK(message_of(example(), {"--fast=maybe"}) ==
          "parameter 'fast': true or false expected, got 'maybe'");
    CHECK(message_of(example(), {"--mode", "cripsy"}) ==
          "parameter 'mode': soft or crisp expected, got 'cripsy', did you mean 'crisp'?");
    CHECK(message_of(example(), {"--moed", "soft"}) ==
          "no parameter '--moed', did you mean '--mode'?");
    CHECK(message_of(example(), {"--count"}) == "a value must follow --count");
}

TEST_CASE("integers that no number holds exactly are refused") {
    for (const char* text : {"99999999999999999999", "-99999999999999999999", "9007199254740994",
                             "1e300", "inf", "-inf"}) {
        CAPTURE(text);
        CHECK(message_of(example(), {"--count", text}).find("integer of at most 16 digits") !=
              std::string::npos);
    }
    ParameterSet set = example();
    set.take({"--count", "9007199254740992"});
    CHECK(std::get<double>(*set.find("count")->value) == 9007199254740992.0);
}

TEST_CASE("flags that no parameter has are refused, with one dash or two") {
    CHECK(message_of(example(), {"-mode", "soft"}) ==
          "no parameter '-mode', did you mean '--mode'?");
    CHECK(message_of(example(), {"--local-siz=3"}) ==
          "no parameter '--local-siz', did you mean '--local-size'?");
    CHECK(message_of(example(), {"--zzzzzz"}) ==
          "no parameter '--zzzzzz'; there is: --local-size, --count, --fast, --mode, --out");
    CHECK(message_of(example(), {"--threads", "2"}) ==
          "no parameter '--threads'; --threads belongs before the script's name");
    ParameterSet set = example();
    CHECK(set.take({"-", "-1", "--", "-x"}) == std::vector<std::string>{"-", "-1", "-x"});
}

TEST_CASE("a parameter without a default must be given") {
    ParameterSet set = example();
    set.list[4].default_value = set.list[4].value = std::nullopt;
    CHECK_THROWS_AS(set.require_values(), ParameterError);
    set.take({"--out", "x.obj"});
    set.require_values();
}

TEST_CASE("the help names every flag, its values and its default") {
    ParameterSet set = example();
    set.list[1].help = "How many";
    set.list[1].group = "Counts";
    set.sort();
    const std::string text = set.help_text("demo.lua");
    CHECK(text.find("Usage: lissom run demo.lua") == 0);
    CHECK(text.find("--local-size number  number from -1 to 1 (default: 0.5)") !=
          std::string::npos);
    CHECK(text.find("soft or crisp (default: soft)") != std::string::npos);
    CHECK(text.find("Counts:\n  --count integer      How many (default: 3)") != std::string::npos);
}

HostOptions script_host(std::vector<std::string> words) {
    HostOptions options;
    options.arguments = {"demo.lua", std::move(words)};
    return options;
}

const char* const kDeclaration =
    "params, rest = lissom.params{ length = { type = 'number', default = 0.3, min = 0, max = 1 }, "
    "count = { type = 'integer', default = 2 } } ";

TEST_CASE("a script reads its parameters") {
    test::LuaState lua(script_host({"--length", "0.5", "word"}));
    CHECK(lua.run(kDeclaration) == "");
    CHECK(lua.eval("params.length") == "0.5");
    CHECK(lua.eval("params.count") == "2");
    CHECK(lua.eval("rest[1]") == "word");
    CHECK(lua.eval("#params") == "2");
    CHECK(lua.run("params.length = 2").find("number from 0 to 1 expected") != std::string::npos);
    CHECK(lua.run("params.length = 1") == "");
    CHECK(lua.eval("params.length") == "1.0");
    CHECK(lua.run("return params.lenght").find("did you mean 'length'?") != std::string::npos);
    CHECK(lua.run("params.width = 2").find("no parameter 'width'") != std::string::npos);
    CHECK(lua.eval("params:schema()[2].max") == "1.0");
    CHECK(lua.run(kDeclaration).find("declared already") != std::string::npos);
}

TEST_CASE("--help ends the script with the help text") {
    test::LuaState lua(script_host({"--help"}));
    CHECK(lua.run(std::string(kDeclaration) + "after = true") != "");
    CHECK(lua.binding().script_end == ScriptEnd::help);
    CHECK(lua.binding().script_end_text.find("--length") != std::string::npos);
    CHECK(lua.eval("after") == "nil");
}

TEST_CASE("a wrong flag ends the script as wrong usage") {
    test::LuaState lua(script_host({"--lenght", "1"}));
    CHECK(lua.run(kDeclaration) != "");
    CHECK(lua.binding().script_end == ScriptEnd::usage);
}

TEST_CASE("wrong declarations are errors of the script") {
    test::LuaState lua;
    const auto refuses = [&](const std::string& declaration, const std::string& part) {
        const std::string message = lua.run("lissom.params{ " + declaration + " }");
        CAPTURE(message);
        CHECK(message.find(part) != std::string::npos);
    };
    refuses("a = { }", "missing option 'declarations.type' of 'params: a'");
    refuses("a = { type = 'numbr' }", "did you mean \"number\"?");
    refuses("a = { type = 'number', default = 'x' }", "number expected, got 'x'");
    refuses("a = { type = 'number', default = 2, max = 1 }", "the default of parameter 'a'");
    refuses("a = { type = 'string', default = 'x', min = 1 }", "takes no min, max or step");
    refuses("a = { type = 'choice', default = 'x' }", "needs choices");
    refuses("a = { type = 'number', default = 1, choices = { 'x' } }", "takes no choices");
    refuses("a = { type = 'number', default = 1, hepl = '' }", "did you mean 'help'?");
    refuses("A = { type = 'number', default = 1 }", "small letters");
    refuses("schema = { type = 'number', default = 1 }", "is taken");
    refuses("a = 5", "table of options expected, got 5");
    refuses("5", "names as keys expected");
    refuses("a = { type = 'number' }", "needs a value");
}

}  // namespace
}  // namespace lissom::lua
