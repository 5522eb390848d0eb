/// The gizmo of a script.
#pragma once

#include <optional>

#include "bindings/lua/core/call.h"
#include "kernel/sketch/gizmo_drag.h"

namespace lissom::lua {

struct GizmoObject {
    static constexpr const char* kTypeName = "lissom.Gizmo";

    Gizmo gizmo;
    GizmoSteps steps;
    std::optional<GizmoDrag> drag;

    /// Returns the gizmo at its present place.
    Gizmo shown() const { return drag ? drag->moved() : gizmo; }
};

}  // namespace lissom::lua
