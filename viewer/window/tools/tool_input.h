/// Inputs of a hand for a tool; and a queue that keeps each move.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kernel/sketch/camera.h"
#include "viewer/render/gl/gl_objects.h"
#include "viewer/window/screen/input.h"

namespace lissom::window {

/// `play` is an event of the open recording, `stop` releases the objects that it holds.
struct ToolInput {
    enum class Kind {
        press,
        move,
        release,
        wheel,
        tick,
        key,
        cancel,
        undo,
        redo,
        look,
        play,
        stop
    };

    Kind kind = Kind::move;
    /// From the top left corner of the picture, in a tool's pixels.
    Vec2 at = Vec2::Zero();
    MouseButton button = MouseButton::left;
    Modifiers modifiers = {};
    /// For wheel: lines upwards.
    double lines = 0.0;
    /// For tick: time since the last one.
    double seconds = 0.0;
    /// "enter", "a", ...
    std::string key = {};
    /// For look: the present camera of the picture, and its size.
    Camera camera = {};
    gl::Extent size = {};
    /// For look: the axis of the world that points up in the window's views.
    ViewUp up = ViewUp::y;
    /// For play: the place of the event in the recording, from 0.
    std::size_t event = 0;
};

/// The pixels of tools: as large on every screen, so that a radius means the same on another
/// screen, and a recording can be played there.
struct ToolPixels {
    /// Pixels of the screen in one.
    double scale = 1.0;

    Vec2 at(const Vec2& pixel) const { return pixel / scale; }
    /// Returns the size of a picture in these pixels.
    gl::Extent size(const PictureSize& pixels) const;
};

/// Adds `input` behind others. A look that follows a look takes its place, and turns of the wheel
/// and ticks are summed. Moves are all kept: a stroke is its whole course.
void push_input(std::vector<ToolInput>& inputs, ToolInput input);

/// Returns whether the input at `place` is a move that another move follows, with the same
/// modifiers: a tool may leave out its intermediate drawing.
bool is_followed(const std::vector<ToolInput>& inputs, std::size_t place);

/// Returns the name of a key as tools know it: "enter", "a", "7"; empty for one that they are not
/// told of. A letter that is not Latin has the name of the Latin letter on its key.
std::string tool_key(const Input& input);

}  // namespace lissom::window
