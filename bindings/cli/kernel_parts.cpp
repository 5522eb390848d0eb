#include "bindings/cli/program.h"
#include "bindings/cli/verbs.h"
#include "kernel/core/build_info.h"

namespace lissom::cli {

ProgramParts kernel_parts() {
    ProgramParts parts;
    parts.verbs = {
        {"run", "FILE [--name value ...]", "Runs a Lua script.", run_script},
        {"batch", "FILE --over FILES --out TEMPLATE",
         "Runs a script for each of many files or values.", batch},
        {"test", "PATH...", "Runs the tests of scripts.", run_tests},
        {"inspect", "FILE...", "Describes the contents of meshes, hair and scenes.", inspect},
        {"convert", "IN OUT", "Writes meshes and hair in another format.", convert},
        {"new", "tool NAME", "Writes a tool to begin with.", make_new},
        {"migrate", "FILE...", "Rewrites old names in scripts.", migrate_scripts},
        {"repl", "", "Runs Lua line by line.", repl},
        {"help", "NAME", "Describes a verb or a Lua function.", help},
        {"explain", "[CODE]", "Explains an error code.", explain}};
    parts.libraries = {lua::kernel_library};
    parts.version_lines = {"Lissom's own code is under the MIT licence."};
    parts.version_lines.emplace_back(
        build_info().gpl
            ? "This build links CHOLMOD, parts of which are under the GNU GPL, version 2 or later: "
              "the program as a whole may be distributed under the GPL only. Configure with "
              "LISSOM_GPL=OFF for one that links nothing under the GPL."
            : "This build links nothing under the GPL.");
    return parts;
}

}  // namespace lissom::cli
