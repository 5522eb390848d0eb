// lissom help NAME
#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>

#include "bindings/cli/json.h"
#include "bindings/cli/verbs.h"
#include "bindings/lua/reference/reference.h"
#include "kernel/core/nearest.h"

namespace lissom::cli {
namespace {

// The usage of a verb, as its --help prints it; empty if there is no verb of this name.
std::string usage_of(Program& program, const std::string& name) {
    for (const Verb& verb : program.parts().verbs) {
        if (verb.name != name) continue;
        std::ostringstream text;
        program.help_stream = &text;
        verb.run(program, {"--help"});
        program.help_stream = nullptr;
        return text.str();
    }
    return {};
}

std::string hint_for(const Program& program, const lua::Registry& registry,
                     const std::string& name) {
    const std::vector<std::string> names = lua::help_names(registry);
    std::vector<std::string_view> known(names.begin(), names.end());
    for (const Verb& verb : program.parts().verbs) known.push_back(verb.name);
    const std::string_view nearest = nearest_name(name, known);
    return nearest.empty() ? "; lissom help lissom lists everything"
                           : ", did you mean '" + std::string(nearest) + "'?";
}

}  // namespace

int help(Program& program, const std::vector<std::string>& words) {
    CLI::App app("Describes a verb, a Lua function, or the methods of a type of object.",
                 "lissom help");
    std::string name;
    app.add_option("NAME", name,
                   "A verb, a function or a type: convert, save, mesh.save, lissom.load, Mesh")
        ->required();
    int status = kSuccess;
    if (!program.parse(app, words, status)) return status;
    const auto registry = program.host_options().registry;
    const std::string usage = usage_of(program, name), of_lua = lua::help_for(*registry, name);
    const std::string text = usage + (usage.empty() || of_lua.empty() ? "" : "\n") + of_lua;
    if (text.empty()) {
        return program.fail("lissom help: there is nothing called '" + name + "'" +
                                hint_for(program, *registry, name),
                            kUsage);
    }
    if (program.json()) {
        std::cout << json_text({{"name", name}, {"help", text}}) << std::endl;
    } else {
        std::cout << text << std::flush;
    }
    return kSuccess;
}

}  // namespace lissom::cli
