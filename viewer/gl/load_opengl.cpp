#include "viewer/gl/load_opengl.h"

#include <dlfcn.h>
#define EGL_NO_X11
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <mutex>
#include <type_traits>

#include "kernel/core/error.h"

// Every function that the renderer, the window and their tests call.
// clang-format off
#define LISSOM_OPENGL_FUNCTIONS(X) \
    X(epoxy_eglBindAPI) X(epoxy_eglChooseConfig) X(epoxy_eglCreateContext) \
    X(epoxy_eglCreatePbufferSurface) X(epoxy_eglDestroySurface) X(epoxy_eglGetCurrentContext) \
    X(epoxy_eglGetCurrentDisplay) X(epoxy_eglGetCurrentSurface) X(epoxy_eglGetDisplay) \
    X(epoxy_eglGetPlatformDisplayEXT) X(epoxy_eglMakeCurrent) X(epoxy_eglQueryAPI) \
    X(epoxy_eglQueryDevicesEXT) X(epoxy_glActiveTexture) X(epoxy_glAttachShader) \
    X(epoxy_glBeginTransformFeedback) X(epoxy_glBindBufferBase) X(epoxy_glBindFramebuffer) \
    X(epoxy_glBindRenderbuffer) X(epoxy_glBindTexture) X(epoxy_glBindVertexArray) \
    X(epoxy_glBlitFramebuffer) X(epoxy_glBufferData) X(epoxy_glBufferSubData) \
    X(epoxy_glCheckFramebufferStatus) X(epoxy_glClear) X(epoxy_glClearColor) \
    X(epoxy_glCreateProgram) X(epoxy_glCreateShader) X(epoxy_glDebugMessageCallback) \
    X(epoxy_glDeleteBuffers) X(epoxy_glDeleteProgram) X(epoxy_glDeleteRenderbuffers) \
    X(epoxy_glDeleteShader) X(epoxy_glDeleteTextures) X(epoxy_glDeleteVertexArrays) \
    X(epoxy_glDepthMask) X(epoxy_glDisable) X(epoxy_glDrawArrays) \
    X(epoxy_glDrawArraysInstanced) X(epoxy_glEnable) X(epoxy_glEndTransformFeedback) \
    X(epoxy_glFinish) X(epoxy_glFramebufferRenderbuffer) X(epoxy_glGenBuffers) \
    X(epoxy_glGenFramebuffers) X(epoxy_glGenRenderbuffers) X(epoxy_glGenTextures) \
    X(epoxy_glGetBufferSubData) X(epoxy_glGetError) X(epoxy_glGetIntegerv) \
    X(epoxy_glGetProgramiv) X(epoxy_glGetShaderInfoLog) X(epoxy_glGetShaderiv) \
    X(epoxy_glGetUniformLocation) X(epoxy_glIsBuffer) X(epoxy_glLinkProgram) \
    X(epoxy_glReadPixels) X(epoxy_glRenderbufferStorageMultisample) X(epoxy_glTexBuffer) \
    X(epoxy_glTexImage2D) X(epoxy_glTexImage3D) X(epoxy_glTexSubImage2D) \
    X(epoxy_glTransformFeedbackVaryings) X(epoxy_glUniform1i) X(epoxy_glUniform2fv) \
    X(epoxy_glUniform4fv) X(epoxy_glUseProgram) X(epoxy_glVertexAttribIPointer) \
    X(epoxy_glVertexAttribPointer) X(epoxy_glViewport)
// clang-format on

// The pointers that the headers of libepoxy declare.
#define LISSOM_DEFINE_POINTER(name) decltype(name) name = nullptr;
LISSOM_OPENGL_FUNCTIONS(LISSOM_DEFINE_POINTER)
#undef LISSOM_DEFINE_POINTER

namespace lissom::gl {
namespace {

struct Epoxy {
    std::once_flag loaded;
    decltype(&epoxy_gl_version) gl_version = nullptr;
    decltype(&epoxy_has_gl_extension) has_gl_extension = nullptr;
    decltype(&epoxy_has_egl_extension) has_egl_extension = nullptr;
};

// Functions of the process's one driver.
Epoxy& epoxy() {
    static Epoxy functions;
    return functions;
}

void* open_library(const std::string& library) {
    if (void* handle = dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL)) return handle;
    throw Error(ErrorCode::no_display,
                "pictures and windows need " + library +
                    ", which is not on this machine (on Debian: apt-get install libepoxy0). "
                    "Everything else works without it");
}

void* find_symbol(void* handle, const char* name) {
    if (void* symbol = dlsym(handle, name)) return symbol;
    throw Error(ErrorCode::no_display, std::string("this libepoxy has no ") + name);
}

// Each pointer of libepoxy leads to a function that finds that of the driver when it is called.
void load(const std::string& library) {
    void* handle = open_library(library);
#define LISSOM_LOAD_POINTER(name) name = *static_cast<decltype(name)*>(find_symbol(handle, #name));
    LISSOM_OPENGL_FUNCTIONS(LISSOM_LOAD_POINTER)
#undef LISSOM_LOAD_POINTER
    const auto find = [&](auto& function, const char* name) {
        function = reinterpret_cast<std::decay_t<decltype(function)>>(find_symbol(handle, name));
    };
    find(epoxy().gl_version, "epoxy_gl_version");
    find(epoxy().has_gl_extension, "epoxy_has_gl_extension");
    find(epoxy().has_egl_extension, "epoxy_has_egl_extension");
}

}  // namespace

void load_opengl(const std::string& library) {
    std::call_once(epoxy().loaded, load, library);
}

}  // namespace lissom::gl

int epoxy_gl_version() {
    return lissom::gl::epoxy().gl_version();
}
bool epoxy_has_gl_extension(const char* extension) {
    return lissom::gl::epoxy().has_gl_extension(extension);
}
bool epoxy_has_egl_extension(EGLDisplay display, const char* extension) {
    return lissom::gl::epoxy().has_egl_extension(display, extension);
}
