#include "screen.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
// After epoxy.
#include <GLFW/glfw3.h>

#include <cstddef>
#include <vector>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb/stb_image_write.h>

namespace engine {
namespace {

class Window : public Screen {
  public:
    explicit Window(GLFWwindow* window) : window_(window) {
        glfwMakeContextCurrent(window_);
        // A frame of the screen each. A key that was pressed between two of them counts.
        glfwSwapInterval(1);
        glfwSetInputMode(window_, GLFW_STICKY_KEYS, GLFW_TRUE);
    }
    ~Window() override { glfwTerminate(); }
    void show() override {
        glfwSwapBuffers(window_);
        glfwPollEvents();
    }
    Hand hand() override {
        Hand hand;
        int width = 1, height = 1;
        glfwGetWindowSize(window_, &width, &height);
        glfwGetCursorPos(window_, &hand.x, &hand.y);
        hand.x = 2.0 * hand.x / width - 1.0;
        hand.y = 1.0 - 2.0 * hand.y / height;
        hand.is_down = glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
        hand.has_closed = glfwWindowShouldClose(window_) != 0 ||
                          glfwGetKey(window_, GLFW_KEY_ESCAPE) == GLFW_PRESS;
        return hand;
    }

  private:
    GLFWwindow* window_;
};

// A context without a surface, and a picture in memory to draw into.
class Memory : public Screen {
  public:
    bool open() {
        display_ =
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (!display_ || !eglInitialize(display_, nullptr, nullptr)) return false;
        const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE,
                                 EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!eglChooseConfig(display_, wanted, &config, 1, &count) || count == 0) return false;
        eglBindAPI(EGL_OPENGL_API);
        const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3,
                                  EGL_NONE};
        context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
        if (!context_ || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            return false;
        make_target();
        return true;
    }
    ~Memory() override {
        if (!display_) return;
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context_) eglDestroyContext(display_, context_);
        eglTerminate(display_);
    }
    void show() override { glFinish(); }
    Hand hand() override { return {}; }

  private:
    static void make_target() {
        GLuint buffers[2] = {}, target = 0;
        glGenRenderbuffers(2, buffers);
        glGenFramebuffers(1, &target);
        glBindFramebuffer(GL_FRAMEBUFFER, target);
        const GLenum formats[] = {GL_RGBA8, GL_DEPTH_COMPONENT24};
        const GLenum places[] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
        for (int i = 0; i < 2; ++i) {
            glBindRenderbuffer(GL_RENDERBUFFER, buffers[i]);
            glRenderbufferStorage(GL_RENDERBUFFER, formats[i], kWidth, kHeight);
            glFramebufferRenderbuffer(GL_FRAMEBUFFER, places[i], GL_RENDERBUFFER, buffers[i]);
        }
    }

    EGLDisplay display_ = nullptr;
    EGLContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<Screen> open_window() {
    if (!glfwInit()) return nullptr;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
    GLFWwindow* window = glfwCreateWindow(kWidth, kHeight, "engine", nullptr, nullptr);
    if (!window) {
        glfwTerminate();
        return nullptr;
    }
    return std::make_unique<Window>(window);
}

std::unique_ptr<Screen> open_memory() {
    auto memory = std::make_unique<Memory>();
    if (!memory->open()) return nullptr;
    return memory;
}

bool save_picture(const std::string& path) {
    std::vector<unsigned char> pixels(std::size_t{4} * kWidth * kHeight);
    glReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    stbi_flip_vertically_on_write(1);
    return stbi_write_png(path.c_str(), kWidth, kHeight, 4, pixels.data(), 4 * kWidth) != 0;
}

}  // namespace engine
