/// Whether meshes have the same faces; private to the kernel.
#pragma once

#include "kernel/mesh/mesh.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Returns whether the vertices and faces of two meshes have the same numbers.
inline bool have_same_faces(const Mesh& one, const Mesh& other) {
    const Topology &a = one.topology(), &b = other.topology();
    return &a == &b ||
           (a.vertex_count() == b.vertex_count() && a.faces().offsets == b.faces().offsets &&
            a.faces().vertices == b.faces().vertices);
}

}  // namespace lissom
