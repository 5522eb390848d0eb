#include "kernel/mesh/region.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

namespace lissom {
namespace {

void require_common_topology(const Region& a, const Region& b) {
    if (a.topology() == b.topology()) return;
    throw Error(ErrorCode::topology_mismatch,
                "the two regions belong to different meshes or to different versions of one mesh's "
                "topology; make both on the mesh as it is now");
}

std::vector<Index> selected(const std::vector<char>& mask) {
    std::vector<Index> vertices;
    for (std::size_t v = 0; v < mask.size(); ++v) {
        if (mask[v]) vertices.push_back(static_cast<Index>(v));
    }
    return vertices;
}

}  // namespace

Region::Region(std::shared_ptr<const Topology> topology, std::vector<Index> vertices)
    : topology_(std::move(topology)), vertices_(std::move(vertices)) {
    Elements bad{ElementKind::vertex, 0, {}};
    for (const Index v : vertices_) {
        if (v < 0 || v >= topology_->vertex_count()) bad.add(v);
    }
    if (bad.count > 0) {
        const std::string names = describe(bad);
        throw Error(ErrorCode::out_of_range,
                    names + " do not exist; the mesh has " +
                        std::to_string(topology_->vertex_count()) + " vertices",
                    std::move(bad));
    }
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
}

Region Region::all(std::shared_ptr<const Topology> topology) {
    std::vector<Index> vertices(static_cast<std::size_t>(topology->vertex_count()));
    std::iota(vertices.begin(), vertices.end(), 0);
    return {std::move(topology), std::move(vertices)};
}

Region Region::none(std::shared_ptr<const Topology> topology) { return {std::move(topology), {}}; }

bool Region::contains(Index v) const {
    return std::binary_search(vertices_.begin(), vertices_.end(), v);
}

std::vector<char> Region::mask() const {
    std::vector<char> mask(static_cast<std::size_t>(topology_->vertex_count()), 0);
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

Region Region::inverted() const { return all(topology_).minus(*this); }

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

Region Region::shrunk(Index rings) const { return inverted().grown(rings).inverted(); }

}  // namespace lissom
