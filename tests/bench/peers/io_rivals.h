/// The readers of other libraries, for comparison with ours. Each returns the number of triangles
/// read, 0 where it failed.
#pragma once

#include <cstddef>
#include <filesystem>

namespace lissom::bench {

/// OpenMesh's reader of the file's format, into a triangle mesh with half-edges.
std::size_t read_with_openmesh(const std::filesystem::path& path);

/// tinygltf: parses a GLB and keeps its buffers; nothing is made of them.
std::size_t read_with_tinygltf(const std::filesystem::path& path);

/// The same, and then adds all triangles to a mesh of OpenMesh, which makes half-edges of them.
std::size_t read_with_tinygltf_into_openmesh(const std::filesystem::path& path);

}  // namespace lissom::bench
