/// What a hand does to the picture, on its way to a tool; and a queue in which moves do not pile
/// up.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kernel/sketch/camera.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/window/screen/input.h"

namespace lissom::window {

/// `play` is an event of the recording that is open, `stop` lets go of what it holds.
struct ToolInput {
    enum class Kind { press, move, release, wheel, key, cancel, undo, redo, look, play, stop };

    Kind kind = Kind::move;
    /// From the top left corner of the picture, in a tool's pixels.
    Vec2 at = Vec2::Zero();
    MouseButton button = MouseButton::left;
    Modifiers modifiers = {};
    /// Of wheel: lines upwards.
    double lines = 0.0;
    /// "enter", "a", ...
    std::string key = {};
    /// Of look: from where the picture is seen now, and its size.
    Camera camera = {};
    gl::Extent size = {};
    /// Of play: the place of the event in the recording, from 0.
    std::size_t event = 0;
};

/// The pixels of tools: as large on every screen, so that a hand finds within a radius what it
/// found on another screen, and a recording can be played there.
struct ToolPixels {
    /// Pixels of the screen in one.
    double scale = 1.0;

    Vec2 at(const Vec2& pixel) const { return pixel / scale; }
    /// Of a picture of so many pixels.
    gl::Extent size(const PictureSize& pixels) const;
};

/// Adds `input` behind others. A move that follows a move with the same buttons, or a look that
/// follows a look, takes its place, and turns of the wheel are summed: whoever is slower than the
/// hand is never behind by more than one.
void push_input(std::vector<ToolInput>& inputs, ToolInput input);

/// The name of a key as tools know it: "enter", "a", "7"; empty for one that they are not told of.
std::string tool_key(const Input& input);

}  // namespace lissom::window
