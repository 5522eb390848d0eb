// lissom help [NAME]
#include <CLI/CLI.hpp>
#include <iostream>

#include "bindings/cli/json.h"
#include "bindings/cli/verbs.h"
#include "bindings/lua/reference/reference.h"
#include "kernel/core/nearest.h"

namespace lissom::cli {

int help(Program& program, const std::vector<std::string>& words) {
    CLI::App app("Describes a Lua function, or the methods of a type of object.", "lissom help");
    std::string name;
    app.add_option("NAME", name, "A function or a type: save, mesh.save, lissom.load, Mesh")
        ->required();
    int status = kSuccess;
    if (!program.parse(app, words, status)) return status;
    const auto registry = program.host_options().registry;
    const std::string text = lua::help_for(*registry, name);
    if (text.empty()) {
        const std::vector<std::string> names = lua::help_names(*registry);
        const std::string_view nearest =
            nearest_name(name, std::vector<std::string_view>(names.begin(), names.end()));
        const std::string hint = nearest.empty() ? "; lissom help lissom lists everything"
                                                 : ", did you mean '" + std::string(nearest) + "'?";
        return program.fail("lissom help: there is nothing called '" + name + "'" + hint, kUsage);
    }
    if (program.json()) {
        std::cout << json_text({{"name", name}, {"help", text}}) << std::endl;
    } else {
        std::cout << text << std::flush;
    }
    return kSuccess;
}

}  // namespace lissom::cli
