// The `lissom` program with the viewer's verbs and functions.
#include "bindings/cli/program.h"
#include "viewer/lua/picture_check.h"
#include "viewer/lua/render_verb.h"
#include "viewer/lua/viewer_library.h"
#ifdef LISSOM_WINDOW
#include "viewer/window/view_verb.h"
#endif

int main(int argc, char** argv) {
    lissom::cli::ProgramParts parts = lissom::cli::kernel_parts();
    parts.libraries.push_back(lissom::lua::viewer_library);
    parts.verbs.push_back({"render", "FILE... -o FILE",
                           "Draws meshes, hair or scenes into a picture.", lissom::cli::render});
    parts.compare_pictures = lissom::cli::compare_pictures;
#ifdef LISSOM_WINDOW
    parts.verbs.push_back({"view", "[MESH... | SCRIPT [--name value ...]]",
                           "Shows meshes or a script in a window.", lissom::cli::view});
#endif
    return lissom::cli::run_program(argc, argv, parts);
}
