#include "kernel/mesh/soup.h"

namespace lissom {

std::size_t Soup::memory_bytes() const {
    std::size_t bytes = positions.size() * sizeof(Vec3) + attributes.memory_bytes();
    bytes += same_as.size() * sizeof(Index);
    bytes += (faces.offsets.size() + faces.vertices.size()) * sizeof(Index);
    for (const auto& [name, vertices] : regions) bytes += vertices.size() * sizeof(Index);
    return bytes;
}

}  // namespace lissom
