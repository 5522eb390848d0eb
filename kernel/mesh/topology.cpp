#include "kernel/mesh/topology.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "kernel/mesh/half_edges.h"
#include "kernel/mesh/topology_check.h"

namespace lissom {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

namespace {

// Returns the half-edge from `from` to `to` of the next edge, whose ends go behind `edges`.
HalfedgeHandle add_edge(OpenMesh::PolyConnectivity& mesh, std::vector<Index>& edges, Index from,
                        Index to) {
    const HalfedgeHandle halfedge(count_of(edges));
    mesh.set_vertex_handle(halfedge, VertexHandle(to));
    mesh.set_vertex_handle(mesh.opposite_halfedge_handle(halfedge), VertexHandle(from));
    edges.push_back(from);
    edges.push_back(to);
    return halfedge;
}

void link_face(OpenMesh::PolyConnectivity& mesh, FaceHandle face,
               std::span<const HalfedgeHandle> around) {
    mesh.set_halfedge_handle(face, around.front());
    for (std::size_t k = 0; k < around.size(); ++k) {
        mesh.set_next_halfedge_handle(around[k], around[(k + 1) % around.size()]);
    }
}

// Links the half-edges outside the surface, which have no face.
void link_boundary(OpenMesh::PolyConnectivity& mesh, const std::vector<Index>& twin,
                   const std::vector<HalfedgeHandle>& of_corner) {
    std::vector<HalfedgeHandle> outside;
    for (std::size_t c = 0; c < twin.size(); ++c) {
        if (twin[c] == kNoIndex) outside.push_back(mesh.opposite_halfedge_handle(of_corner[c]));
    }
    for (const HalfedgeHandle halfedge : outside) {
        mesh.set_boundary(halfedge);
        mesh.set_halfedge_handle(mesh.from_vertex_handle(halfedge), halfedge);
    }
    // Each vertex now has its outgoing one.
    for (const HalfedgeHandle halfedge : outside) {
        const VertexHandle to = mesh.to_vertex_handle(halfedge);
        mesh.set_next_halfedge_handle(halfedge, mesh.halfedge_handle(to));
    }
}

// Returns the bytes of a topology's lists. OpenMesh keeps one index a vertex and face, and two
// half-edges of four indices an edge.
std::size_t list_bytes(std::size_t vertices, const FaceList& faces, std::size_t edges,
                       std::size_t boundary_edges) {
    const std::size_t corners = faces.vertices.size(), offsets = faces.offsets.size();
    const std::size_t rings = 2 * (vertices + 1) + 2 * edges + corners;
    const std::size_t halfedges = vertices + offsets - 1 + 8 * edges;
    return (offsets + corners + 2 * edges + rings + vertices + boundary_edges + halfedges) *
           sizeof(Index);
}

std::size_t boundary_edges_of(const std::vector<Index>& twin) {
    return static_cast<std::size_t>(std::count(twin.begin(), twin.end(), kNoIndex));
}

}  // namespace

Topology::Topology(MemoryHold hold)
    : hold_(std::move(hold)), halfedges_(std::make_unique<OpenMesh::PolyConnectivity>()) {}

Topology::~Topology() = default;

std::shared_ptr<const Topology> Topology::create(Index vertex_count, FaceList faces,
                                                 const Context& context) {
    // Edges by their vertices, successors in each list, and the corners of fans.
    const MemoryCharge working = context.charge(
        (5 * faces.vertices.size() + 4 * at(std::max<Index>(0, vertex_count))) * sizeof(Index),
        "checking the faces of a mesh");
    const std::vector<Index> twin = check_and_pair_edges(vertex_count, faces, context);
    return create_paired(vertex_count, std::move(faces), twin, context);
}

std::shared_ptr<const Topology> Topology::create_paired(Index vertex_count, FaceList faces,
                                                        const std::vector<Index>& twin,
                                                        const Context& context) {
    const std::size_t boundary_edges = boundary_edges_of(twin);
    MemoryHold hold(context.memory(), "the topology of a mesh");
    hold.resize(
        list_bytes(vertex_count, faces, (twin.size() + boundary_edges) / 2, boundary_edges));
    std::shared_ptr<Topology> topology(new Topology(std::move(hold)));
    topology->vertex_count_ = vertex_count;
    topology->faces_ = std::move(faces);
    topology->build_halfedges(twin);
    context.checkpoint();
    topology->build_rings();
    topology->build_boundary_loops();
    topology->build_components();
    return topology;
}

// The faces were validated, so the half-edges are linked directly instead of by add_face.
void Topology::build_halfedges(const std::vector<Index>& twin) {
    OpenMesh::PolyConnectivity& mesh = *halfedges_;
    boundary_edge_count_ = index_of(boundary_edges_of(twin));
    const auto edge_total = (at(corner_count()) + boundary_edge_count_) / 2;
    mesh.resize(vertex_count_, edge_total, face_count());
    edges_.reserve(2 * edge_total);

    std::vector<HalfedgeHandle> of_corner(corner_count());
    for (Index f = 0; f < face_count(); ++f) {
        const std::span<const Index> face = faces_[f];
        const Index first = first_corner(f);
        triangle_mesh_ = triangle_mesh_ && face.size() == 3;
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index corner = first + index_of(k), other = twin[corner];
            const Index from = face[k], to = face[(k + 1) % face.size()];
            const bool paired = other != kNoIndex && other < corner;
            of_corner[corner] = paired ? mesh.opposite_halfedge_handle(of_corner[other])
                                       : add_edge(mesh, edges_, from, to);
            mesh.set_face_handle(of_corner[corner], FaceHandle(f));
            // A boundary vertex keeps its outgoing boundary halfedge, as OpenMesh expects.
            if (!mesh.halfedge_handle(VertexHandle(from)).is_valid()) {
                mesh.set_halfedge_handle(VertexHandle(from), of_corner[corner]);
            }
        }
        link_face(mesh, FaceHandle(f), std::span(of_corner).subspan(first, face.size()));
    }
    if (boundary_edge_count_ > 0) link_boundary(mesh, twin, of_corner);
}

