#include "kernel/merge/crossings/hidden_crossings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

// Directions that a place is looked at from, and how many of them may see it.
constexpr std::size_t kViews = 128, kSeenFrom = 4;
// Surfaces as near as this part of the longest edge of the crossing faces do not hide a place: it
// lies on them, but for the bend of polygons.
constexpr double kOnSurface = 0.1;

// Spread evenly over the sphere, along a spiral.
std::vector<Vec3> views() {
    constexpr double kGoldenAngle = kPi * (3.0 - 2.23606797749978969641);
    std::vector<Vec3> directions;
    for (std::size_t k = 0; k < kViews; ++k) {
        const double z = 1.0 - (2.0 * static_cast<double>(k) + 1.0) / static_cast<double>(kViews);
        const double around = kGoldenAngle * static_cast<double>(k), r = std::sqrt(1.0 - z * z);
        directions.emplace_back(r * std::cos(around), r * std::sin(around), z);
    }
    return directions;
}

// Point at which a segment passes through a triangle, if it does.
std::optional<Vec3> passing(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b,
                            const Vec3& c) {
    const Vec3 along = to - from, normal = (b - a).cross(c - a);
    const double slope = normal.dot(along);
    if (slope == 0.0) return std::nullopt;
    const double t = normal.dot(a - from) / slope;
    if (!(t >= 0.0 && t <= 1.0)) return std::nullopt;
    const Vec3 p = from + t * along;
    const bool inside = normal.dot((b - a).cross(p - a)) >= 0.0 &&
                        normal.dot((c - b).cross(p - b)) >= 0.0 &&
                        normal.dot((a - c).cross(p - c)) >= 0.0;
    return inside ? std::optional(p) : std::nullopt;
}

struct MeanPoint {
    Vec3 sum = Vec3::Zero();
    double count = 0.0;

    void add(const Vec3& p) {
        sum += p;
        count += 1.0;
    }
    Vec3 value() const { return sum / count; }
};

// Adds the points at which the edges of one face pass through another.
void add_passings(const Mesh& mesh, Index edges_of, Index through, MeanPoint& mean) {
    const std::span<const Index> face = mesh.topology().face(edges_of);
    const std::span<const Index> other = mesh.topology().face(through);
    for (std::size_t k = 0; k < face.size(); ++k) {
        const Vec3 &from = mesh.position(face[k]), &to = mesh.position(face[(k + 1) % face.size()]);
        for (std::size_t j = 1; j + 1 < other.size(); ++j) {
            const auto point = passing(from, to, mesh.position(other[0]), mesh.position(other[j]),
                                       mesh.position(other[j + 1]));
            if (point) mean.add(*point);
        }
    }
}

// The middle of the line along which two faces cross, or of both if they lie on one another.
Vec3 crossing_place(const Mesh& mesh, const FacePair& pair) {
    MeanPoint mean;
    add_passings(mesh, pair.first, pair.second, mean);
    add_passings(mesh, pair.second, pair.first, mean);
    if (mean.count > 0.0) return mean.value();
    for (const Index f : {pair.first, pair.second}) {
        for (const Index v : mesh.topology().face(f)) mean.add(mesh.position(v));
    }
    return mean.value();
}

double longest_edge(const Mesh& mesh, const FacePair& pair) {
    double longest = 0.0;
    for (const Index f : {pair.first, pair.second}) {
        const std::span<const Index> face = mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Vec3 edge = mesh.position(face[(k + 1) % face.size()]) - mesh.position(face[k]);
            longest = std::max(longest, edge.norm());
        }
    }
    return longest;
}

bool is_hidden(const SpatialTree& tree, const Mesh& mesh, const FacePair& pair,
               std::span<const Vec3> directions) {
    const Vec3 place = crossing_place(mesh, pair);
    HideOptions how;
    how.touching = kOnSurface * longest_edge(mesh, pair);
    std::size_t seen = 0;
    for (const Vec3& direction : directions) {
        if (!tree.hides(place, direction, how)) ++seen;
        if (seen > kSeenFrom) return false;
    }
    return true;
}

}  // namespace

std::vector<char> hidden_pairs(const Mesh& mesh, std::span<const FacePair> pairs,
                               const Context& context) {
    std::vector<char> hidden(pairs.size(), 0);
    if (pairs.empty()) return hidden;
    const SpatialTree tree(mesh, context);
    const std::vector<Vec3> directions = views();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        context.checkpoint();
        hidden[k] = is_hidden(tree, mesh, pairs[k], directions) ? 1 : 0;
    }
    return hidden;
}

}  // namespace lissom
