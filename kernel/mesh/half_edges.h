/// OpenMesh's half-edge structure, of its headers alone. The few functions that they leave to its
/// library are here: no library to load, and none to build for another platform. They are inline,
/// so that a host may link OpenMesh too. Private to kernel/mesh.
#pragma once

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>
#include <cstddef>
#include <ostream>

namespace OpenMesh {

// Functions called by assertions of its headers.
inline bool ArrayKernel::is_valid_handle(VertexHandle v) const {
    return v.idx() >= 0 && static_cast<std::size_t>(v.idx()) < n_vertices();
}
inline bool ArrayKernel::is_valid_handle(HalfedgeHandle h) const {
    return h.idx() >= 0 && static_cast<std::size_t>(h.idx()) < n_halfedges();
}
inline bool ArrayKernel::is_valid_handle(EdgeHandle e) const {
    return e.idx() >= 0 && static_cast<std::size_t>(e.idx()) < n_edges();
}
inline bool ArrayKernel::is_valid_handle(FaceHandle f) const {
    return f.idx() >= 0 && static_cast<std::size_t>(f.idx()) < n_faces();
}

// Defining this one defines the type of properties too, for queries of it at run time.
inline void BaseProperty::stats(std::ostream& out) const {
    out << name() << '\n';
}

inline void ArrayKernel::init_bit_masks(BitMaskContainer& masks) {
    for (unsigned int bit = Attributes::UNUSED; bit != 0; bit <<= 1) masks.push_back(bit);
}

inline void ArrayKernel::init_bit_masks() {
    for (auto* masks :
         {&vertex_bit_masks_, &halfedge_bit_masks_, &edge_bit_masks_, &face_bit_masks_}) {
        init_bit_masks(*masks);
    }
}

inline ArrayKernel::ArrayKernel()
    : refcount_vstatus_(0), refcount_hstatus_(0), refcount_estatus_(0), refcount_fstatus_(0) {
    init_bit_masks();
}

inline ArrayKernel::~ArrayKernel() = default;

inline void ArrayKernel::resize(std::size_t vertices, std::size_t edges, std::size_t faces) {
    vertices_.resize(vertices);
    edges_.resize(edges);
    faces_.resize(faces);
    vprops_resize(n_vertices());
    hprops_resize(n_halfedges());
    eprops_resize(n_edges());
    fprops_resize(n_faces());
}

}  // namespace OpenMesh
