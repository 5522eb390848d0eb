/// Panel: the controls beside the picture: its contents and looks, the parameters of the script,
/// and the console. Drawn by Dear ImGui into the window of the current context.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "viewer/render/gl/gl_objects.h"
#include "viewer/window/panel/drawn_lists.h"
#include "viewer/window/panel/panel_content.h"
#include "viewer/window/screen/canvas.h"
#include "viewer/window/screen/display.h"
#include "viewer/window/screen/input.h"

namespace lissom::window {

/// Functions of the desktop for a panel.
struct PanelHost {
    /// Pixels in a unit of length.
    double scale = 1.0;
    std::function<void(const std::string&)> set_clipboard = {};
    /// Stays until the clipboard changes.
    std::function<const char*()> clipboard = {};
};

/// Parts of a window to draw.
enum class PanelPart { all, over_picture };

class Panel {
  public:
    /// A panel in the window of the current context, which is also current when the panel ends.
    /// Errors: one at a time in a process (invalid_argument).
    explicit Panel(PanelHost host);
    ~Panel();
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;

    /// Releases the objects in the context of the window, and makes them again in another one,
    /// which is current by then.
    void leave_context();
    void enter_context();

    /// Takes input for the next frames, in its order.
    void feed(const Input& input);
    /// Returns whether input is left that one frame more must take: a press and a release are never
    /// taken at once.
    bool owes_frame() const;
    /// Returns whether the mouse at a pixel of the window, or typed text, belongs to the panel: by
    /// the last drawn frame, for any place of the mouse then.
    bool wants_mouse(const Vec2& at, gl::Extent window) const;
    bool wants_keys() const;

    /// Returns the part of a window beside the panel.
    Canvas canvas(gl::Extent window) const;

    /// Makes the next frame. Changes `settings` and the values of `content.parameters` as a person
    /// asks.
    PanelAnswers make(PanelContent& content, DisplaySettings& settings, gl::Extent window,
                      double seconds);
    /// Returns how that differs from the frame before.
    const DrawnLists& lists() const;
    /// Draws it over the bound framebuffer.
    void draw(PanelPart part) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lissom::window
