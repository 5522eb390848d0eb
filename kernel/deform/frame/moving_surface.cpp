#include "kernel/deform/frame/moving_surface.h"

#include <algorithm>
#include <iterator>
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
      faces_(faces_at(*prepared.rest->region().topology(), moving_)),
      rest_(mesh_at_rest(*prepared.rest)),
      crossings_(pairs_of(rest_, context)),
      closeness_(rest_, moving_) {}

Mesh MovingSurface::shape(std::span<const Vec3> positions) const {
    std::vector<Vec3> all(rest_.positions().begin(), rest_.positions().end());
    for (std::size_t row = 0; row < region_.size(); ++row) all[at(region_[row])] = positions[row];
    return {std::move(all), rest_.shared_topology()};
}

double MovingSurface::stretch(const Mesh& shape) const {
    double most = 1.0;
    for (const Index v : moving_) {
        for (const Index n : rest_.topology().neighbors(v)) {
            const double before = (rest_.position(v) - rest_.position(n)).norm();
            const double after = (shape.position(v) - shape.position(n)).norm();
            if (before > 0.0) most = std::max({most, after / before, before / after});
        }
    }
    return most;
}

Index MovingSurface::crossings(const Mesh& shape, const Context& context) const {
    const std::vector<FacePair> now = pairs_of(shape, context);
    std::vector<FacePair> added;
    std::set_difference(now.begin(), now.end(), crossings_.begin(), crossings_.end(),
                        std::back_inserter(added));
    return count_of(added);
}

std::vector<FacePair> MovingSurface::pairs_of(const Mesh& shape, const Context& context) const {
    SelfIntersectionOptions options;
    options.faces = faces_;
    return self_intersections(shape, options, context);
}

}  // namespace lissom
