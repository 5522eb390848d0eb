#include "bindings/lua/core/registry.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "bindings/lua/reference/reference.h"
#include "tests/unit/bindings/annotation_check.h"
#include "tests/unit/bindings/lua_state.h"

namespace lissom::lua {
namespace {

int nothing(Call&) {
    return 0;
}

Function function_named(const std::string& name) {
    return {.name = name, .body = nothing, .summary = "Does nothing.", .example = "-- nothing"};
}

Library library_of(Function described) {
    Library library{.name = "test"};
    library.functions = {std::move(described)};
    return library;
}

std::string content(const std::string& name) {
    std::ifstream file(std::string(LISSOM_BINDING_FOLDER) + "/" + name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// A hundred examples begin with one of few heads, each of which takes a sanitizer seconds to make.
const char* const kHeadsOnce = R"(
local make, made = lissom.shapes.head, {}
function lissom.shapes.head(options)
    local key = ""
    for name, value in pairs(options or {}) do key = key .. name .. "=" .. tostring(value) .. " " end
    made[key] = made[key] or make(options)
    return made[key]:copy()
end)";

TEST_CASE("every example of the table runs") {
    const Registry registry = kernel_registry();
    test::LuaState lua;
    REQUIRE(lua.run(kHeadsOnce) == "");
    for (const auto& entry : registry.entries()) {
        CAPTURE(entry->function->name);
        CHECK(lua.run(entry->function->example) == "");
        lua.collect();
    }
}

TEST_CASE("the annotations are those of the table") {
    const bool current = content("meta/lissom.lua") == annotations(kernel_library());
    CHECK_MESSAGE(current, "run the build target `reference` and look at what changed");
}

TEST_CASE("lua-language-server understands the annotations") {
    const std::string text = annotations(kernel_library());
    const std::vector<std::string> mistakes =
        test::annotation_mistakes(text, test::declared_types(text));
    for (const std::string& mistake : mistakes) CHECK_MESSAGE(false, mistake);
    CHECK(mistakes.empty());
    const std::string wrong =
        "---@field a? strin\n---@field b (fun(x: integer): number)|string\n---@param c number\n"
        "function f(d) end\n---@return lissom.Nothing\n---@overload number\n";
    CHECK(test::annotation_mistakes(wrong, {}).size() == 4);
}

TEST_CASE("help says how a function is called, under all its names") {
    const Registry registry = kernel_registry();
    const std::string save = help_for(registry, "mesh.save");
    CHECK(save.find("mesh:save(path, [{...}])\n") == 0);
    CHECK(save.find("path (string; required)") != std::string::npos);
    CHECK(save.find("errors: unknown_format") != std::string::npos);
    for (const char* name : {"lissom.Mesh:save", "Mesh.save", "mesh:save"}) {
        CHECK_MESSAGE(help_for(registry, name) == save, name);
    }
    CHECK(help_for(registry, "save").find("strands:save(") != std::string::npos);
    CHECK(help_for(registry, "shapes.box").find("lissom.shapes.box") == 0);
    CHECK(help_for(registry, "Mesh").find("mesh:smooth{...}") != std::string::npos);
    CHECK(help_for(registry, "Bounds").find("lissom.Bounds (a table)") == 0);
    CHECK(help_for(registry, "lissom.bounds").find("diagonal (number)") != std::string::npos);
    CHECK(help_for(registry, "lissom").find("\n  Bounds: ") != std::string::npos);
    CHECK(help_for(registry, "sav") == "");
    // Under the names that examples give to objects.
    const std::string report = help_for(registry, "deformer.report");
    CHECK(report.find("deformer:report{...}\n") == 0);
    for (const char* name : {"deformer:report", "Deformer.report", "Deformer:report"}) {
        CHECK_MESSAGE(help_for(registry, name) == report, name);
    }
    CHECK(help_for(registry, "deformer").find("lissom.Deformer\n") == 0);
    CHECK(help_for(registry, "eformer.report") == "");
    for (const std::string& name : help_names(registry)) {
        CHECK_MESSAGE(help_for(registry, name) != "", name);
    }
}

TEST_CASE("the annotations are Lua") {
    test::LuaState lua;
    CHECK(lua.run(annotations(kernel_library())) == "");
}

TEST_CASE("every name that the table uses as a type is described") {
    const Library library = kernel_library();
    const Registry registry = kernel_registry();
    const auto known = [&](const std::string& name) {
        for (const Record& record : library.records) {
            if (record.name == name) return true;
        }
        return registry.find_type(name) != nullptr || name == "lissom.Vector";
    };
    // Of alternatives all.
    const auto check = [&](const std::string& types) {
        std::istringstream alternatives(types);
        for (std::string type; std::getline(alternatives, type, '|');) {
            type = type.substr(0, type.find_first_of("[]?"));
            if (type.compare(0, 7, "lissom.") == 0) CHECK_MESSAGE(known(type), type);
        }
    };
    for (const auto& entry : registry.entries()) {
        for (const Result& result : entry->function->results) check(result.type);
        for (const Entry::Slot& slot : entry->slots) {
            if (slot.parameter->kind == Kind::object) check(slot.parameter->type_name);
        }
    }
}

TEST_CASE("a library of another module adds functions and types") {
    Registry registry = kernel_registry();
    Library library{.name = "extra"};
    library.functions = {function_named("extra"), function_named("tools.noop")};
    library.types = {
        {.name = "lissom.Extra", .summary = "A test.", .methods = {function_named("go")}}};
    registry.add(std::move(library));
    HostOptions options;
    options.registry = std::make_shared<Registry>(std::move(registry));
    test::LuaState lua(options);
    CHECK(lua.run("lissom.extra() lissom.tools.noop()") == "");
    CHECK(lua.run("lissom.tools.nop()") ==
          "test:1: lissom.tools: no function 'nop', did you mean 'noop'? "
          "[invalid_argument]");
}

TEST_CASE("inconsistent descriptions are refused") {
    const auto refused = [](Function described) {
        Registry registry;
        CHECK_THROWS_AS(registry.add(library_of(std::move(described))), std::logic_error);
    };
    Function f = function_named("f");
    f.example = "";
    refused(f);
    f = function_named("f");
    f.body = nullptr;
    refused(f);
    f = function_named("f");
    f.options = {number("a", "One."), number("a", "Two.")};
    refused(f);
    f = function_named("f");
    f.options = {choice("c", {"x", "y"}, "One.").defaults("z")};
    refused(f);
    f = function_named("f");
    f.arguments = {number("a", "One.").optional(), number("b", "Two.")};
    refused(f);
    f = function_named("f");
    for (int i = 0; i <= Entry::kMaximumSlots; ++i) {
        f.options.push_back(number("n" + std::to_string(i), "One of many.").optional());
    }
    refused(f);
    Registry twice;
    twice.add(library_of(function_named("f")));
    CHECK_THROWS_AS(twice.add(library_of(function_named("f"))), std::logic_error);
}

TEST_CASE("effects of methods stand in the table, and only steps and files of scenes are unheard") {
    const Registry registry = kernel_registry();
    std::size_t changing = 0;
    for (const auto& entry : registry.entries()) {
        const Effect effect = entry->function->effect;
        INFO(entry->function->name);
        if (!entry->type) CHECK((effect == Effect::by_result || effect == Effect::changes));
        if (effect == Effect::unheard) CHECK(entry->type->name == "lissom.Scene");
        changing += effect == Effect::changes || effect == Effect::replaces ? 1 : 0;
    }
    CHECK(changing > 20);
    CHECK(!registry.find_type("lissom.Camera")->is_heard);
    CHECK(registry.find_type("lissom.Mesh")->is_heard);
}

}  // namespace
}  // namespace lissom::lua
