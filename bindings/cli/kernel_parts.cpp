#include "bindings/cli/program.h"
#include "bindings/cli/verbs.h"

namespace lissom::cli {

ProgramParts kernel_parts() {
    ProgramParts parts;
    parts.verbs = {{"run", "FILE [--name value ...]", "Runs a Lua script.", run_script},
                   {"test", "PATH...", "Runs the tests of scripts.", run_tests},
                   {"inspect", "MESH...", "Says what is in mesh files.", inspect},
                   {"convert", "IN OUT", "Writes meshes in another format.", convert},
                   {"new", "tool NAME", "Writes a tool to begin with.", make_new},
                   {"repl", "", "Runs Lua line by line.", repl},
                   {"help", "NAME", "Says how a Lua function is called.", help},
                   {"explain", "[CODE]", "Says what an error code means.", explain}};
    parts.libraries = {lua::kernel_library};
    parts.version_lines = {"Lissom's own code is under the MIT licence."};
#ifdef LISSOM_HAS_GPL
    parts.version_lines.emplace_back(
        "This build links CHOLMOD's supernodal module, which is under the GNU GPL, version 2 or "
        "later: "
        "the program as a whole is under the GPL. Configure with LISSOM_GPL=OFF for one that is "
        "not.");
#endif
    return parts;
}

}  // namespace lissom::cli
