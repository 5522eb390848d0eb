/// The marks of a tool, as its view has read them from a script, for the picture and the panel.
#pragma once

#include "bindings/lua/tools/tool_view.h"
#include "viewer/window/tools/tool_state.h"

namespace lissom::window {

/// Returns the marks in the world, which are part of the picture.
Overlay overlay_of(const lua::ToolViewObject& view);
/// Returns the marks over the picture.
ToolMarks marks_of(const lua::ToolViewObject& view);
/// Colours the regions that the tool has marked, and the selected ones, of the meshes of `picture`.
void paint_regions(const lua::ToolViewObject& view, Picture& picture);
/// Adds the meshes that the tool shows though they are not in the scene.
void add_meshes(const lua::ToolViewObject& view, Picture& picture);

}  // namespace lissom::window
