/// Adds a skin and an animation of its joints to the document of a glTF asset; private to kernel/io
/// and not installed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/io/gltf/asset.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Joints, and their motions at times in seconds; without times they stay.
struct SkinKeys {
    std::string name;
    /// Place of each joint at rest.
    std::vector<Vec3> centers;
    std::vector<float> times;
    /// Rigid: motions[time][joint].
    std::vector<std::vector<Affine>> motions;
};

/// Returns the asset of `mesh`, or a new one, in which every object has the skin: joints are nodes
/// below one new node. Nodes are added for objects that have none.
std::shared_ptr<const GltfAsset> with_skin(const Mesh& mesh, const SkinKeys& keys);

}  // namespace lissom
