/// Moves of the window's camera without a drag: to sides, and to frame everything or the selection.
#pragma once

#include "viewer/window/app/view_state.h"

namespace lissom::window {

/// Each does nothing if nothing is shown.
void frame_all(ViewState& state);
/// Frames everything if nothing is selected.
void frame_selection(ViewState& state);
void look_from(ViewState& state, StandardView side);
/// Places the camera at the first picture of an opened document: the picture's own camera, else one
/// that sees all of it.
void place_camera(ViewState& state);
void toggle_perspective(ViewState& state);
/// Turns the camera about the middle of the shown objects so that z points up instead of y, or y
/// again. Nothing that is shown changes.
void toggle_up(ViewState& state);

}  // namespace lissom::window
