/// The part of the panel for tools: the tool in hand, its parameters, the history of the scene; and
/// the marks of a tool over the picture. Drawn by Dear ImGui.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/window/panel/parameter_widgets.h"
#include "viewer/window/screen/canvas.h"
#include "viewer/window/tools/tool_bench.h"

namespace lissom::window {

/// A tool that can be taken in hand.
struct ToolButton {
    /// A file, or the name of one that ships.
    std::string word;
    /// The name that the file gives it, once it was in hand; until then that of the file.
    std::string label;

    bool operator==(const ToolButton&) const = default;
};

/// Returns the button of a tool that was never in hand.
ToolButton button_of(const std::string& word);
/// The tool that a word takes in hand has a button with a name from now on.
void keep_button(std::vector<ToolButton>& buttons, const std::string& word,
                 const std::string& name);
/// The tool in hand has a button from now on, with its name.
void keep_button(std::vector<ToolButton>& buttons, const ToolState& state);

/// Requests of a person in one frame.
struct ToolAnswers {
    /// Another tool; empty for none.
    std::optional<std::string> tool = std::nullopt;
    /// Place of a parameter of the tool that has another value.
    std::optional<std::size_t> parameter = std::nullopt;
    bool undo = false, redo = false;
    /// An object that shall be seen or hidden.
    std::optional<ToolObject> object = std::nullopt;
};

/// Returns the objects of the scene, each with a box whether it is seen.
ToolAnswers draw_scene_objects(const ToolState& state);

/// Buttons for tools, and the parameters of the one in hand, whose values a person may change.
ToolAnswers draw_tools(const std::vector<ToolButton>& buttons, ToolState& state,
                       const PickerContent& pickers);
/// Draws the steps, with undone ones in grey.
ToolAnswers draw_history(const ToolState& state);
/// Picture that a tool draws on.
struct MarkedPicture {
    Camera camera;
    /// Size in pixels, and its place in the window.
    PictureSize size;
    Canvas canvas;
    /// Pixels in one of a tool's.
    double scale = 1.0;
};
/// Text and lines of a tool over a picture.
void draw_marks(const ToolState& state, const MarkedPicture& picture);

}  // namespace lissom::window
