/// PickChoices: names that a person may pick for parameters that are meshes and parts of them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/core/script_parameters.h"
#include "kernel/core/geometry.h"
#include "viewer/window/session/session_news.h"
#include "viewer/window/tools/tool_state.h"

namespace lissom::window {

/// An open boundary in the world.
struct PickLoop {
    /// Its number, from 1, in the order of mesh:boundaries().
    std::string value;
    std::vector<Vec3> points;
};

/// A mesh that is seen.
struct PickMesh {
    /// "" for a mesh that no scene names.
    std::string name;
    /// Hair grows on it, or it has a scalp for that.
    bool is_head = false;
    std::vector<std::string> regions = {};
    std::vector<PickLoop> boundaries = {};
};

struct PickChoices {
    std::vector<PickMesh> meshes;
    /// Names of the curves of the scene.
    std::vector<std::string> curves;
};

/// A parameter whose boundary the next click in the picture picks.
struct Picking {
    /// One of the tool in hand, or of the script.
    bool of_tool = false;
    std::string parameter;

    bool operator==(const Picking&) const = default;
};

/// Returns whether a person picks the values of a type.
bool is_picked(lua::ParameterType type);

/// Returns the choices in the shown picture of a scene; only names of `scene` are those of a mesh.
PickChoices pick_choices_of(const Shown& shown, const ToolState& scene);

/// Returns the meshes that a parameter may lie on: the one that its `of` names, or all that are
/// seen if none has that name.
std::vector<const PickMesh*> meshes_of(const lua::ScriptParameter& parameter,
                                       const std::vector<lua::ScriptParameter>& all,
                                       const PickChoices& choices);

/// Returns the values that a person may pick for a parameter, each once.
std::vector<std::string> picks_for(const lua::ScriptParameter& parameter,
                                   const std::vector<lua::ScriptParameter>& all,
                                   const PickChoices& choices);

}  // namespace lissom::window
