/// Panel: the controls beside the picture: its contents and looks, the parameters of the script,
/// and the console. Drawn by Dear ImGui into the window of the current context.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/core/script_parameters.h"
#include "kernel/sketch/camera.h"
#include "viewer/render/gl/gl_objects.h"
#include "viewer/window/makers/coloring.h"
#include "viewer/window/panel/drawn_lists.h"
#include "viewer/window/panel/tool_panel.h"
#include "viewer/window/screen/canvas.h"
#include "viewer/window/screen/display.h"
#include "viewer/window/screen/input.h"
#include "viewer/window/session/session.h"
#include "viewer/window/session/source_place.h"

namespace lissom::window {

/// How far a recording is played.
struct PlayedPart {
    std::string name;
    std::size_t done = 0, count = 0;
    double speed = 1.0;
    bool is_paused = false;
};

/// Content of the panel; its own state is only its unfolded parts.
struct PanelContent {
    std::vector<std::string> objects;
    std::vector<lua::ScriptParameter> parameters;
    /// Names of the presets of the parameters; none without a script to keep them for.
    std::optional<std::vector<std::string>> presets;
    std::vector<ConsoleLine> lines;
    /// How the line of the console may go on; the panel takes it.
    std::optional<Completion> completion;
    std::optional<PlayedPart> playing;
    /// Scenes of windows that were killed, the newest first.
    std::vector<std::filesystem::path> left;
    bool busy = false;
    std::string stage;
    double fraction = 0.0;
    bool is_ortho = false, is_z_up = false;
    /// The file that a mesh is exported to; empty: a free name. A person writes it.
    std::string export_name;
    /// Tools that have a button, and the state of the one in hand.
    std::vector<ToolButton> tools;
    ToolState tool;
    /// Camera of the picture.
    Camera camera;
    PictureSize picture_size;
    /// Choices of the meshes' colours, and the current one.
    std::vector<Coloring> colorings;
    Coloring coloring;
    /// A picture for a file is waited for.
    bool draws_picture = false;
    /// Time of the last frame, without waiting.
    double milliseconds = 0.0;
    std::string driver;
};

/// Requests of a person in one frame.
struct PanelAnswers {
    bool frame_all = false, toggle_ortho = false, screenshot = false, save = false, exports = false,
         toggle_up = false, run_again = false, cancel = false, compare_with_this = false;
    /// Action on the newest left scene.
    bool open_left = false, forget_left = false;
    std::optional<StandardView> view = std::nullopt;
    std::optional<Coloring> coloring = std::nullopt;
    /// A parameter has another value.
    bool parameters_changed = false;
    ToolAnswers tool = {};
    /// A preset to take values from, to keep values in, or to forget.
    std::optional<std::string> load_preset = std::nullopt, save_preset = std::nullopt,
                               remove_preset = std::nullopt;
    /// A line of Lua to evaluate.
    std::optional<std::string> line = std::nullopt;
    /// The line of the console up to the cursor, to be completed.
    std::optional<std::string> complete = std::nullopt;
    /// To be opened in an editor.
    std::optional<SourcePlace> place = std::nullopt;
};

/// Functions of the desktop for a panel.
struct PanelHost {
    /// Pixels in a unit of length.
    double scale = 1.0;
    std::function<void(const std::string&)> set_clipboard = {};
    /// Stays until the clipboard changes.
    std::function<const char*()> clipboard = {};
};

/// Which parts of a window are drawn.
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
