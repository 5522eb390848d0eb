// The functions of GLFW that this program and Dear ImGui's platform call, each looked up in the
// shared library when it is first called: a program that opens no window starts without GLFW and
// the eight libraries of X that come with it. If it is missing glfwInit fails, and glfwGetError
// says so.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <dlfcn.h>

namespace {

void* library() {
    static void* const loaded = dlopen("libglfw.so.3", RTLD_NOW | RTLD_LOCAL);
    return loaded;
}

template <typename Function>
Function* find(const char* name) {
    return reinterpret_cast<Function*>(dlsym(library(), name));
}

}  // namespace

extern "C" {

int glfwInit() {
    return library() ? find<decltype(glfwInit)>("glfwInit")() : GLFW_FALSE;
}

void glfwTerminate() {
    if (library()) find<decltype(glfwTerminate)>("glfwTerminate")();
}

int glfwGetError(const char** description) {
    if (library()) return find<decltype(glfwGetError)>("glfwGetError")(description);
    if (description) *description = "libglfw.so.3 is missing; on Debian: apt-get install libglfw3";
    return GLFW_NOT_INITIALIZED;
}

// Called after glfwInit alone, which has found the library.
#define LISSOM_GLFW(result, name, parameters, arguments)           \
    result name parameters {                                       \
        static auto* const function = find<decltype(name)>(#name); \
        return function arguments;                                 \
    }

LISSOM_GLFW(GLFWcursor*, glfwCreateStandardCursor, (int shape), (shape))
LISSOM_GLFW(GLFWwindow*, glfwCreateWindow,
            (int width, int height, const char* title, GLFWmonitor* monitor, GLFWwindow* share),
            (width, height, title, monitor, share))
LISSOM_GLFW(void, glfwDefaultWindowHints, (), ())
LISSOM_GLFW(void, glfwDestroyCursor, (GLFWcursor * cursor), (cursor))
LISSOM_GLFW(void, glfwDestroyWindow, (GLFWwindow * window), (window))
LISSOM_GLFW(const char*, glfwGetClipboardString, (GLFWwindow * window), (window))
LISSOM_GLFW(void, glfwGetCursorPos, (GLFWwindow * window, double* xpos, double* ypos),
            (window, xpos, ypos))
LISSOM_GLFW(void, glfwGetFramebufferSize, (GLFWwindow * window, int* width, int* height),
            (window, width, height))
LISSOM_GLFW(int, glfwGetInputMode, (GLFWwindow * window, int mode), (window, mode))
LISSOM_GLFW(const float*, glfwGetJoystickAxes, (int jid, int* count), (jid, count))
LISSOM_GLFW(const unsigned char*, glfwGetJoystickButtons, (int jid, int* count), (jid, count))
LISSOM_GLFW(const char*, glfwGetKeyName, (int key, int scancode), (key, scancode))
LISSOM_GLFW(void, glfwGetMonitorWorkarea,
            (GLFWmonitor * monitor, int* xpos, int* ypos, int* width, int* height),
            (monitor, xpos, ypos, width, height))
LISSOM_GLFW(int, glfwGetMouseButton, (GLFWwindow * window, int button), (window, button))
LISSOM_GLFW(GLFWmonitor*, glfwGetPrimaryMonitor, (), ())
LISSOM_GLFW(double, glfwGetTime, (), ())
LISSOM_GLFW(int, glfwGetWindowAttrib, (GLFWwindow * window, int attrib), (window, attrib))
LISSOM_GLFW(void, glfwGetWindowContentScale, (GLFWwindow * window, float* xscale, float* yscale),
            (window, xscale, yscale))
LISSOM_GLFW(void, glfwGetWindowPos, (GLFWwindow * window, int* xpos, int* ypos),
            (window, xpos, ypos))
LISSOM_GLFW(void, glfwGetWindowSize, (GLFWwindow * window, int* width, int* height),
            (window, width, height))
LISSOM_GLFW(void*, glfwGetWindowUserPointer, (GLFWwindow * window), (window))
LISSOM_GLFW(void, glfwMakeContextCurrent, (GLFWwindow * window), (window))
LISSOM_GLFW(void, glfwPollEvents, (), ())
LISSOM_GLFW(void, glfwPostEmptyEvent, (), ())
LISSOM_GLFW(GLFWcharfun, glfwSetCharCallback, (GLFWwindow * window, GLFWcharfun callback),
            (window, callback))
LISSOM_GLFW(void, glfwSetClipboardString, (GLFWwindow * window, const char* string),
            (window, string))
LISSOM_GLFW(void, glfwSetCursor, (GLFWwindow * window, GLFWcursor* cursor), (window, cursor))
LISSOM_GLFW(GLFWcursorenterfun, glfwSetCursorEnterCallback,
            (GLFWwindow * window, GLFWcursorenterfun callback), (window, callback))
LISSOM_GLFW(void, glfwSetCursorPos, (GLFWwindow * window, double xpos, double ypos),
            (window, xpos, ypos))
LISSOM_GLFW(GLFWcursorposfun, glfwSetCursorPosCallback,
            (GLFWwindow * window, GLFWcursorposfun callback), (window, callback))
LISSOM_GLFW(GLFWdropfun, glfwSetDropCallback, (GLFWwindow * window, GLFWdropfun callback),
            (window, callback))
LISSOM_GLFW(GLFWerrorfun, glfwSetErrorCallback, (GLFWerrorfun callback), (callback))
LISSOM_GLFW(void, glfwSetInputMode, (GLFWwindow * window, int mode, int value),
            (window, mode, value))
LISSOM_GLFW(GLFWkeyfun, glfwSetKeyCallback, (GLFWwindow * window, GLFWkeyfun callback),
            (window, callback))
LISSOM_GLFW(GLFWmonitorfun, glfwSetMonitorCallback, (GLFWmonitorfun callback), (callback))
LISSOM_GLFW(GLFWmousebuttonfun, glfwSetMouseButtonCallback,
            (GLFWwindow * window, GLFWmousebuttonfun callback), (window, callback))
LISSOM_GLFW(GLFWscrollfun, glfwSetScrollCallback, (GLFWwindow * window, GLFWscrollfun callback),
            (window, callback))
LISSOM_GLFW(GLFWwindowfocusfun, glfwSetWindowFocusCallback,
            (GLFWwindow * window, GLFWwindowfocusfun callback), (window, callback))
LISSOM_GLFW(GLFWwindowrefreshfun, glfwSetWindowRefreshCallback,
            (GLFWwindow * window, GLFWwindowrefreshfun callback), (window, callback))
LISSOM_GLFW(void, glfwSetWindowPos, (GLFWwindow * window, int xpos, int ypos), (window, xpos, ypos))
LISSOM_GLFW(void, glfwSetWindowSize, (GLFWwindow * window, int width, int height),
            (window, width, height))
LISSOM_GLFW(void, glfwSetWindowTitle, (GLFWwindow * window, const char* title), (window, title))
LISSOM_GLFW(void, glfwSetWindowUserPointer, (GLFWwindow * window, void* pointer), (window, pointer))
LISSOM_GLFW(void, glfwSwapBuffers, (GLFWwindow * window), (window))
LISSOM_GLFW(void, glfwSwapInterval, (int interval), (interval))
LISSOM_GLFW(void, glfwWaitEventsTimeout, (double timeout), (timeout))
LISSOM_GLFW(void, glfwWindowHint, (int hint, int value), (hint, value))
LISSOM_GLFW(int, glfwWindowShouldClose, (GLFWwindow * window), (window))

#undef LISSOM_GLFW

}  // extern "C"
