#include "kernel/mesh/region.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "kernel/mesh/half_edges.h"
#include "kernel/mesh/region_bytes.h"

namespace lissom {
namespace {

using OpenMesh::HalfedgeHandle;

void require_common_topology(const Region& a, const Region& b) {
    if (a.topology() == b.topology()) return;
    throw Error(ErrorCode::topology_mismatch,
                "the two regions belong to different meshes or to different versions of one mesh's "
                "topology; make both on the mesh as it is now");
}

std::vector<Index> selected(const std::vector<char>& mask) {
    std::vector<Index> vertices;
    for (std::size_t v = 0; v < mask.size(); ++v) {
        if (mask[v]) vertices.push_back(index_of(v));
    }
    return vertices;
}

// One step of a majority vote: each vertex goes with most of its neighbours and stays at a draw.
std::vector<char> majority(const Topology& topology, const std::vector<char>& in) {
    std::vector<char> next = in;
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        const std::span<const Index> ring = topology.neighbors(v);
        const auto votes =
            std::count_if(ring.begin(), ring.end(), [&](Index n) { return in[n] != 0; });
        const auto against = std::ssize(ring) - votes;
        if (votes != against) next[v] = votes > against;
    }
    return next;
}

// The directed edges around a set of faces, joined to loops. If the faces touch at a vertex only,
// the loop stays with the fan that it came from.
class FaceOutline {
  public:
    FaceOutline(const Topology& topology, const std::vector<char>& in)
        : mesh_(topology.halfedges()), in_(in) {}

    std::vector<std::vector<Index>> loops() const {
        std::vector<char> seen(mesh_.n_halfedges(), 0);
        std::vector<std::vector<Index>> loops;
        for (std::size_t h = 0; h < mesh_.n_halfedges(); ++h) {
            const HalfedgeHandle start(index_of(h));
            if (seen[h] || !on_outline(start)) continue;
            std::vector<Index> loop;
            for (HalfedgeHandle at = start; !seen[at.idx()]; at = next(at)) {
                seen[at.idx()] = 1;
                loop.push_back(mesh_.from_vertex_handle(at).idx());
            }
            std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
            loops.push_back(std::move(loop));
        }
        std::sort(loops.begin(), loops.end());
        return loops;
    }

  private:
    bool inside(HalfedgeHandle h) const {
        const OpenMesh::FaceHandle face = mesh_.face_handle(h);
        return face.is_valid() && in_[face.idx()];
    }
    bool on_outline(HalfedgeHandle h) const {
        return inside(h) && !inside(mesh_.opposite_halfedge_handle(h));
    }
    HalfedgeHandle next(HalfedgeHandle h) const {
        h = mesh_.next_halfedge_handle(h);
        while (!on_outline(h)) h = mesh_.next_halfedge_handle(mesh_.opposite_halfedge_handle(h));
        return h;
    }

    const OpenMesh::PolyConnectivity& mesh_;
    const std::vector<char>& in_;
};

}  // namespace

Region::Region(std::shared_ptr<const Topology> topology, std::vector<Index> vertices)
    : topology_(std::move(topology)),
      hold_(topology_->account(), "a region"),
      vertices_(std::move(vertices)) {
    require_vertices(*topology_, vertices_);
    if (!std::is_sorted(vertices_.begin(), vertices_.end())) {
        std::sort(vertices_.begin(), vertices_.end());
    }
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    hold_.resize(kRegionBytes + vertices_.size() * sizeof(Index));
}

Region Region::all(std::shared_ptr<const Topology> topology) {
    std::vector<Index> vertices(topology->vertex_count());
    std::iota(vertices.begin(), vertices.end(), 0);
    return {std::move(topology), std::move(vertices)};
}

Region Region::none(std::shared_ptr<const Topology> topology) {
    return {std::move(topology), {}};
}

bool Region::contains(Index v) const {
    return std::binary_search(vertices_.begin(), vertices_.end(), v);
}

std::vector<char> Region::mask() const {
    std::vector<char> mask(topology_->vertex_count(), 0);
    for (const Index v : vertices_) mask[v] = 1;
    return mask;
}

Region Region::united(const Region& other) const {
    require_common_topology(*this, other);
    std::vector<Index> result;
    std::set_union(vertices_.begin(), vertices_.end(), other.vertices_.begin(),
                   other.vertices_.end(), std::back_inserter(result));
    return {topology_, std::move(result)};
}

Region Region::minus(const Region& other) const {
    require_common_topology(*this, other);
    std::vector<Index> result;
    std::set_difference(vertices_.begin(), vertices_.end(), other.vertices_.begin(),
                        other.vertices_.end(), std::back_inserter(result));
    return {topology_, std::move(result)};
}

Region Region::intersected(const Region& other) const {
    require_common_topology(*this, other);
    std::vector<Index> result;
    std::set_intersection(vertices_.begin(), vertices_.end(), other.vertices_.begin(),
                          other.vertices_.end(), std::back_inserter(result));
    return {topology_, std::move(result)};
}

Region Region::inverted() const {
    return all(topology_).minus(*this);
}

Region Region::grown(Index rings) const {
    if (rings < 0) throw Error(ErrorCode::invalid_argument, "rings must not be negative");
    std::vector<char> in = mask();
    std::vector<Index> front = vertices_;
    for (Index ring = 0; ring < rings && !front.empty(); ++ring) {
        std::vector<Index> next;
        for (const Index v : front) {
            for (const Index n : topology_->neighbors(v)) {
                if (in[n]) continue;
                in[n] = 1;
                next.push_back(n);
            }
        }
        front = std::move(next);
    }
    return {topology_, selected(in)};
}

Region Region::shrunk(Index rings) const {
    return inverted().grown(rings).inverted();
}

Region Region::smoothed(Index iterations) const {
    if (iterations < 0) throw Error(ErrorCode::invalid_argument, "iterations must not be negative");
    std::vector<char> in = mask(), before;
    for (Index i = 0; i < iterations; ++i) {
        std::vector<char> next = majority(*topology_, in);
        const bool emptied = std::find(next.begin(), next.end(), 1) == next.end();
        if (next == in || emptied) break;
        // Votes that have swung back to an outline alternate endlessly.
        if (next == before && (iterations - i) % 2 == 0) break;
        const bool swings = next == before;
        before = std::exchange(in, std::move(next));
        if (swings) break;
    }
    return {topology_, selected(in)};
}

std::vector<Index> Region::faces() const {
    const std::vector<char> in = mask();
    std::vector<Index> faces;
    for (Index f = 0; f < topology_->face_count(); ++f) {
        const std::span<const Index> face = topology_->face(f);
        if (std::all_of(face.begin(), face.end(), [&](Index v) { return in[v] != 0; }))
            faces.push_back(f);
    }
    return faces;
}

std::vector<std::vector<Index>> Region::boundaries() const {
    std::vector<char> in(topology_->face_count(), 0);
    for (const Index f : faces()) in[f] = 1;
    return FaceOutline(*topology_, in).loops();
}

}  // namespace lissom
