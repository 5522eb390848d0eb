/// ViewApp: the window of `lissom view`: a camera moved by hand, the panel, and the pictures of a
/// session. This thread owns OpenGL and never waits for a script or the kernel.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/program.h"
#include "viewer/window/session/session.h"

namespace lissom::window {

struct ViewOptions {
    /// Mesh files, or a script and the words of its command line.
    std::vector<std::string> words;
    /// The tool in hand, and the file that records its work.
    SessionOptions session = {};
    /// Tools that have a button beside those that ship: files, or names of these.
    std::vector<std::string> tools = {};
    int width = 1280, height = 800;
    /// Speed of a recording, in multiples of its own.
    double speed = 1.0;
    /// Writes a line to the standard output for each thing that the window has done, for tests:
    /// "shown 1", "at rest", "picture x.png".
    bool tells = false;
};

/// Opens the window and returns when it is closed. Errors: no_display.
int run_view(cli::Program& program, const ViewOptions& options);

}  // namespace lissom::window
