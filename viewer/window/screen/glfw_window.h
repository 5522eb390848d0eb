/// GlfwWindow: a window of the desktop with an OpenGL context, and the input that it gets.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "viewer/render/gl/gl_objects.h"
#include "viewer/window/screen/input.h"
#include "viewer/window/screen/pixel_scale.h"

namespace lissom::window {

class GlfwWindow {
  public:
    /// Opens a window whose context, OpenGL 3.3 core or later, is current on this thread from then
    /// on. Its size is in units of a screen without scaling, and at most that of the screen.
    /// Errors: no_display without a screen, or without such an OpenGL; one at a time in a process
    /// (invalid_argument).
    GlfwWindow(const std::string& title, gl::Extent size);
    ~GlfwWindow();
    GlfwWindow(const GlfwWindow&) = delete;
    GlfwWindow& operator=(const GlfwWindow&) = delete;

    /// Returns whether the driver has lost the contents of this context (it was reset, or the
    /// screen was removed); only `reopen` helps then. false if a driver cannot tell.
    bool lost() const;
    /// Opens a window of the same size with a new context in the place of this one; objects of the
    /// old context must be gone. Errors: no_display.
    void reopen();
    /// Passes on complaints of the driver; for tests.
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
    /// Returns whether the desktop has lost the shown picture: it must be shown again.
    bool is_exposed() const;
    /// Returns whether the last shown picture is there to be drawn on: else all of it must be drawn
    /// before the next `show`.
    bool has_picture() const;
    /// Shows the drawn picture.
    void show();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lissom::window
