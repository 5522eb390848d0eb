#include "kernel/mesh/edges.h"

#include "kernel/mesh/half_edges.h"

namespace lissom {

using OpenMesh::HalfedgeHandle;

Index find_edge(const Topology& topology, Index a, Index b) {
    const auto& mesh = topology.halfedges();
    const HalfedgeHandle first = mesh.halfedge_handle(OpenMesh::VertexHandle(a));
    if (!first.is_valid()) return kNoIndex;
    HalfedgeHandle halfedge = first;
    do {
        if (mesh.to_vertex_handle(halfedge).idx() == b) return halfedge.idx() / 2;
        halfedge = mesh.ccw_rotated_halfedge_handle(halfedge);
    } while (halfedge != first);
    return kNoIndex;
}

std::pair<Index, Index> faces_at_edge(const Topology& topology, Index e) {
    const auto& mesh = topology.halfedges();
    const auto face_at = [&](Index halfedge) {
        const auto face = mesh.face_handle(HalfedgeHandle(halfedge));
        return face.is_valid() ? face.idx() : kNoIndex;
    };
    return {face_at(2 * e), face_at(2 * e + 1)};
}

}  // namespace lissom
