#include "kernel/deform/poses/pose_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

constexpr double kLeastCotangent = 0.02, kGreatestCotangent = 50.0;

// Edges are parallel if the sine of their angle is not above this.
constexpr double kFlatSine = 1e-7;

constexpr double kLinkWeight = 1.0;

std::array<double, 3> edge_weights(const Triangle& triangle, std::span<const Vec3> at_rest) {
    std::array<double, 3> weights{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& apex = at_rest[at(triangle[(k + 2) % 3])];
        const Vec3 a = at_rest[at(triangle[k])] - apex;
        const Vec3 b = at_rest[at(triangle[(k + 1) % 3])] - apex;
        const double area = a.cross(b).norm();
        const double cotangent = area > 0.0 ? a.dot(b) / area : 0.0;
        weights[k] = std::clamp(cotangent, kLeastCotangent, kGreatestCotangent);
    }
    return weights;
}

// Pairs the triangles on either side of each edge; of a third triangle at an edge it is not told.
std::vector<std::array<Index, 3>> neighbors_of(const std::vector<Triangle>& triangles) {
    std::vector<std::pair<std::uint64_t, Index>> sides;
    for (Index t = 0; t < count_of(triangles); ++t) {
        for (Index k = 0; k < 3; ++k) {
            const Index a = triangles[at(t)][at(k)], b = triangles[at(t)][at((k + 1) % 3)];
            sides.emplace_back(pair_key(std::min(a, b), std::max(a, b)), 3 * t + k);
        }
    }
    std::sort(sides.begin(), sides.end());
    std::vector<std::array<Index, 3>> neighbors(triangles.size(), {kNoIndex, kNoIndex, kNoIndex});
    for (std::size_t i = 1; i < sides.size(); ++i) {
        if (sides[i - 1].first != sides[i].first) continue;
        const Index one = sides[i - 1].second, other = sides[i].second;
        neighbors[at(one / 3)][at(one % 3)] = other / 3;
        neighbors[at(other / 3)][at(other % 3)] = one / 3;
        ++i;
    }
    return neighbors;
}

struct ComponentExtent {
    Index vertices = 0;
    Vec3 sum = Vec3::Zero();
    double squares = 0.0;

    // The root mean square distance to the mean.
    double radius() const {
        const Vec3 mean = sum / vertices;
        return std::sqrt(std::max(squares / vertices - mean.squaredNorm(), 0.0));
    }
};

// Sums are about `origin`, so that a mesh far from that of its coordinates keeps its digits.
std::vector<ComponentExtent> extents_of(const Mesh& mesh, const Vec3& origin) {
    std::vector<ComponentExtent> extents(at(mesh.topology().component_count()));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        ComponentExtent& extent = extents[at(mesh.topology().components()[at(v)])];
        const Vec3 arm = mesh.position(v) - origin;
        ++extent.vertices;
        extent.sum += arm;
        extent.squares += arm.squaredNorm();
    }
    return extents;
}

// The nearest place of a component on the surface of the largest one.
struct NearestPlace {
    double distance = std::numeric_limits<double>::infinity();
    Index vertex = kNoIndex;
    Index face = kNoIndex;
};

// Adds links of the components that are nearer to the largest one than their own size.
class LinkFinder {
  public:
    LinkFinder(const Mesh& rest, PoseTriangles& into)
        : rest_(rest),
          into_(into),
          extents_(extents_of(rest, rest.position(0))),
          largest_(index_of(std::max_element(extents_.begin(), extents_.end(),
                                             [](const auto& a, const auto& b) {
                                                 return a.vertices < b.vertices;
                                             }) -
                            extents_.begin())) {}

    void find(const Context& context) {
        std::vector<Triangle> below;
        for (Index t = 0; t < count_of(into_.triangles); ++t) {
            if (component(into_.triangles[at(t)][0]) != largest_) continue;
            below.push_back(into_.triangles[at(t)]);
            host_.push_back(t);
        }
        if (below.empty()) return;
        const SpatialTree tree({rest_.positions().begin(), rest_.positions().end()}, below,
                               context);
        for (const auto& [c, place] : nearest_places(tree, context)) add(c, place);
    }

  private:
    Index component(Index v) const { return rest_.topology().components()[at(v)]; }

    std::vector<std::pair<Index, NearestPlace>> nearest_places(const SpatialTree& tree,
                                                               const Context& context) const {
        std::vector<NearestPlace> places(extents_.size());
        for (Index v = 0; v < rest_.vertex_count(); ++v) {
            if (v % 1024 == 0) context.checkpoint();
            const Index c = component(v);
            if (c == largest_ || rest_.topology().is_isolated(v)) continue;
            NearestPlace& place = places[at(c)];
            const double limit = std::min(place.distance, extents_[at(c)].radius());
            const auto found = tree.nearest_within(rest_.position(v), limit);
            if (found && found->distance < place.distance)
                place = {found->distance, v, found->face};
        }
        std::vector<std::pair<Index, NearestPlace>> found;
        for (Index c = 0; c < count_of(places); ++c) {
            if (places[at(c)].vertex != kNoIndex) found.emplace_back(c, places[at(c)]);
        }
        return found;
    }

    void add(Index component, const NearestPlace& place) {
        const Index host = host_[at(place.face)];
        const Triangle& below = into_.triangles[at(host)];
        into_.triangles.push_back({below[0], below[1], place.vertex});
        into_.weight.push_back({0.0, kLinkWeight, 0.0});
        into_.neighbor.push_back({kNoIndex, kNoIndex, kNoIndex});
        into_.hosts.push_back(host);
        into_.base[at(component)] = largest_;
    }

    const Mesh& rest_;
    PoseTriangles& into_;
    std::vector<ComponentExtent> extents_;
    Index largest_;
    std::vector<Index> host_;
};

}  // namespace

PoseTriangles pose_triangles(const Mesh& rest, const Context& context) {
    PoseTriangles result;
    result.triangles = triangulate_faces(rest.topology(), rest.positions()).triangles;
    for (const Triangle& triangle : result.triangles) {
        result.weight.push_back(edge_weights(triangle, rest.positions()));
    }
    result.neighbor = neighbors_of(result.triangles);
    result.base.resize(at(rest.topology().component_count()));
    std::iota(result.base.begin(), result.base.end(), 0);
    if (rest.topology().component_count() > 1) LinkFinder(rest, result).find(context);
    return result;
}

TriangleEdges edges_of(const Triangle& triangle, std::span<const Vec3> positions) {
    const auto& [a, b, c] = triangle;
    return {positions[at(b)] - positions[at(a)], positions[at(c)] - positions[at(b)]};
}

Mat3 edge_frame(const TriangleEdges& edges) {
    const Vec3 normal = edges.first.cross(edges.second);
    Mat3 frame;
    frame << edges.first, edges.second, normal / std::sqrt(normal.norm());
    return frame;
}

bool is_flat(const TriangleEdges& edges) {
    const double lengths = edges.first.squaredNorm() + edges.second.squaredNorm();
    return !(edges.first.cross(edges.second).norm() > kFlatSine * lengths);
}

}  // namespace lissom
