/// Content of a panel, and the requests of a person in one frame of it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/core/script_parameters.h"
#include "kernel/sketch/camera.h"
#include "viewer/window/makers/coloring.h"
#include "viewer/window/panel/pick_choices.h"
#include "viewer/window/panel/tool_panel.h"
#include "viewer/window/session/session_news.h"
#include "viewer/window/session/source_place.h"

namespace lissom::window {

/// Progress of a recording that is played.
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
    /// Choices for parameters of the script and the tool, and the one that a click in the picture
    /// picks for.
    PickChoices picks;
    std::optional<Picking> picking;
    /// Names of the presets of the parameters; none without a script to keep them for.
    std::optional<std::vector<std::string>> presets;
    std::vector<ConsoleLine> lines;
    /// Completion of the console's line; the panel takes it.
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

}  // namespace lissom::window
