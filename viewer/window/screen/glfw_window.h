/// GlfwWindow: a window of the desktop with an OpenGL context, and the input that it gets.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "viewer/gl/gl_objects.h"
#include "viewer/window/screen/input.h"
#include "viewer/window/screen/pixel_scale.h"

namespace lissom::window {

class GlfwWindow {
  public:
    /// Opens a window whose context, OpenGL 3.3 core or later, is current on this thread from then
    /// on. Its size is in units of a screen without scaling, and at most that of the screen.
    /// Errors: no_display where there is no screen, or no such OpenGL; one at a time in a process
    /// (invalid_argument).
    GlfwWindow(const std::string& title, gl::Extent size);
    ~GlfwWindow();
    GlfwWindow(const GlfwWindow&) = delete;
    GlfwWindow& operator=(const GlfwWindow&) = delete;

    /// Whether the driver has lost what was drawn with this context (it was reset, or the screen
    /// was taken away); `reopen` is all that helps then. false where a driver cannot tell.
    bool lost() const;
    /// Opens a window of the same size with a new context in the place of this one; what belonged
    /// to the old context has to be gone. Errors: no_display.
    void reopen();
    /// Hands over what the driver complains of, where it does; for tests.
    void listen_to_driver(std::function<void(const std::string&)> listener);

    /// Waits for input or `wake`, `seconds` at most; 0: looks only.
    void wait(double seconds);
    /// Ends `wait`; from any thread.
    static void wake();
    InputQueue& inputs();

    /// In pixels; zero while the window is an icon.
    gl::Extent size() const;
    PixelScale scale() const;
    bool close_requested() const;
    void set_title(const std::string& title);
    void set_clipboard(const std::string& text);
    /// Stays until the clipboard changes.
    const char* clipboard() const;
    /// Whether the desktop has lost what was shown: it has to be shown again.
    bool is_exposed() const;
    /// Whether what was shown last is there to be drawn on: else all of it has to be drawn before
    /// the next `show`.
    bool has_picture() const;
    /// Shows what was drawn.
    void show();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lissom::window
