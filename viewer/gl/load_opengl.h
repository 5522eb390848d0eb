/// Loads OpenGL when something is first drawn.
#pragma once

#include <string>

namespace lissom::gl {

/// Fills the function pointers of <epoxy/gl.h> and <epoxy/egl.h> from libepoxy, which finds the
/// functions of the driver: the program does not link it, so that what draws nothing starts
/// without. Called before the first function of OpenGL, from any thread; does nothing the second
/// time. `library` names the file, for tests. Errors: no_display, where it is not on this machine.
void load_opengl(const std::string& library = "libepoxy.so.0");

}  // namespace lissom::gl
