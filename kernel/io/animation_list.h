/// Animations of the glTF file that a mesh came from.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kernel/mesh/mesh.h"

namespace lissom {

struct AnimationInfo {
    /// Empty if the file gives none.
    std::string name;
    /// Time of the last key.
    double seconds = 0.0;
    /// Keys of the channel that has most.
    std::size_t frames = 0;
};

/// Returns the animations that are saved with the mesh, in the order of the file; none for other
/// formats.
std::vector<AnimationInfo> animations_of(const Mesh& mesh);

}  // namespace lissom
