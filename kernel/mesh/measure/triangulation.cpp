#include "kernel/mesh/measure/triangulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "kernel/mesh/measure/flat_triangle.h"
#include "kernel/mesh/measure/triangulation_room.h"

namespace lissom {
namespace {

// Diagonals whose lengths differ by less than this fraction count as equal, so that rounding in a
// moved or turned copy of a mesh does not change the choice.
constexpr double kDiagonalTolerance = 1e-6;

// Polygons of more corners are clipped without looking for the best ear each time.
constexpr std::size_t kLargestByQuality = 32;

// Unit normal of the mean plane; zero if there is none.
Vec3 mean_normal(std::span<const Vec3> points) {
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        normal += (points[i] - points[0]).cross(points[i + 1] - points[0]);
    }
    const double length = normal.norm();
    return length > 0.0 ? Vec3(normal / length) : normal;
}

void triangulate_quad(std::span<const Vec3> points, std::vector<Triangle>& triangles) {
    const Vec3 normal = mean_normal(points);
    const auto convex = [&](int a, int b, int c) {
        const double flat = kFlatTriangle * longest_side_squared(points[a], points[b], points[c]);
        return signed_area(points[a], points[b], points[c], normal) > flat;
    };
    const bool first_valid = convex(0, 1, 2) && convex(0, 2, 3);
    const bool second_valid = convex(1, 2, 3) && convex(1, 3, 0);
    const double first = (points[2] - points[0]).squaredNorm();
    const double second = (points[3] - points[1]).squaredNorm();
    const bool second_shorter = second < first * (1.0 - kDiagonalTolerance);
    if (second_valid && (!first_valid || second_shorter)) {
        triangles.push_back({0, 1, 3});
        triangles.push_back({1, 2, 3});
    } else {
        triangles.push_back({0, 1, 2});
        triangles.push_back({0, 2, 3});
    }
}

// How good it is to cut off the corner `at`: the triangle's area over its longest side squared. A
// corner in line with its neighbours is worse than any, a reflex one or one whose triangle covers
// another vertex worse still. Vertices that lie on the triangle, up to rounding, count as covered.
double ear_quality(std::span<const Vec3> points, const std::vector<Index>& loop, std::size_t at,
                   const Vec3& normal) {
    constexpr double kInLine = -0.5, kInvalid = -1.0;
    const std::size_t n = loop.size();
    const Index before = loop[(at + n - 1) % n], here = loop[at], after = loop[(at + 1) % n];
    const Vec3 &a = points[before], &b = points[here], &c = points[after];
    const double longest = longest_side_squared(a, b, c), flat = kFlatTriangle * longest;
    const double area = signed_area(a, b, c, normal);
    if (area < -flat) return kInvalid;
    if (area <= flat) return kInLine;
    for (const Index other : loop) {
        const Vec3& p = points[other];
        // Another vertex at the same place as a corner, at a point of self-contact of the outline,
        // does not count.
        if (p == a || p == b || p == c) continue;
        const bool covered = signed_area(a, b, p, normal) >= -flat &&
                             signed_area(b, c, p, normal) >= -flat &&
                             signed_area(c, a, p, normal) >= -flat;
        if (covered) return kInvalid;
    }
    return area / longest;
}

void clip_ears(std::span<const Vec3> points, std::vector<Triangle>& triangles,
               std::vector<Index>& loop) {
    loop.resize(points.size());
    std::iota(loop.begin(), loop.end(), 0);
    const Vec3 normal = mean_normal(points);
    while (loop.size() > 3) {
        std::size_t best = 0;
        double best_quality = -2.0;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const double quality = ear_quality(points, loop, i, normal);
            if (quality <= best_quality + kDiagonalTolerance) continue;
            best_quality = quality;
            best = i;
        }
        const std::size_t n = loop.size();
        triangles.push_back({loop[(best + n - 1) % n], loop[best], loop[(best + 1) % n]});
        loop.erase(loop.begin() + best);
    }
    triangles.push_back({loop[0], loop[1], loop[2]});
}

}  // namespace

void triangulate_polygon(std::span<const Vec3> points, std::vector<Triangle>& triangles,
                         TriangulationRoom& room) {
    if (points.size() == 3) {
        triangles.push_back({0, 1, 2});
    } else if (points.size() == 4) {
        triangulate_quad(points, triangles);
    } else if (points.size() <= kLargestByQuality) {
        clip_ears(points, triangles, room.loop);
    } else {
        clip_ears_around(points, mean_normal(points), triangles, room.ears);
    }
}

void triangulate_polygon(std::span<const Vec3> points, std::vector<Triangle>& triangles) {
    TriangulationRoom room;
    triangulate_polygon(points, triangles, room);
}

void triangulate_faces(const Topology& topology, std::span<const Vec3> positions,
                       std::span<const Index> faces, Triangulation& result,
                       TriangulationRoom& room) {
    result.triangles.clear();
    result.corners.clear();
    result.face.clear();
    for (const Index f : faces) {
        const std::span<const Index> face = topology.face(f);
        const Index first = topology.first_corner(f);
        if (face.size() == 3) {
            result.triangles.push_back({face[0], face[1], face[2]});
            result.corners.push_back({first, first + 1, first + 2});
            result.face.push_back(f);
            continue;
        }
        room.points.clear();
        room.local.clear();
        for (const Index v : face) room.points.push_back(positions[at(v)]);
        triangulate_polygon(room.points, room.local, room);
        for (const auto& [a, b, c] : room.local) {
            result.triangles.push_back({face[at(a)], face[at(b)], face[at(c)]});
            result.corners.push_back({first + a, first + b, first + c});
            result.face.push_back(f);
        }
    }
}

Triangulation triangulate_faces(const Topology& topology, std::span<const Vec3> positions,
                                std::span<const Index> faces) {
    Triangulation result;
    result.triangles.reserve(faces.size());
    result.corners.reserve(faces.size());
    result.face.reserve(faces.size());
    TriangulationRoom room;
    triangulate_faces(topology, positions, faces, result, room);
    return result;
}

Triangulation triangulate_faces(const Topology& topology, std::span<const Vec3> positions) {
    std::vector<Index> all(topology.face_count());
    std::iota(all.begin(), all.end(), 0);
    return triangulate_faces(topology, positions, all);
}

}  // namespace lissom
