// Preloaded into a program that calls OpenGL through libepoxy: after SIGUSR1 the driver says once
// that it was reset.
#include <dlfcn.h>
#include <epoxy/gl.h>
#include <signal.h>

namespace {

using Status = PFNGLGETGRAPHICSRESETSTATUSPROC;
Status* slot = nullptr;
Status driver = nullptr;

GLenum EPOXY_CALLSPEC status_once() {
    *slot = driver;
    return GL_INNOCENT_CONTEXT_RESET;
}

void lose(int) {
    if (!slot) return;
    driver = *slot;
    *slot = &status_once;
}

struct Preloaded {
    Preloaded() {
        slot = static_cast<Status*>(dlsym(RTLD_DEFAULT, "epoxy_glGetGraphicsResetStatus"));
        signal(SIGUSR1, lose);
    }
} const preloaded;

}  // namespace
