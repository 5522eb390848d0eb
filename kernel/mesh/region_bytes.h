/// The memory of a region without its vertices; private to kernel/mesh.
#pragma once

#include <cstddef>

namespace lissom {

/// Bytes of the object, and of its entry among the named regions of a mesh.
inline constexpr std::size_t kRegionBytes = 160;

}  // namespace lissom
