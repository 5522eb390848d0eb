#include "kernel/mesh/edges.h"

#include <algorithm>
#include <span>

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

Index face_left_of(const Topology& topology, Index from, Index to) {
    const auto place_of = [](std::span<const Index> ring, Index v) {
        return std::find(ring.begin(), ring.end(), v) - ring.begin();
    };
    // The i-th face around a vertex lies between its neighbours i and i + 1.
    if (topology.valence(from) <= topology.valence(to)) {
        const auto faces = topology.faces_around(from);
        const auto i = at(place_of(topology.neighbors(from), to));
        return i < faces.size() ? faces[i] : kNoIndex;
    }
    const auto faces = topology.faces_around(to);
    const auto i = place_of(topology.neighbors(to), from);
    if (i == topology.valence(to)) return kNoIndex;
    if (i > 0) return faces[at(i - 1)];
    return topology.is_boundary(to) ? kNoIndex : faces.back();
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
