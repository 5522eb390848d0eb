#include "kernel/mesh/query/triangle_intersection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace lissom {
namespace {

// A triangle with its unit normal, which is zero if it has no area.
struct Plate {
    const std::array<Vec3, 3>& corners;
    Vec3 normal;

    explicit Plate(const std::array<Vec3, 3>& points, double tolerance) : corners(points) {
        normal = (points[1] - points[0]).cross(points[2] - points[0]);
        const double longest = std::sqrt(
            std::max({(points[1] - points[0]).squaredNorm(), (points[2] - points[1]).squaredNorm(),
                      (points[0] - points[2]).squaredNorm()}));
        const double length = normal.norm();
        normal = length > tolerance * longest ? Vec3(normal / length) : Vec3(Vec3::Zero());
    }

    bool has_area() const { return normal.squaredNorm() > 0.0; }
    double height(const Vec3& p) const { return normal.dot(p - corners[0]); }

    // Distance of a point of the plane from an edge's line, positive inside.
    double inside(int edge, const Vec3& p) const {
        const Vec3 along = corners[(edge + 1) % 3] - corners[edge];
        return normal.dot(along.cross(p - corners[edge])) / along.norm();
    }

    bool holds(const Vec3& p, double tolerance) const {
        return inside(0, p) >= -tolerance && inside(1, p) >= -tolerance &&
               inside(2, p) >= -tolerance;
    }
};

// Cuts the part of a segment in the triangle's plane that lies inside all edges.
bool meets_in_plane(const Plate& plate, const Vec3& from, const Vec3& to, double tolerance) {
    double begin = 0.0, end = 1.0;
    for (int edge = 0; edge < 3; ++edge) {
        const double a = plate.inside(edge, from) + tolerance;
        const double b = plate.inside(edge, to) + tolerance;
        if (a < 0.0 && b < 0.0) return false;
        if (a < 0.0) begin = std::max(begin, a / (a - b));
        if (b < 0.0) end = std::min(end, a / (a - b));
    }
    return begin <= end;
}

bool segment_meets(const Plate& plate, const Vec3& from, const Vec3& to, double tolerance) {
    if (!plate.has_area()) return false;
    const double a = plate.height(from), b = plate.height(to);
    if (std::min(a, b) > tolerance || std::max(a, b) < -tolerance) return false;
    if (std::max(std::abs(a), std::abs(b)) <= tolerance) {
        return meets_in_plane(plate, from, to, tolerance);
    }
    const double t = std::clamp(a / (a - b), 0.0, 1.0);
    return plate.holds(from + t * (to - from), tolerance);
}

// The local number of the vertex of `a` that is `v`, or -1.
int corner_of(const Triangle& a, Index v) {
    for (int k = 0; k < 3; ++k) {
        if (a[k] == v) return k;
    }
    return -1;
}

// Triangles with a common edge also meet elsewhere if they are folded upon each other.
bool is_fold(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, int a_apex, int b_apex,
             double tolerance) {
    const Plate plate(a, tolerance);
    const Vec3& apex = b[b_apex];
    return plate.has_area() && std::abs(plate.height(apex)) <= tolerance &&
           plate.inside((a_apex + 1) % 3, apex) > tolerance && Plate(b, tolerance).has_area();
}

bool is_one_place(const Vec3& a, const Vec3& b) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

// Numbers the corners of two triangles so that those at one place have one number.
void number_by_place(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& q, Triangle& a,
                     Triangle& b) {
    a = {0, 1, 2};
    b = {3, 4, 5};
    for (std::size_t k = 1; k < 3; ++k) {
        for (std::size_t j = k; j-- > 0;) {
            if (is_one_place(p[k], p[j])) a[k] = a[j];
            if (is_one_place(q[k], q[j])) b[k] = b[j];
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 3; j-- > 0;) {
            if (is_one_place(q[k], p[j])) b[k] = a[j];
        }
    }
}

}  // namespace

bool triangles_intersect(const Triangle& a, const std::array<Vec3, 3>& a_corners, const Triangle& b,
                         const std::array<Vec3, 3>& b_corners, double tolerance) {
    std::array<int, 3> a_own{}, b_own{};
    int shared = 0, own_of_a = 0, own_of_b = 0;
    for (int k = 0; k < 3; ++k) {
        if (corner_of(b, a[k]) < 0) a_own[own_of_a++] = k;
        if (corner_of(a, b[k]) < 0) b_own[own_of_b++] = k;
    }
    shared = 3 - own_of_a;
    if (own_of_a != own_of_b) return false;  // a vertex is used twice: no area
    if (shared == 2) return is_fold(a_corners, b_corners, a_own[0], b_own[0], tolerance);
    const Plate p(a_corners, tolerance);
    if (shared == 3) return p.has_area();
    const Plate q(b_corners, tolerance);
    if (shared == 1) {
        return segment_meets(q, a_corners[a_own[0]], a_corners[a_own[1]], tolerance) ||
               segment_meets(p, b_corners[b_own[0]], b_corners[b_own[1]], tolerance);
    }
    for (int k = 0; k < 3; ++k) {
        if (segment_meets(q, a_corners[k], a_corners[(k + 1) % 3], tolerance)) return true;
        if (segment_meets(p, b_corners[k], b_corners[(k + 1) % 3], tolerance)) return true;
    }
    return false;
}

bool triangles_meet(const std::array<Vec3, 3>& a_corners, const std::array<Vec3, 3>& b_corners,
                    double tolerance) {
    Triangle a, b;
    number_by_place(a_corners, b_corners, a, b);
    return triangles_intersect(a, a_corners, b, b_corners, tolerance);
}

}  // namespace lissom