void Topology::build_rings() {
    const OpenMesh::PolyConnectivity& mesh = *halfedges_;
    ring_begin_.reserve(at(vertex_count_) + 1);
    fan_begin_.reserve(at(vertex_count_) + 1);
    ring_.reserve(edges_.size());
    fan_.reserve(corner_count());
    ring_begin_.push_back(0);
    fan_begin_.push_back(0);
    for (Index v = 0; v < vertex_count_; ++v) {
        const HalfedgeHandle stored = mesh.halfedge_handle(VertexHandle(v));
        if (stored.is_valid()) {
            // Counter-clockwise, starting after the outer sector of a boundary vertex.
            const HalfedgeHandle start =
                mesh.is_boundary(stored)
                    ? mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(stored))
                    : stored;
            HalfedgeHandle halfedge = start;
            do {
                ring_.push_back(mesh.to_vertex_handle(halfedge).idx());
                if (!mesh.is_boundary(halfedge)) fan_.push_back(mesh.face_handle(halfedge).idx());
                halfedge = mesh.ccw_rotated_halfedge_handle(halfedge);
            } while (halfedge != start);
        }
        ring_begin_.push_back(count_of(ring_));
        fan_begin_.push_back(count_of(fan_));
    }
}

void Topology::build_boundary_loops() {
    const OpenMesh::PolyConnectivity& mesh = *halfedges_;
    std::vector<char> seen(vertex_count_, 0);
    for (Index v = 0; v < vertex_count_; ++v) {
        if (seen[v] || !is_boundary(v)) continue;
        // The stored halfedge runs outside, against the faces; walking back gives the faces'
        // direction.
        std::vector<Index> loop;
        const HalfedgeHandle start = mesh.halfedge_handle(VertexHandle(v));
        HalfedgeHandle halfedge = start;
        do {
            const Index at = mesh.from_vertex_handle(halfedge).idx();
            loop.push_back(at);
            seen[at] = 1;
            halfedge = mesh.prev_halfedge_handle(halfedge);
        } while (halfedge != start);
        boundary_loops_.push_back(std::move(loop));
    }
}

void Topology::build_components() {
    // Each vertex points to itself or to a smaller one of its component.
    components_.resize(vertex_count_);
    std::iota(components_.begin(), components_.end(), 0);
    const auto root = [&](Index v) {
        while (components_[v] != v) v = components_[v] = components_[components_[v]];
        return v;
    };
    for (std::size_t e = 0; e < edges_.size(); e += 2) {
        const Index a = root(edges_[e]), b = root(edges_[e + 1]);
        components_[std::max(a, b)] = std::min(a, b);
    }
    for (Index v = 0; v < vertex_count_; ++v) {
        const Index parent = components_[v];
        components_[v] = parent == v ? component_count_++ : components_[parent];
    }
}

std::size_t Topology::memory_bytes() const {
    return list_bytes(vertex_count_, faces_, edge_count(), boundary_edge_count_);
}

namespace {

void require_ids(ElementKind kind, std::span<const Index> ids, Index count, const char* plural) {
    Elements bad{kind, 0, {}};
    for (const Index id : ids) {
        if (id < 0 || id >= count) bad.add(id);
    }
    if (bad.count == 0) return;
    const std::string names = describe(bad);
    throw Error(ErrorCode::out_of_range,
                "the mesh has " + std::to_string(count) + " " + plural + ", among them no " + names,
                std::move(bad));
}

}  // namespace

void require_vertices(const Topology& topology, std::span<const Index> vertices) {
    require_ids(ElementKind::vertex, vertices, topology.vertex_count(), "vertices");
}

void require_faces(const Topology& topology, std::span<const Index> faces) {
    require_ids(ElementKind::face, faces, topology.face_count(), "faces");
}

}  // namespace lissom
