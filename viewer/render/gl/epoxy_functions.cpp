// The functions of OpenGL and EGL that the viewer and its tests call, each looked up in libepoxy
// when it is first called: a program that draws nothing starts without it. libepoxy's own pointers
// lead to a function of the driver from its first call on.
#define EGL_NO_X11
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <string>

#include "kernel/core/error.h"

namespace {

void* library() {
    static void* const loaded = dlopen("libepoxy.so.0", RTLD_NOW | RTLD_LOCAL);
    if (loaded) return loaded;
    throw lissom::Error(lissom::ErrorCode::no_display,
                        "pictures need libepoxy.so.0, which is not on this machine; install "
                        "libepoxy (on Debian: apt-get install libepoxy0). Everything else works "
                        "without it");
}

template <typename Pointer>
Pointer find(const char* symbol) {
    if (void* const found = dlsym(library(), symbol)) return reinterpret_cast<Pointer>(found);
    throw lissom::Error(lissom::ErrorCode::no_display,
                        std::string("libepoxy.so.0 is older than 1.5: it has no ") + symbol);
}

template <typename Pointer, typename Symbol>
struct Lookup;

template <typename Result, typename... Arguments, typename Symbol>
struct Lookup<Result (*)(Arguments...), Symbol> {
    static Result call(Arguments... arguments) {
        static auto* const pointer = find<Result (**)(Arguments...)>(Symbol::text);
        return (*pointer)(arguments...);
    }
};

}  // namespace

extern "C" {

bool epoxy_has_egl_extension(EGLDisplay display, const char* extension) {
    static auto* const function =
        find<decltype(&epoxy_has_egl_extension)>("epoxy_has_egl_extension");
    return function(display, extension);
}

bool epoxy_has_gl_extension(const char* extension) {
    static auto* const function = find<decltype(&epoxy_has_gl_extension)>("epoxy_has_gl_extension");
    return function(extension);
}

int epoxy_gl_version() {
    static auto* const function = find<decltype(&epoxy_gl_version)>("epoxy_gl_version");
    return function();
}
}

#define LISSOM_EPOXY(name)                                  \
    namespace {                                             \
    struct Symbol_##name {                                  \
        static constexpr const char* text = "epoxy_" #name; \
    };                                                      \
    }                                                       \
    decltype(epoxy_##name) epoxy_##name = &Lookup<decltype(epoxy_##name), Symbol_##name>::call;

LISSOM_EPOXY(eglBindAPI)
LISSOM_EPOXY(eglChooseConfig)
LISSOM_EPOXY(eglCreateContext)
LISSOM_EPOXY(eglCreatePbufferSurface)
LISSOM_EPOXY(eglDestroyContext)
LISSOM_EPOXY(eglDestroySurface)
LISSOM_EPOXY(eglGetCurrentContext)
LISSOM_EPOXY(eglGetCurrentDisplay)
LISSOM_EPOXY(eglGetCurrentSurface)
LISSOM_EPOXY(eglGetDisplay)
LISSOM_EPOXY(eglGetPlatformDisplayEXT)
LISSOM_EPOXY(eglInitialize)
LISSOM_EPOXY(eglMakeCurrent)
LISSOM_EPOXY(eglQueryAPI)
LISSOM_EPOXY(eglQueryDevicesEXT)
LISSOM_EPOXY(eglSurfaceAttrib)
LISSOM_EPOXY(glActiveTexture)
LISSOM_EPOXY(glAttachShader)
LISSOM_EPOXY(glBeginTransformFeedback)
LISSOM_EPOXY(glBindBuffer)
LISSOM_EPOXY(glBindBufferBase)
LISSOM_EPOXY(glBindFramebuffer)
LISSOM_EPOXY(glBindRenderbuffer)
LISSOM_EPOXY(glBindTexture)
LISSOM_EPOXY(glBindVertexArray)
LISSOM_EPOXY(glBlendFunc)
LISSOM_EPOXY(glBlitFramebuffer)
LISSOM_EPOXY(glBufferData)
LISSOM_EPOXY(glBufferSubData)
LISSOM_EPOXY(glCheckFramebufferStatus)
LISSOM_EPOXY(glClear)
LISSOM_EPOXY(glClearColor)
LISSOM_EPOXY(glCompileShader)
LISSOM_EPOXY(glCreateProgram)
LISSOM_EPOXY(glCreateShader)
LISSOM_EPOXY(glDebugMessageCallback)
LISSOM_EPOXY(glDeleteBuffers)
LISSOM_EPOXY(glDeleteFramebuffers)
LISSOM_EPOXY(glDeleteProgram)
LISSOM_EPOXY(glDeleteRenderbuffers)
LISSOM_EPOXY(glDeleteShader)
LISSOM_EPOXY(glDeleteTextures)
LISSOM_EPOXY(glDeleteVertexArrays)
LISSOM_EPOXY(glDepthFunc)
LISSOM_EPOXY(glDepthMask)
LISSOM_EPOXY(glDisable)
LISSOM_EPOXY(glDrawArrays)
LISSOM_EPOXY(glDrawArraysInstanced)
LISSOM_EPOXY(glDrawElements)
LISSOM_EPOXY(glEnable)
LISSOM_EPOXY(glEnableVertexAttribArray)
LISSOM_EPOXY(glEndTransformFeedback)
LISSOM_EPOXY(glFinish)
LISSOM_EPOXY(glFramebufferRenderbuffer)
LISSOM_EPOXY(glFramebufferTexture2D)
LISSOM_EPOXY(glGenBuffers)
LISSOM_EPOXY(glGenFramebuffers)
LISSOM_EPOXY(glGenRenderbuffers)
LISSOM_EPOXY(glGenTextures)
LISSOM_EPOXY(glGenVertexArrays)
LISSOM_EPOXY(glGetBufferSubData)
LISSOM_EPOXY(glGetError)
LISSOM_EPOXY(glGetGraphicsResetStatus)
LISSOM_EPOXY(glGetIntegerv)
LISSOM_EPOXY(glGetProgramInfoLog)
LISSOM_EPOXY(glGetProgramiv)
LISSOM_EPOXY(glGetShaderInfoLog)
LISSOM_EPOXY(glGetShaderiv)
LISSOM_EPOXY(glGetString)
LISSOM_EPOXY(glGetUniformLocation)
LISSOM_EPOXY(glIsBuffer)
LISSOM_EPOXY(glLinkProgram)
LISSOM_EPOXY(glPixelStorei)
LISSOM_EPOXY(glPolygonOffset)
LISSOM_EPOXY(glReadPixels)
LISSOM_EPOXY(glRenderbufferStorageMultisample)
LISSOM_EPOXY(glShaderSource)
LISSOM_EPOXY(glTexBuffer)
LISSOM_EPOXY(glTexImage2D)
LISSOM_EPOXY(glTexImage3D)
LISSOM_EPOXY(glTexParameteri)
LISSOM_EPOXY(glTexSubImage2D)
LISSOM_EPOXY(glTransformFeedbackVaryings)
LISSOM_EPOXY(glUniform1f)
LISSOM_EPOXY(glUniform1i)
LISSOM_EPOXY(glUniform2fv)
LISSOM_EPOXY(glUniform3fv)
LISSOM_EPOXY(glUniform4fv)
LISSOM_EPOXY(glUniformMatrix4fv)
LISSOM_EPOXY(glUseProgram)
LISSOM_EPOXY(glVertexAttribDivisor)
LISSOM_EPOXY(glVertexAttribIPointer)
LISSOM_EPOXY(glVertexAttribPointer)
LISSOM_EPOXY(glViewport)

#undef LISSOM_EPOXY
