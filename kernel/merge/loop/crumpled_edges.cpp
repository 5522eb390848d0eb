#include "kernel/merge/loop/crumpled_edges.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_set>

#include "kernel/merge/loop/face_angles.h"

namespace lissom {
namespace {

// The least change of an edge that shows.
constexpr double kChanged = 20.0 * kDegree;

Vec3 area_at(std::span<const Index> face, std::span<const Vec3> places) {
    Vec3 sum = Vec3::Zero();
    const Vec3& first = places[at(face[0])];
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
        sum += (places[at(face[k])] - first).cross(places[at(face[k + 1])] - first);
    }
    return sum;
}

// An edge from a to b, and the faces on its left and on its right.
struct EdgeFaces {
    Index a = kNoIndex, b = kNoIndex;
    std::span<const Index> left, right;
};

// Above 0 on ridges; NaN if a face has no area or no place.
double signed_turn(const EdgeFaces& edge, std::span<const Vec3> places) {
    const Vec3 n = area_at(edge.left, places), m = area_at(edge.right, places);
    if (!(n.squaredNorm() > 0.0 && m.squaredNorm() > 0.0)) return NAN;
    const Vec3 along = (places[at(edge.b)] - places[at(edge.a)]).normalized();
    return std::atan2(n.cross(m).dot(along), n.dot(m));
}

// An edge that became flatter is no wrinkle: the corners of a square rim that meets a round one go.
bool is_crumpled_edge(const EdgeFaces& edge, std::span<const Vec3> now,
                      std::span<const Vec3> rest) {
    const double made = signed_turn(edge, now), before = signed_turn(edge, rest);
    const double change = std::abs(made - before);
    return std::min(change, 2.0 * kPi - change) > kChanged && std::abs(made) > std::abs(before);
}

bool is_within(const MadeRim& made, std::span<const Index> face) {
    return std::any_of(face.begin(), face.end(), [&](Index v) {
        return made.distance[at(v)] <= kCrumpledReach * made.radius;
    });
}

}  // namespace

std::vector<CrumpledEdge> crumpled_edges(const MadeRim& made, std::span<const Vec3> rest) {
    std::vector<CrumpledEdge> result;
    if (!(made.radius > 0.0)) return result;
    const std::span<const Vec3> now = made.mesh.positions();
    // The seam's own edges belong to neither side.
    std::unordered_set<std::uint64_t> seen;
    for (std::size_t k = 0; k < made.loop.size(); ++k) {
        seen.insert(edge_key(made.loop[k], made.loop[(k + 1) % made.loop.size()]));
    }
    for (const Index f : made.faces) {
        const std::span<const Index> face = made.mesh.topology().face(f);
        if (!is_within(made, face)) continue;
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index a = face[k], b = face[(k + 1) % face.size()];
            const Index other = face_left_of(made.mesh.topology(), b, a);
            if (other == kNoIndex || !seen.insert(edge_key(a, b)).second) continue;
            const EdgeFaces edge{a, b, face, made.mesh.topology().face(other)};
            if (!is_crumpled_edge(edge, now, rest)) continue;
            result.push_back({a, b, (now[at(b)] - now[at(a)]).norm()});
        }
    }
    return result;
}

double crumpled_length(const MadeRim& made, std::span<const Vec3> rest) {
    double length = 0.0;
    for (const CrumpledEdge& edge : crumpled_edges(made, rest)) length += edge.length;
    return made.radius > 0.0 ? length / made.radius : 0.0;
}

}  // namespace lissom
