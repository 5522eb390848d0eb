/// State of a scene and the tool in hand, for the panel.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/core/script_parameters.h"
#include "viewer/render/picture.h"
#include "viewer/window/tools/tool_input.h"

namespace lissom::window {

/// Text at a point of the world.
struct ToolLabel {
    Vec3 at = Vec3::Zero();
    std::string text;
    Color color;

    bool operator==(const ToolLabel&) const = default;
};

/// A line in the picture, in pixels from its top left corner.
struct ToolOutline {
    std::vector<Vec2> pixels;
    bool closed = false;
    Color color;
    double width = 1.5;
    /// 0 for nothing to 1.
    double opacity = 1.0;

    bool operator==(const ToolOutline&) const = default;
};

/// A surface between two lines of the world, as many points each, that is seen through.
struct ToolSurface {
    std::vector<Vec3> from, to;
    Color color;
    double opacity = 0.25;

    bool operator==(const ToolSurface&) const = default;
};

/// Marks of a tool that are no part of the scene.
struct ToolMarks {
    std::vector<ToolLabel> labels;
    std::vector<ToolOutline> outlines;
    std::vector<ToolSurface> surfaces;

    bool operator==(const ToolMarks&) const = default;
};

/// An object of the scene.
struct ToolObject {
    std::string name;
    /// With the number of faces of a mesh.
    std::string label;
    bool visible = true;
    bool is_curve = false;

    bool operator==(const ToolObject&) const = default;
};

/// The hand of a played recording: its view, and its place.
struct PlayedHand {
    Camera camera;
    gl::Extent size;
    /// In pixels of a picture of that size.
    Vec2 at = Vec2::Zero();
    bool is_down = false;
};

/// State of the scene and the tool for the panel.
struct ToolState {
    bool has_scene = false;
    /// Another number: another scene.
    std::uint64_t scene = 0;
    /// Camera of the scene, if the tool has set it since the last state.
    std::optional<Camera> camera;
    /// Likewise of a scene that was saved: the axis that points up in it.
    std::optional<ViewUp> up = std::nullopt;
    /// Objects that can be shown by themselves, in the order of the scene.
    std::vector<ToolObject> objects;
    /// Name of the tool in hand, and the word that it was taken by; empty for none.
    std::string tool, word;
    /// The tool wants to know how time goes by in a gesture.
    bool ticks = false;
    /// Question of the tool, or its help.
    std::string prompt;
    std::vector<lua::ScriptParameter> parameters;
    /// Names of the steps, oldest first; the first `place` can be undone.
    std::vector<std::string> steps;
    std::size_t place = 0;
    /// In the world, part of the picture.
    Overlay overlay;
    ToolMarks marks;
    /// While a recording is played.
    std::optional<PlayedHand> hand;

    /// Whether the same is seen; values of parameters are not looked at.
    bool operator==(const ToolState& other) const;
};

}  // namespace lissom::window
