/// Source elements of a mesh that was made from another.
#pragma once

#include <vector>

#include "kernel/core/index.h"

namespace lissom {

/// Source element of each vertex and face of a mesh made from another: several faces
/// share one that was divided. kNoIndex for a new element, which follows the rest of its
/// side.
struct Places {
    std::vector<Index> vertices, faces;
};

}  // namespace lissom
