/// Which elements of a mesh stand in the place of which of another.
#pragma once

#include <vector>

#include "kernel/core/index.h"

namespace lissom {

/// For each vertex and face of a mesh that was made of another the one in whose place it stands:
/// several faces do where one was divided. kNoIndex for what was made anew, which follows the rest
/// of its side.
struct Places {
    std::vector<Index> vertices, faces;
};

}  // namespace lissom
