/// ViewState: the state shared by the parts of the window's program: the desktop, the shown picture
/// and its camera, the content of the panel, and times of changes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "kernel/core/clock.h"
#include "kernel/sketch/view.h"
#include "viewer/window/panel/panel.h"
#include "viewer/window/screen/glfw_window.h"
#include "viewer/window/screen/screen.h"
#include "viewer/window/session/session.h"

namespace lissom::window {

/// Time of the last visible change, whether it was drawn, and the frames owed.
class Changes {
  public:
    /// Something else is to be seen from now on.
    void add();
    /// The same in another size.
    void add_size() { ++number_; }
    /// The panel says something else.
    void owe_frames() { frames_ = kFrames; }
    void begin_frame() { frames_ -= frames_ > 0 ? 1 : 0; }
    bool owes_frame() const { return frames_ > 0; }

    /// Grows with each change.
    std::uint64_t number() const { return number_; }
    /// The last change is in the picture.
    void set_drawn() { drawn_ = number_; }
    bool is_drawn() const { return drawn_ == number_; }
    /// Returns the number of the change that is in the picture.
    std::uint64_t drawn() const { return drawn_; }
    /// Since the last change.
    double seconds() const { return seconds_since(last_); }

  private:
    // Lists of the panel open in the second.
    static constexpr int kFrames = 2;

    std::uint64_t number_ = 1, drawn_ = 0;
    Clock::time_point last_ = Clock::now();
    int frames_ = kFrames;
};

struct ViewState {
    GlfwWindow& window;
    Panel& panel;
    Session& session;
    ToolPixels pixels = {};
    /// Whether events are written to the standard output, for tests.
    bool tells = false;
    /// Empty only while a lost context is replaced.
    std::optional<Screen> screen{std::in_place};
    Changes changes = {};
    PanelContent content = {};
    DisplaySettings settings = {};
    std::optional<Shown> shown = {};
    Camera camera = {};
    /// The axis that points up in views, if a person or a saved scene has chosen it; the open
    /// document sets it otherwise.
    std::optional<ViewUp> up = {};
    /// Whether the camera was chosen for the open document.
    bool camera_is_placed = false;
    /// A recording is played: the hand waits.
    bool plays = false;
    /// Whether anything was told since the last rest.
    bool has_told = true;

    /// Returns the part of the window beside the panel.
    Canvas canvas() const { return panel.canvas(window.size()); }
    View view() const;
    /// Returns the axis that points up in views.
    ViewUp up_axis() const;
    bool has_tool() const { return !content.tool.tool.empty(); }
    /// Returns whether there is nothing to draw on.
    bool is_icon() const;

    void tell(const std::string& text);
    /// A line of the console, seen with the next frame.
    void add_line(LineKind kind, std::string text);
    void set_camera(const Camera& camera);
    /// Lets tools see the hand's camera.
    void tell_camera();
};

}  // namespace lissom::window
