/// Surroundings of hair in a scene for RenderMan.
#pragma once

#include <optional>
#include <string>

#include "kernel/core/geometry.h"
#include "kernel/mesh/mesh.h"
#include "kernel/sketch/camera.h"

namespace lissom {

/// Contents of a .rib file besides the hair: a RenderMan renderer makes the picture from it alone,
/// with the shaders and lights that all of them have.
struct RibScene {
    /// The curves alone, for another RIB file to read; the fields below are not used.
    bool archive = false;
    /// Drawn below the hair; null for none.
    const Mesh* head = nullptr;
    /// Metres in one unit of head and camera; absent: by the roots of the strands on the head, else
    /// 1.
    std::optional<double> unit = std::nullopt;
    /// Absent: head and hair whole, from the front, a little aside and above.
    std::optional<CameraOptions> camera = std::nullopt;
    /// Size of the picture, in pixels.
    Index width = 800, height = 800;
    /// The file that the renderer writes; empty: named after the .rib file.
    std::string picture = {};
};

}  // namespace lissom
