/// The pick of an open boundary by a click in the picture. Drawn by Dear ImGui.
#pragma once

#include <string>
#include <vector>

#include "viewer/window/panel/panel_content.h"

namespace lissom::window {

/// Returns the boundary of `loops` that is seen nearest to a pixel of the picture, or null if none
/// is near.
const PickLoop* loop_near(const std::vector<const PickLoop*>& loops, const Camera& camera,
                          const PictureSize& size, const Vec2& pixel, double reach);

/// Draws the boundaries that `content.picking` is for, with their numbers, and takes a click near
/// one for the value of the parameter. `canvas`: the place of the picture; `scale`: pixels in a
/// unit of length.
void draw_boundary_pick(PanelContent& content, PanelAnswers& answers, const Canvas& canvas,
                        double scale);

}  // namespace lissom::window
