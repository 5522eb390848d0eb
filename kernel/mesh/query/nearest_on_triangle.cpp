#include "kernel/mesh/query/nearest_on_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace lissom {
namespace {

// A triangle whose area is a smaller part than this of the product of two sides has no normal.
constexpr double kFlat = 1e-13;

PointOfTriangle nearest_on_edge(const std::array<Vec3, 3>& corners, int from, const Vec3& p) {
    const int to = (from + 1) % 3;
    const Vec3 along = corners[to] - corners[from];
    const double square = along.squaredNorm();
    const double t =
        square > 0.0 ? std::clamp((p - corners[from]).dot(along) / square, 0.0, 1.0) : 0.0;
    Vec3 barycentric = Vec3::Zero();
    barycentric[from] = 1.0 - t;
    barycentric[to] = t;
    return {barycentric, (corners[from] + t * along - p).squaredNorm()};
}

}  // namespace

PointOfTriangle nearest_on_triangle(const std::array<Vec3, 3>& corners, const Vec3& p) {
    const Vec3 ab = corners[1] - corners[0], ac = corners[2] - corners[0], ap = p - corners[0];
    const Vec3 normal = ab.cross(ac);
    const double square = normal.squaredNorm();
    if (square > kFlat * kFlat * ab.squaredNorm() * ac.squaredNorm()) {
        const double b = ap.cross(ac).dot(normal) / square, c = ab.cross(ap).dot(normal) / square;
        if (b >= 0.0 && c >= 0.0 && b + c <= 1.0) {
            const Vec3 foot = corners[0] + b * ab + c * ac;
            return {{1.0 - b - c, b, c}, (foot - p).squaredNorm()};
        }
    }
    PointOfTriangle best = nearest_on_edge(corners, 0, p);
    for (const int from : {1, 2}) {
        const PointOfTriangle other = nearest_on_edge(corners, from, p);
        if (other.squared_distance < best.squared_distance) best = other;
    }
    return best;
}

}  // namespace lissom
