#include "kernel/deform/frame/moving_surface.h"

#include <algorithm>
#include <utility>

namespace lissom {
namespace {

Mesh mesh_at_rest(const RestShape& rest) {
    const auto& topology = rest.region().topology();
    std::vector<Vec3> positions = rest.beyond;
    positions.resize(at(topology->vertex_count()), Vec3::Zero());
    for (const auto& [v, p] : rest.surroundings) positions[at(v)] = p;
    for (Index row = 0; row < rest.region().size(); ++row) {
        positions[at(rest.region().vertices()[at(row)])] = rest.positions[at(row)];
    }
    return {std::move(positions), topology};
}

std::vector<Index> moving_vertices(const Preparation& prepared) {
    const Patch& patch = prepared.patch();
    std::vector<char> moves(at(patch.real_count), 0);
    for (const Index v : patch.of_region) moves[at(v)] = prepared.known.position[at(v)] == 0;
    for (const FollowingPart& part : prepared.following) {
        for (const Index v : part.members) {
            if (v < patch.real_count) moves[at(v)] = 1;
        }
    }
    std::vector<Index> vertices;
    for (const Index v : patch.of_region) {
        if (moves[at(v)]) vertices.push_back(patch.mesh_vertex[at(v)]);
    }
    return vertices;
}

std::vector<Index> faces_at(const Topology& topology, const std::vector<Index>& vertices) {
    std::vector<char> seen(at(topology.face_count()), 0);
    for (const Index v : vertices) {
        for (const Index f : topology.faces_around(v)) seen[at(f)] = 1;
    }
    std::vector<Index> faces;
    for (Index f = 0; f < topology.face_count(); ++f) {
        if (seen[at(f)]) faces.push_back(f);
    }
    return faces;
}

}  // namespace

MovingSurface::MovingSurface(const Preparation& prepared, const Context& context)
    : region_(prepared.rest->region().vertices()),
      moving_(moving_vertices(prepared)),
      rest_(mesh_at_rest(*prepared.rest)),
      search_(rest_.shared_topology(), {faces_at(rest_.topology(), moving_)}, context),
      crossings_(search_.find(rest_.positions(), context)),
      closeness_(rest_, moving_) {}

void MovingSurface::place(std::span<const Vec3> positions, std::vector<Vec3>& shape) const {
    shape.assign(rest_.positions().begin(), rest_.positions().end());
    bool is_finite = true;
    for (std::size_t row = 0; row < region_.size(); ++row) {
        shape[at(region_[row])] = positions[row];
        is_finite = is_finite && positions[row].allFinite();
    }
    // A mesh of such positions refuses them by name.
    if (!is_finite) Mesh refused(shape, rest_.shared_topology());
}

double MovingSurface::stretch(std::span<const Vec3> shape) const {
    double most = 1.0;
    for (const Index v : moving_) {
        for (const Index n : rest_.topology().neighbors(v)) {
            const double before = (rest_.position(v) - rest_.position(n)).norm();
            const double after = (shape[at(v)] - shape[at(n)]).norm();
            if (before > 0.0) most = std::max({most, after / before, before / after});
        }
    }
    return most;
}

}  // namespace lissom
