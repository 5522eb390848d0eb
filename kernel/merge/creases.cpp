#include "kernel/merge/creases.h"

#include <algorithm>

#include "kernel/merge/loop/face_angles.h"

namespace lissom {
namespace {

// An edge that the surface turns at by more than this is a crease.
constexpr double kCreaseTurn = 30.0 * kDegree;
// Beside a crease that runs into a boundary of a clean shape edges turn by less than this: it ends
// at a corner of the outline. On scans and sculptures smoothing the seam may move its end.
constexpr double kCleanTurn = 3.0 * kDegree;
// Sewing divides polygons and flips edges: it makes neighbours of the seam of vertices that are
// this many rings of faces away, and smoothing moves those.
constexpr int kNearRings = 2;
// Faces that turn by less are those of one flat face of a shape: files of CAD models have six
// digits.
constexpr double kFlatTurn = 0.05 * kDegree;

// The sums of the area vectors of the faces around both ends of the edge from a to b on its left
// and on its right, seen along it.
struct EdgeSides {
    Vec3 left = Vec3::Zero(), right = Vec3::Zero();
};

EdgeSides edge_sides(const Mesh& mesh, Index a, Index b) {
    const Vec3 &from = mesh.position(a), along = (mesh.position(b) - from).normalized();
    const Index left = face_left_of(mesh.topology(), a, b);
    const Index right = face_left_of(mesh.topology(), b, a);
    const auto seen = [&](const Vec3& v) { return Vec3(v - v.dot(along) * along); };
    const auto middle = [&](Index f) {
        Vec3 sum = Vec3::Zero();
        for (const Index v : mesh.topology().face(f)) sum += mesh.position(v) - from;
        return sum;
    };
    // Out of the edge into the face on its left.
    const Vec3 across = seen(middle(left)).normalized() - seen(middle(right)).normalized();
    EdgeSides sides;
    for (const Index end : {a, b}) {
        for (const Index f : mesh.topology().faces_around(end)) {
            const Vec3 area = seen(area_vector(mesh, f));
            (middle(f).dot(across) >= 0.0 ? sides.left : sides.right) += area;
        }
    }
    return sides;
}

bool is_creased(const Mesh& mesh, Index a, Index b) {
    if (!(edge_dihedral(mesh, a, b) > kCreaseTurn)) return false;
    const EdgeSides sides = edge_sides(mesh, a, b);
    return angle_between(sides.left, sides.right) > kCreaseTurn;
}

// Whether all edges at both ends of one are creases or hardly turn.
bool is_clean(const Mesh& mesh, Index a, Index b) {
    for (const Index end : {a, b}) {
        for (const Index w : mesh.topology().neighbors(end)) {
            const double turn = edge_dihedral(mesh, end, w);
            if (turn > kCleanTurn && turn <= kCreaseTurn) return false;
        }
    }
    return true;
}

bool ends_crease(const Mesh& mesh, Index v) {
    const bool on_boundary = mesh.topology().is_boundary(v);
    const std::span<const Index> ring = mesh.topology().neighbors(v);
    return std::any_of(ring.begin(), ring.end(), [&](Index w) {
        return is_creased(mesh, v, w) && (!on_boundary || is_clean(mesh, v, w));
    });
}

bool lies_flat(const Mesh& mesh, Index v) {
    Vec3 first = Vec3::Zero();
    for (const Index f : mesh.topology().faces_around(v)) {
        const Vec3 normal = clear_area_vector(mesh, f);
        if (!(normal.squaredNorm() > 0.0)) continue;
        if (first.squaredNorm() > 0.0 && angle_between(first, normal) > kFlatTurn) return false;
        if (!(first.squaredNorm() > 0.0)) first = normal;
    }
    return first.squaredNorm() > 0.0;
}

}  // namespace

std::vector<Index> flat_vertices(const Mesh& mesh) {
    std::vector<Index> result;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (lies_flat(mesh, v)) result.push_back(v);
    }
    return result;
}

std::vector<Index> creased_vertices(const Mesh& mesh, std::span<const Index> asked) {
    std::vector<Index> result;
    for (const Index v : asked) {
        if (ends_crease(mesh, v)) result.push_back(v);
    }
    std::sort(result.begin(), result.end());
    return result;
}

namespace {

void add_faces_around(const Mesh& mesh, std::vector<Index>& vertices) {
    for (std::size_t k = 0, count = vertices.size(); k < count; ++k) {
        for (const Index f : mesh.topology().faces_around(vertices[k])) {
            const std::span<const Index> face = mesh.topology().face(f);
            vertices.insert(vertices.end(), face.begin(), face.end());
        }
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

}  // namespace

std::vector<Index> vertices_near(const Mesh& mesh, std::span<const std::vector<Index>> loops) {
    std::vector<Index> near;
    for (const std::vector<Index>& loop : loops) {
        for (const Index v : loop) {
            near.push_back(v);
        }
    }
    for (int ring = 0; ring < kNearRings; ++ring) add_faces_around(mesh, near);
    return near;
}

}  // namespace lissom
