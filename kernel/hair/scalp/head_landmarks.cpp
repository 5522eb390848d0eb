#include "kernel/hair/scalp/head_landmarks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

namespace lissom {
namespace {

Spot spot_of(const Mesh& mesh, std::span<const Index> vertices) {
    Spot spot;
    for (const Index v : vertices) spot.center += mesh.position(v);
    spot.center /= vertices.size();
    for (const Index v : vertices) spot.radius += (mesh.position(v) - spot.center).norm();
    spot.radius /= vertices.size();
    return spot;
}

// Openings are not looked at in meshes that have more of them: they are full of holes.
constexpr std::size_t kMaxSpots = 400;

std::vector<Spot> components_beside(const Mesh& mesh, Index largest) {
    const std::vector<Index>& component = mesh.topology().components();
    const std::size_t count = mesh.topology().component_count();
    if (count > kMaxSpots) return {};
    std::vector<std::vector<Index>> vertices(count);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (component[v] != largest) vertices[component[v]].push_back(v);
    }
    std::vector<Spot> spots;
    for (const std::vector<Index>& list : vertices) {
        if (!list.empty()) spots.push_back(spot_of(mesh, list));
    }
    return spots;
}

void add_pairs(const std::vector<Spot>& spots, std::vector<EyePair>& pairs) {
    constexpr double kUnlike = 1.25, kNearest = 3.0, kFarthest = 9.0;
    if (spots.size() > kMaxSpots) return;
    for (std::size_t i = 0; i < spots.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double a = spots[i].radius, b = spots[j].radius;
            const double apart = (spots[i].center - spots[j].center).norm() / (0.5 * (a + b));
            const bool alike = a < kUnlike * b && b < kUnlike * a;
            if (alike && apart > kNearest && apart < kFarthest)
                pairs.push_back({spots[i], spots[j]});
        }
    }
}

double loop_length(const Mesh& mesh, std::span<const Index> loop) {
    double length = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        length += (mesh.position(loop[(i + 1) % loop.size()]) - mesh.position(loop[i])).norm();
    }
    return length;
}

// Normal of a loop by its area, towards `side`.
Vec3 loop_normal(const Mesh& mesh, std::span<const Index> loop, const Vec3& side) {
    const Spot spot = spot_of(mesh, loop);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i) {
        sum += (mesh.position(loop[i]) - spot.center)
                   .cross(mesh.position(loop[(i + 1) % loop.size()]) - spot.center);
    }
    if (!(sum.norm() > 0.0)) return Vec3::Zero();
    return sum.dot(side - spot.center) < 0.0 ? Vec3(-sum.normalized()) : Vec3(sum.normalized());
}

}  // namespace

Landmarks landmarks_of(const Mesh& mesh, const std::vector<Index>& part, double part_area) {
    // A neck is about as long as this, in roots of the area.
    constexpr double kMinOpening = 1.0;
    Landmarks found;
    const Index component = mesh.topology().components()[part.front()];
    std::vector<Spot> openings;
    const std::vector<Index>* greatest = nullptr;
    for (const std::vector<Index>& loop : mesh.topology().boundary_loops()) {
        if (mesh.topology().components()[loop.front()] != component) {
            continue;
        }
        openings.push_back(spot_of(mesh, loop));
        const double size = loop_length(mesh, loop) / std::sqrt(part_area);
        if (size <= std::max(found.opening, kMinOpening)) continue;
        found.opening = size;
        greatest = &loop;
    }
    if (greatest) found.from_opening = loop_normal(mesh, *greatest, spot_of(mesh, part).center);
    add_pairs(openings, found.pairs);
    add_pairs(components_beside(mesh, component), found.pairs);
    return found;
}

bool are_eyes(const EyePair& pair, const HeadFrame& frame) {
    const double radius = 0.5 * (pair.one.radius + pair.other.radius) / frame.width;
    const Vec3 a = frame.local(pair.one.center) / frame.width,
               b = frame.local(pair.other.center) / frame.width, middle = 0.5 * (a + b);
    const double apart = (b - a).norm();
    return radius > 0.05 && radius < 0.16 && apart > 0.28 && apart < 0.6 &&
           std::abs(b.x() - a.x()) > 0.96 * apart && std::abs(middle.x()) < 0.08 &&
           middle.y() > -0.5 && middle.y() < 0.2 && middle.z() > 0.2;
}

}  // namespace lissom
