/// Moves of the window's camera that are no drag: to sides, and to see all or what is selected.
#pragma once

#include "viewer/window/app/view_state.h"

namespace lissom::window {

/// Each does nothing where nothing is shown.
void frame_all(ViewState& state);
/// All where nothing is selected.
void frame_selection(ViewState& state);
void look_from(ViewState& state, StandardView side);
/// What is shown is the first of what is open: the camera that its picture has, else one that sees
/// all of it.
void place_camera(ViewState& state);
void toggle_perspective(ViewState& state);
/// Turns the camera about the middle of what is shown so that z points up instead of y, or y again.
/// Nothing that is shown changes.
void toggle_up(ViewState& state);

}  // namespace lissom::window
