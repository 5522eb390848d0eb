/// The lights of all pictures, fixed to the camera: those of the surface shader (shaders.cpp), for
/// shading without OpenGL. View space: x right, y up, z towards the viewer.
#pragma once

#include <Eigen/Core>

#include "kernel/core/geometry.h"

namespace lissom {

/// A distant light.
struct StudioLight {
    /// Towards the light; not of unit length.
    Eigen::Vector3f direction;
    /// Linear.
    Eigen::Array3f color;
};

inline const StudioLight kKeyLight{{-0.62f, 0.62f, 0.48f}, {1.10f, 1.08f, 1.04f}};
inline const StudioLight kFillLight{{0.80f, 0.05f, 0.55f}, {0.13f, 0.14f, 0.16f}};
inline const StudioLight kRimLight{{0.45f, 0.45f, -0.55f}, {0.22f, 0.235f, 0.25f}};
/// Light from above and from below, around everything.
inline const Eigen::Array3f kSkyLight{0.32f, 0.33f, 0.35f};
inline const Eigen::Array3f kGroundLight{0.105f, 0.095f, 0.09f};

}  // namespace lissom
