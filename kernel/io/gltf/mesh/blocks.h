/// Blocks of vertices that primitives of a mesh share; private to kernel/io and not installed.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/io/gltf/file/tiny_gltf.h"

namespace lissom {

/// Primitives of one mesh that have their vertices in common.
struct VertexBlock {
    /// Accessors by name, of all primitives together.
    std::map<std::string, int> attributes;
    std::vector<std::map<std::string, int>> targets;
    std::vector<const tinygltf::Primitive*> primitives;
    /// For each of them, the vertices at its corners; empty if there is only one.
    std::vector<std::vector<Index>> corners;
    std::size_t vertex_count = 0;
};

/// Groups primitives, which all have positions. Those of a block use the same accessors, though
/// some may lack an attribute.
std::vector<VertexBlock> blocks_of(const std::vector<const tinygltf::Primitive*>& primitives);

}  // namespace lissom
