#include "kernel/merge/paste/part/target_bite.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "kernel/merge/loop/face_angles.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

// In radii of the seam: how far from its middle edges count, how far apart their points are, and
// how far one may lie from the surface that it was on.
constexpr double kBiteReach = 2.5, kBiteStep = 0.05, kBiteDepth = 0.05;
// Shorter lines of sharp edges are grain.
constexpr double kBiteLine = 0.5;

// Vertices that sharp edges join, and the length of these.
class SharpLines {
  public:
    explicit SharpLines(Index vertices) : parent_(at(vertices)), length_(at(vertices), 0.0) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    void join(Index a, Index b, double length) {
        const Index first = root(a), second = root(b);
        length_[at(first)] += length;
        if (first == second) return;
        parent_[at(second)] = first;
        length_[at(first)] += length_[at(second)];
    }
    double length(Index v) { return length_[at(root(v))]; }

  private:
    Index root(Index v) {
        while (parent_[at(v)] != v) v = parent_[at(v)] = parent_[at(parent_[at(v)])];
        return v;
    }
    std::vector<Index> parent_;
    std::vector<double> length_;
};

// Calls `use` with both ends and the angle of each edge between two faces.
template <typename Use>
void for_inner_edges(const Mesh& mesh, const Context& context, const Use& use) {
    const Topology& topology = mesh.topology();
    for (Index f = 0; f < topology.face_count(); ++f) {
        if (f % 4096 == 0) context.checkpoint();
        const std::span<const Index> face = topology.face(f);
        const Vec3 normal = clear_area_vector(mesh, f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index a = face[k], b = face[(k + 1) % face.size()];
            if (a > b) continue;
            const Index other = face_left_of(topology, b, a);
            if (other == kNoIndex) continue;
            const Vec3 across = clear_area_vector(mesh, other);
            const bool clear = normal.squaredNorm() > 0.0 && across.squaredNorm() > 0.0;
            if (clear) use(a, b, angle_between(normal, across));
        }
    }
}

// An edge is one of a grain, and not sharp, that turns by less than this many times as much as the
// edges around it that are not sharp, in the mean: the ribs and wrinkles of scans have no edge that
// a part could bite into.
constexpr double kOfGrain = 2.5;

// The grain of a surface at its vertices: the RMS turn of the edges that are not sharp.
class Grain {
  public:
    explicit Grain(Index vertices) : squares_(at(vertices), 0.0), length_(at(vertices), 0.0) {}
    void add(Index v, double length, double turn) {
        squares_[at(v)] += length * turn * turn;
        length_[at(v)] += length;
    }
    double between(Index a, Index b) const {
        const double length = length_[at(a)] + length_[at(b)];
        return length > 0.0 ? std::sqrt((squares_[at(a)] + squares_[at(b)]) / length) : 0.0;
    }

  private:
    std::vector<double> squares_, length_;
};

Grain grain_of(const Mesh& mesh, const Context& context) {
    Grain grain(mesh.vertex_count());
    for_inner_edges(mesh, context, [&](Index a, Index b, double turn) {
        if (turn > kSharpEdge) return;
        const double length = (mesh.position(b) - mesh.position(a)).norm();
        grain.add(a, length, turn);
        grain.add(b, length, turn);
    });
    return grain;
}

Vec3 mean_of(std::span<const Vec3> points) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points) sum += p;
    return points.empty() ? sum : Vec3(sum / static_cast<double>(points.size()));
}

double mean_distance(std::span<const Vec3> points, const Vec3& middle) {
    double sum = 0.0;
    for (const Vec3& p : points) sum += (p - middle).norm();
    return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

// How far a point of a sharp edge is from the result, if that has the edge there no more.
double bite_at(const Vec3& point, double least, const SpatialTree& tree, const BittenMesh& result) {
    const SurfacePoint found = tree.nearest(point);
    if (found.distance <= least) return 0.0;
    const bool stands_out = (point - found.position).dot(found.normal) > 0.0;
    const bool of_target = result.side_of_face[at(found.face)] == SeamSide::target;
    const bool bitten = of_target || (stands_out && !result.dent);
    return bitten ? found.distance : 0.0;
}

}  // namespace

Vec3 nearest_point_of(const SharpEdge& edge, const Vec3& point) {
    const Vec3 along = edge.to - edge.from;
    const double square = along.squaredNorm();
    const double part = square > 0.0 ? (point - edge.from).dot(along) / square : 0.0;
    return edge.from + std::clamp(part, 0.0, 1.0) * along;
}

std::vector<SharpEdge> sharp_edges(const Mesh& mesh, const Context& context) {
    SharpLines lines(mesh.vertex_count());
    std::vector<std::pair<Index, Index>> ends;
    const Grain grain = grain_of(mesh, context);
    for_inner_edges(mesh, context, [&](Index a, Index b, double turn) {
        if (!(turn > std::max(kSharpEdge, kOfGrain * grain.between(a, b)))) return;
        ends.emplace_back(a, b);
        lines.join(a, b, (mesh.position(b) - mesh.position(a)).norm());
    });
    std::vector<SharpEdge> edges;
    for (const auto& [a, b] : ends) {
        edges.push_back({mesh.position(a), mesh.position(b), lines.length(a), a, b});
    }
    return edges;
}

TargetBite target_bite(std::span<const SharpEdge> edges, std::span<const Vec3> seam,
                       const BittenMesh& result, const Context& context) {
    const Vec3 middle = mean_of(seam);
    const double radius = mean_distance(seam, middle);
    TargetBite bite;
    if (!(radius > 0.0)) return bite;
    std::optional<SpatialTree> tree;
    for (const SharpEdge& edge : edges) {
        if (edge.line < kBiteLine * radius) continue;
        if ((nearest_point_of(edge, middle) - middle).norm() > kBiteReach * radius) continue;
        if (!tree) tree.emplace(result.mesh, context);
        const double length = (edge.to - edge.from).norm();
        const double steps = std::max(1.0, std::ceil(length / (kBiteStep * radius)));
        for (double k = 0.5; k < steps; k += 1.0) {
            const Vec3 point = edge.from + k / steps * (edge.to - edge.from);
            if ((point - middle).norm() > kBiteReach * radius) continue;
            const double depth = bite_at(point, kBiteDepth * radius, *tree, result) / radius;
            if (depth > 0.0) bite.length += length / (steps * radius);
            bite.depth = std::max(bite.depth, depth);
        }
    }
    return bite;
}

double volume_over(const Mesh& part, std::span<const Index> loop) {
    std::vector<Vec3> rim;
    for (const Index v : loop) rim.push_back(part.position(v));
    const Vec3 middle = mean_of(rim);
    double volume = 0.0;
    for (Index f = 0; f < part.face_count(); ++f) {
        const std::span<const Index> face = part.topology().face(f);
        const Vec3 first = part.position(face[0]) - middle;
        for (std::size_t k = 1; k + 1 < face.size(); ++k) {
            volume += first.dot(
                (part.position(face[k]) - middle).cross(part.position(face[k + 1]) - middle));
        }
    }
    return volume / 6.0;
}

}  // namespace lissom
