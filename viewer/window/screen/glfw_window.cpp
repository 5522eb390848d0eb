#include "viewer/window/screen/glfw_window.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
// After epoxy.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <utility>

#include "kernel/core/error.h"
#include "viewer/window/screen/key_letter.h"

namespace lissom::window {
namespace {

std::string last_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason is known";
}

struct Library {
    Library() {
        if (glfwInit()) return;
        throw Error(ErrorCode::no_display,
                    "a window needs a screen (" + last_error() +
                        "); `lissom render` and `lissom run` draw pictures without one");
    }
    ~Library() { glfwTerminate(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

constexpr std::array kKeys{std::pair{GLFW_KEY_ESCAPE, Key::escape},
                           std::pair{GLFW_KEY_ENTER, Key::enter},
                           std::pair{GLFW_KEY_KP_ENTER, Key::enter},
                           std::pair{GLFW_KEY_TAB, Key::tab},
                           std::pair{GLFW_KEY_BACKSPACE, Key::backspace},
                           std::pair{GLFW_KEY_DELETE, Key::del},
                           std::pair{GLFW_KEY_LEFT, Key::left},
                           std::pair{GLFW_KEY_RIGHT, Key::right},
                           std::pair{GLFW_KEY_UP, Key::up},
                           std::pair{GLFW_KEY_DOWN, Key::down},
                           std::pair{GLFW_KEY_HOME, Key::home},
                           std::pair{GLFW_KEY_END, Key::end},
                           std::pair{GLFW_KEY_PAGE_UP, Key::page_up},
                           std::pair{GLFW_KEY_PAGE_DOWN, Key::page_down},
                           std::pair{GLFW_KEY_SPACE, Key::space},
                           std::pair{GLFW_KEY_F5, Key::f5},
                           std::pair{GLFW_KEY_F12, Key::f12}};

Key key_of(int code) {
    const auto* found = std::find_if(kKeys.begin(), kKeys.end(),
                                     [&](const auto& pair) { return pair.first == code; });
    if (found != kKeys.end()) return found->second;
    return Key::none;
}

// The text that the present layout gives a key.
std::string name_of(int code) {
    const char* const name = glfwGetKeyName(code, 0);
    return name ? name : "";
}

void press_key(InputMaker& inputs, int code, bool is_down, const Modifiers& held) {
    const Key key = key_of(code);
    const char32_t letter = key == Key::none ? key_letter(code, name_of) : 0;
    inputs.key(letter != 0 ? Key::character : key, letter, is_down, held);
}

Modifiers modifiers_of(int bits) {
    return {(bits & GLFW_MOD_SHIFT) != 0, (bits & GLFW_MOD_CONTROL) != 0,
            (bits & GLFW_MOD_ALT) != 0};
}

// With the key of a modifier X tells the modifiers held before it.
Modifiers modifiers_after(int code, bool is_down, Modifiers held) {
    if (code == GLFW_KEY_LEFT_SHIFT || code == GLFW_KEY_RIGHT_SHIFT) held.shift = is_down;
    if (code == GLFW_KEY_LEFT_CONTROL || code == GLFW_KEY_RIGHT_CONTROL) held.ctrl = is_down;
    if (code == GLFW_KEY_LEFT_ALT || code == GLFW_KEY_RIGHT_ALT) held.alt = is_down;
    return held;
}

// How a context is asked for.
struct ContextKind {
    int api, robustness;
};
// Through EGL, which starts sooner, else through GLX; one that tells when it is lost, else any.
constexpr std::array kContextKinds{ContextKind{GLFW_EGL_CONTEXT_API, GLFW_LOSE_CONTEXT_ON_RESET},
                                   ContextKind{GLFW_EGL_CONTEXT_API, GLFW_NO_ROBUSTNESS},
                                   ContextKind{GLFW_NATIVE_CONTEXT_API, GLFW_LOSE_CONTEXT_ON_RESET},
                                   ContextKind{GLFW_NATIVE_CONTEXT_API, GLFW_NO_ROBUSTNESS}};

GLFWwindow* create(const std::string& title, gl::Extent size) {
    std::string reason;
    for (const ContextKind& kind : kContextKinds) {
        glfwDefaultWindowHints();
        glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, kind.robustness);
        glfwWindowHint(GLFW_CONTEXT_CREATION_API, kind.api);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_DEPTH_BITS, 0);
        glfwWindowHint(GLFW_STENCIL_BITS, 0);
        glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
        if (GLFWwindow* window =
                glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr)) {
            return window;
        }
        const std::string error = last_error();
        if (reason.find(error) == std::string::npos) {
            reason += (reason.empty() ? "" : "; ") + error;
        }
    }
    throw Error(ErrorCode::no_display,
                "no window with OpenGL 3.3 can be opened here (" + reason +
                    "); install a driver (on Debian: apt-get install libgl1-mesa-dri)");
}

// No larger than the screen leaves room for.
void fit_to_screen(GLFWwindow* window) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (!monitor) return;
    int x = 0, y = 0, room_width = 0, room_height = 0, width = 0, height = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &room_width, &room_height);
    glfwGetWindowSize(window, &width, &height);
    if (width <= room_width && height <= room_height) return;
    glfwSetWindowSize(window, std::min(width, room_width), std::min(height, room_height));
}

}  // namespace

struct GlfwWindow::State {
    Library library;
    GLFWwindow* window = nullptr;
    std::string title;
    bool can_be_lost = false;
    std::function<void(const std::string&)> driver_listener;
    bool keeps_picture = false, is_exposed = false;
    InputMaker inputs{[this] { return scale(); }};

    ~State() {
        if (window) glfwDestroyWindow(window);
    }

