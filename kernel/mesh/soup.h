/// Soup: polygons as they come from a file or a script. Nothing is promised of them: vertices may
/// coincide, faces may repeat, cross or run either way. `repair` (repair.h) makes a Mesh of it.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/topology.h"

namespace lissom {

struct Soup {
    std::vector<Vec3> positions;
    FaceList faces;
    /// Values and labels of the vertices, corners and faces above.
    AttributeSet attributes;
    /// For each vertex its identical vertex, itself for most, if the file gives it: a vertex that
    /// was stored several times with different values. Empty if it says nothing.
    std::vector<Index> same_as;
    /// Named sets of vertices.
    std::map<std::string, std::vector<Index>, std::less<>> regions;

    std::size_t memory_bytes() const;
};

}  // namespace lissom
