/// Font, sizes and colours of the panel, in the current context of Dear ImGui.
#pragma once

#include "viewer/window/session/session_news.h"

namespace lissom::window {

/// Loads the font of the desktop, or ImGui's own, for `scale` pixels in a unit of length.
void load_font(double scale);
void set_sizes(double scale);
void set_colors(bool dark);
/// Draws text in the colour of a line of the console until ImGui::PopStyleColor.
void push_line_color(LineKind kind, bool dark);

}  // namespace lissom::window
