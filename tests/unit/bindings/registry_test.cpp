#include "bindings/lua/core/registry.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "bindings/lua/reference/reference.h"
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

TEST_CASE("every example of the table runs") {
    const Registry registry = kernel_registry();
    for (const auto& entry : registry.entries()) {
        CAPTURE(entry->function->name);
        test::LuaState lua;
        CHECK(lua.run(entry->function->example) == "");
    }
}

TEST_CASE("the annotations and the reference page are those of the table") {
    const Library library = kernel_library();
    const bool annotations_current = content("meta/lissom.lua") == annotations(library);
    const bool reference_current = content("reference.md") == reference_page(library);
    CHECK_MESSAGE(annotations_current, "run the build target `reference` and look at what changed");
    CHECK_MESSAGE(reference_current, "run the build target `reference` and look at what changed");
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
    const auto check = [&](std::string type) {
        const std::size_t end = type.find_first_of("[]?");
        type = type.substr(0, end);
        if (type.compare(0, 7, "lissom.") == 0) CHECK_MESSAGE(known(type), type);
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
          "test:1: lissom.tools: no function 'nop', did you mean 'noop'?");
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

}  // namespace
}  // namespace lissom::lua
