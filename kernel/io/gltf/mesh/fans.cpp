#include "kernel/io/gltf/mesh/fans.h"

#include <Eigen/Geometry>

#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

// Twice the area of a polygon as a vector.
Vec3 area_vector(const std::vector<Vec3>& points) {
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        area += (points[i] - points[0]).cross(points[i + 1] - points[0]);
    }
    return area;
}

// True if all triangles from corner `start` face the way the polygon does.
bool is_fan(const std::vector<Vec3>& points, std::size_t start, const Vec3& area) {
    const std::size_t n = points.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const Vec3 a = points[(start + i) % n] - points[start];
        const Vec3 b = points[(start + i + 1) % n] - points[start];
        if (!(a.cross(b).dot(area) > 0.0)) return false;
    }
    return true;
}

}  // namespace

void FanWriter::add_fan(const std::vector<Index>& vertices, std::size_t start) {
    const std::size_t n = vertices.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
        corners_.push_back(vertices[start]);
        corners_.push_back(vertices[(start + i) % n]);
        corners_.push_back(vertices[(start + i + 1) % n]);
    }
    last_first_ = vertices[start];
}

FanWriter::Added FanWriter::add(const std::vector<Index>& vertices,
                                const std::vector<Vec3>& points) {
    const std::size_t n = vertices.size();
    if (n == 3 && !has_polygons_) {
        add_fan(vertices, 0);
        return {};
    }
    const Vec3 area = area_vector(points);
    for (std::size_t start = 0; start < n; ++start) {
        if (vertices[start] == last_first_) continue;
        if (n > 3 && !is_fan(points, start, area)) continue;
        add_fan(vertices, start);
        return {1, index_of((n - start) % n)};
    }
    std::vector<Triangle> triangles;
    triangulate_polygon(points, triangles);
    Index first = kNoIndex;
    for (const Triangle& t : triangles) {
        const std::vector<Index> corners{vertices[t[0]], vertices[t[1]], vertices[t[2]]};
        const std::size_t start = corners[0] == last_first_ ? 1 : 0;
        if (first == kNoIndex) first = t[start];
        add_fan(corners, start);
    }
    return {count_of(triangles), (index_of(n) - first) % index_of(n)};
}

}  // namespace lissom
