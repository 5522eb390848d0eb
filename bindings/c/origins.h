/// Origins of the elements of a merged mesh, kept beside its handle; private to bindings/c.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/topology.h"

namespace lissom::c {

/// The input and the element of each element; -1 in both for new ones.
struct OriginList {
    std::vector<Index> input, element;
};

struct Origins {
    std::weak_ptr<const Topology> topology;
    OriginList vertices, faces;
};

/// Numbers of elements of the inputs in order.
struct InputCounts {
    std::vector<Index> vertices, faces;

    void add(const Mesh& mesh) {
        vertices.push_back(mesh.vertex_count());
        faces.push_back(mesh.face_count());
    }
};

/// Returns the origins of `mesh` by a map to the elements of all inputs, one behind the other.
std::shared_ptr<Origins> origins_of(const Mesh& mesh, const MeshMap& map,
                                    const InputCounts& counts);

}  // namespace lissom::c
