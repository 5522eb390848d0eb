#include "kernel/mesh/edges.h"

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

namespace lissom {

Index find_edge(const Topology& topology, Index a, Index b) {
    const auto& mesh = topology.halfedges();
    const auto halfedge = mesh.find_halfedge(OpenMesh::VertexHandle(a), OpenMesh::VertexHandle(b));
    return halfedge.is_valid() ? halfedge.idx() / 2 : kNoIndex;
}

std::pair<Index, Index> faces_at_edge(const Topology& topology, Index e) {
    const auto& mesh = topology.halfedges();
    const auto face_at = [&](Index halfedge) {
        const auto face = mesh.face_handle(OpenMesh::HalfedgeHandle(halfedge));
        return face.is_valid() ? face.idx() : kNoIndex;
    };
    return {face_at(2 * e), face_at(2 * e + 1)};
}

}  // namespace lissom
