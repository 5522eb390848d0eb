#include "viewer/render/draw/quick_vertices.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "kernel/mesh/measure/angle.h"

namespace lissom {
namespace {

using Point = std::array<float, 3>;

// Corners of a triangle as they are drawn: a mirrored one goes round the other way.
std::array<int, 3> drawn_corners(bool mirrored) {
    return mirrored ? std::array{0, 2, 1} : std::array{0, 1, 2};
}

// Groups at each vertex, chained.
class GroupChains {
  public:
    explicit GroupChains(Index vertices) : first_(vertices, kNoIndex) {}

    Index find_or_add(Index vertex, const Point& normal) {
        for (Index g = first_[vertex]; g != kNoIndex; g = next_[g]) {
            if (normal_[g] == normal) return g;
        }
        next_.push_back(first_[vertex]);
        normal_.push_back(normal);
        first_[vertex] = count_of(next_) - 1;
        return first_[vertex];
    }
    Index count() const { return count_of(next_); }

  private:
    std::vector<Index> first_, next_;
    std::vector<Point> normal_;
};

std::vector<Eigen::Vector3f> float_positions(const Mesh& mesh, const Affine& to_picture) {
    std::vector<Eigen::Vector3f> result;
    result.reserve(mesh.positions().size());
    for (const Vec3& p : mesh.positions()) result.push_back(to_picture(p).cast<float>());
    return result;
}

// The normal of a triangle, weighted by each of its angles.
std::array<Eigen::Vector3f, 3> weighted_normals(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                                const Eigen::Vector3f& c) {
    const Eigen::Vector3f ab = b - a, bc = c - b, ca = a - c, area = ab.cross(bc);
    const float size = area.norm();
    if (!(size > 0.0f))
        return {Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
    const Eigen::Vector3f normal = area / size;
    const float at_a = half_plane_angle(size, -ab.dot(ca)),
                at_b = half_plane_angle(size, -bc.dot(ab));
    return {at_a * normal, at_b * normal, (float(kPi) - at_a - at_b) * normal};
}

Point parts(const Eigen::Vector3f& v) {
    return {v.x(), v.y(), v.z()};
}

// Unit vectors, and zero as zero.
std::uint32_t packed_normal(const Eigen::Vector3f& sum) {
    constexpr float kOne = 511.0f;
    constexpr std::uint32_t kTenBits = 0x3ff;
    const float length = sum.norm();
    const Eigen::Vector3f n = length > 0.0f ? Eigen::Vector3f(kOne / length * sum) : sum;
    const auto part = [&](int axis) {
        // Rounded: the shift keeps the removed part positive.
        constexpr float kShift = 1024.5f;
        const int value = static_cast<int>(n[axis] + kShift) - 1024;
        return static_cast<std::uint32_t>(value) & kTenBits;
    };
    return part(0) | part(1) << 10 | part(2) << 20;
}

}  // namespace

NormalGroups normal_groups(const SurfaceTriangles& triangles,
                           std::span<const SurfaceVertex> vertices, Shading shading) {
    const Triangulation& faces = *triangles.faces;
    NormalGroups groups{std::vector<Index>(vertices.size()), 0};
    if (shading == Shading::flat) {
        for (std::size_t e = 0; e < vertices.size(); ++e) groups.of_entry[e] = faces.face[e / 3];
        groups.count =
            faces.face.empty() ? 0 : 1 + *std::max_element(faces.face.begin(), faces.face.end());
        return groups;
    }
    Index most = 0;
    for (const Triangle& t : faces.triangles) most = std::max({most, t[0], t[1], t[2]});
    GroupChains chains(most + 1);
    const std::array<int, 3> order = drawn_corners(triangles.mirrored);
    for (std::size_t e = 0; e < vertices.size(); ++e) {
        const Index v = faces.triangles[index_of(e / 3)][order[e % 3]];
        groups.of_entry[e] = chains.find_or_add(v, vertices[e].normal);
    }
    groups.count = chains.count();
    return groups;
}

void quick_surface_vertices(const Mesh& mesh, const Affine& to_picture,
                            const SurfaceTriangles& triangles, const NormalGroups& groups,
                            std::vector<QuickVertex>& result) {
    const std::vector<Triangle>& list = triangles.faces->triangles;
    const std::vector<Eigen::Vector3f> points = float_positions(mesh, to_picture);
    const std::array<int, 3> order = drawn_corners(triangles.mirrored);
    std::vector<Eigen::Vector3f> sums(at(groups.count), Eigen::Vector3f::Zero());
    for (std::size_t t = 0; t < list.size(); ++t) {
        const Eigen::Vector3f &a = points[list[t][order[0]]], &b = points[list[t][order[1]]],
                              &c = points[list[t][order[2]]];
        const std::array<Eigen::Vector3f, 3> weighted = weighted_normals(a, b, c);
        for (std::size_t i = 0; i < 3; ++i) sums[groups.of_entry[3 * t + i]] += weighted[i];
    }
    std::vector<std::uint32_t> normals;
    normals.reserve(sums.size());
    for (const Eigen::Vector3f& sum : sums) normals.push_back(packed_normal(sum));
    result.resize(3 * list.size());
    QuickVertex* next = result.data();
    const Index* group = groups.of_entry.data();
    for (const Triangle& t : list) {
        for (const int corner : order) {
            *next++ = {parts(points[at(t[corner])]), normals[at(*group++)]};
        }
    }
}

}  // namespace lissom
