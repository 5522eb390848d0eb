#include "kernel/mesh/edit/corner_twins.h"

#include "kernel/mesh/half_edges.h"

namespace lissom {

std::vector<Index> corner_twins(const Topology& topology) {
    const OpenMesh::PolyConnectivity& mesh = topology.halfedges();
    std::vector<Index> halfedge_of(at(topology.corner_count()));
    std::vector<Index> corner_of(2 * at(topology.edge_count()), kNoIndex);
    for (Index f = 0; f < topology.face_count(); ++f) {
        OpenMesh::HalfedgeHandle halfedge = mesh.halfedge_handle(OpenMesh::FaceHandle(f));
        for (Index c = topology.first_corner(f); c < topology.first_corner(f + 1); ++c) {
            halfedge_of[at(c)] = halfedge.idx();
            corner_of[at(halfedge.idx())] = c;
            halfedge = mesh.next_halfedge_handle(halfedge);
        }
    }
    // The two halfedges of an edge have numbers that differ in the last bit.
    for (Index& twin : halfedge_of) twin = corner_of[at(twin ^ 1)];
    return halfedge_of;
}

}  // namespace lissom