    static State& of(GLFWwindow* window) {
        return *static_cast<State*>(glfwGetWindowUserPointer(window));
    }

    PixelScale scale() const {
        PixelScale found;
        glfwGetWindowSize(window, &found.window.width, &found.window.height);
        glfwGetFramebufferSize(window, &found.framebuffer.width, &found.framebuffer.height);
        float x = 1.0f, y = 1.0f;
        glfwGetWindowContentScale(window, &x, &y);
        found.content = x;
        return found;
    }

    void listen();
    bool ask_to_keep_picture() const;
    void open(gl::Extent size);
    void listen_to_driver();
    static void EPOXY_CALLSPEC hear_driver(GLenum, GLenum type, GLuint, GLenum, GLsizei,
                                           const GLchar* message, const void* state) {
        if (type == GL_DEBUG_TYPE_PERFORMANCE || type == GL_DEBUG_TYPE_OTHER) return;
        static_cast<const State*>(state)->driver_listener(message);
    }
};

void GlfwWindow::State::listen() {
    glfwSetWindowUserPointer(window, this);
    Vec2 cursor = Vec2::Zero();
    glfwGetCursorPos(window, &cursor.x(), &cursor.y());
    inputs.begin(cursor);
    glfwSetCursorPosCallback(window, [](GLFWwindow* from, double x, double y) {
        of(from).inputs.move({x, y});
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* from, int button, int action, int bits) {
        if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
        of(from).inputs.button(static_cast<MouseButton>(button), action == GLFW_PRESS,
                               modifiers_of(bits));
    });
    glfwSetScrollCallback(window, [](GLFWwindow* from, double x, double y) {
        of(from).inputs.scroll({x, y});
    });
    glfwSetKeyCallback(window, [](GLFWwindow* from, int code, int, int action, int bits) {
        const bool is_down = action != GLFW_RELEASE;
        press_key(of(from).inputs, code, is_down,
                  modifiers_after(code, is_down, modifiers_of(bits)));
    });
    glfwSetCharCallback(
        window, [](GLFWwindow* from, unsigned character) { of(from).inputs.text(character); });
    glfwSetDropCallback(window, [](GLFWwindow* from, int count, const char** paths) {
        of(from).inputs.drop({paths, paths + count});
    });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* from) { of(from).is_exposed = true; });
}

// Returns whether the driver promises that the shown picture stays there to be drawn on. Through
// GLX none does.
bool GlfwWindow::State::ask_to_keep_picture() const {
    if (glfwGetWindowAttrib(window, GLFW_CONTEXT_CREATION_API) != GLFW_EGL_CONTEXT_API) {
        return false;
    }
    return eglSurfaceAttrib(eglGetCurrentDisplay(), eglGetCurrentSurface(EGL_DRAW),
                            EGL_SWAP_BEHAVIOR, EGL_BUFFER_PRESERVED) == EGL_TRUE;
}

void GlfwWindow::State::open(gl::Extent size) {
    window = create(title, size);
    fit_to_screen(window);
    glfwMakeContextCurrent(window);
    glfwSwapInterval(0);
    can_be_lost = epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_KHR_robustness");
    keeps_picture = ask_to_keep_picture();
    is_exposed = true;
    listen();
    listen_to_driver();
}

void GlfwWindow::State::listen_to_driver() {
    if (!driver_listener || !epoxy_has_gl_extension("GL_KHR_debug")) return;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(&hear_driver, this);
}

GlfwWindow::GlfwWindow(const std::string& title, gl::Extent size)
    : state_(std::make_unique<State>()) {
    state_->title = title;
    state_->open(size);
}

bool GlfwWindow::lost() const {
    return state_->can_be_lost && glGetGraphicsResetStatus() != GL_NO_ERROR;
}

void GlfwWindow::reopen() {
    gl::Extent size;
    int x = 0, y = 0;
    glfwGetWindowSize(state_->window, &size.width, &size.height);
    glfwGetWindowPos(state_->window, &x, &y);
    glfwDestroyWindow(std::exchange(state_->window, nullptr));
    state_->open(size);
    glfwSetWindowPos(state_->window, x, y);
}

void GlfwWindow::listen_to_driver(std::function<void(const std::string&)> listener) {
    state_->driver_listener = std::move(listener);
    state_->listen_to_driver();
}

GlfwWindow::~GlfwWindow() = default;

void GlfwWindow::wait(double seconds) {
    if (seconds > 0.0) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
}

void GlfwWindow::wake() {
    glfwPostEmptyEvent();
}

InputQueue& GlfwWindow::inputs() {
    return state_->inputs.queue();
}

gl::Extent GlfwWindow::size() const {
    gl::Extent size;
    glfwGetFramebufferSize(state_->window, &size.width, &size.height);
    return size;
}

PixelScale GlfwWindow::scale() const {
    return state_->scale();
}

bool GlfwWindow::close_requested() const {
    return glfwWindowShouldClose(state_->window) != 0;
}

void GlfwWindow::set_title(const std::string& title) {
    state_->title = title;
    glfwSetWindowTitle(state_->window, title.c_str());
}

void GlfwWindow::set_clipboard(const std::string& text) {
    glfwSetClipboardString(state_->window, text.c_str());
}

const char* GlfwWindow::clipboard() const {
    const char* text = glfwGetClipboardString(state_->window);
    return text ? text : "";
}

bool GlfwWindow::is_exposed() const {
    return state_->is_exposed;
}

bool GlfwWindow::has_picture() const {
    return state_->keeps_picture && !state_->is_exposed;
}

void GlfwWindow::show() {
    glfwSwapBuffers(state_->window);
    state_->is_exposed = false;
}

}  // namespace lissom::window
