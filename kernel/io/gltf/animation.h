/// Adds an animation of morph targets to the document of a glTF asset; private to kernel/io and not
/// installed.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/io/gltf/asset.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// One key after another: its time in seconds, and a weight of each morph target.
struct MorphKeys {
    std::string name;
    bool is_stepped = false;
    std::vector<float> times, weights;
    Index target_count = 0;
};

/// Returns the nodes of the objects that have a vertex with a flag; nodes are added to `asset` for
/// objects that have none.
std::vector<std::size_t> nodes_of_objects(const Mesh& mesh, const std::vector<char>& flags,
                                          GltfAsset& asset);

/// Returns the asset of `mesh`, or a new one, without its animations of morph targets and with this
/// one: it moves every object that has a vertex with a flag in `moves`. Nodes are added for objects
/// that have none.
std::shared_ptr<const GltfAsset> with_morph_animation(const Mesh& mesh,
                                                      const std::vector<char>& moves,
                                                      const MorphKeys& keys);

}  // namespace lissom
