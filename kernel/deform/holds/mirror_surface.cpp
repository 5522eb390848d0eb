#include "kernel/deform/holds/mirror_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace lissom {
namespace {

double square_to_box(const Box& box, const Vec3& p) {
    return (p - p.cwiseMax(box.min).cwiseMin(box.max)).squaredNorm();
}

struct MirrorCandidate {
    Vec3 barycentric = Vec3::Zero();
    double square = std::numeric_limits<double>::infinity();
};

MirrorCandidate nearest_on_side(const std::array<Vec3, 3>& corners, int from, const Vec3& p) {
    const int to = (from + 1) % 3;
    const Vec3 along = corners[at(to)] - corners[at(from)];
    const double length = along.squaredNorm();
    const double t =
        length > 0.0 ? std::clamp((p - corners[at(from)]).dot(along) / length, 0.0, 1.0) : 0.0;
    MirrorCandidate result;
    result.barycentric[from] = 1.0 - t;
    result.barycentric[to] = t;
    result.square = (corners[at(from)] + t * along - p).squaredNorm();
    return result;
}

// The foot of the perpendicular if it lies inside, else the nearest point of a side.
MirrorCandidate nearest_in(const std::array<Vec3, 3>& corners, const Vec3& p) {
    const Vec3 ab = corners[1] - corners[0], ac = corners[2] - corners[0], ap = p - corners[0];
    const Vec3 normal = ab.cross(ac);
    const double square = normal.squaredNorm();
    if (square > 1e-24 * ab.squaredNorm() * ac.squaredNorm()) {
        const double b = ap.cross(ac).dot(normal) / square, c = ab.cross(ap).dot(normal) / square;
        if (b >= 0.0 && c >= 0.0 && b + c <= 1.0) {
            const Vec3 foot = corners[0] + b * ab + c * ac;
            return {{1.0 - b - c, b, c}, (foot - p).squaredNorm()};
        }
    }
    MirrorCandidate best;
    for (const int from : {0, 1, 2}) {
        const MirrorCandidate other = nearest_on_side(corners, from, p);
        if (other.square < best.square) best = other;
    }
    return best;
}

}  // namespace

MirrorSurface::MirrorSurface(const Patch& patch, const Affine& mirror)
    : patch_(patch),
      mirror_(mirror),
      triangles_(patch.triangles.triangle),
      normals_(patch.rest.size(), Vec3::Zero()) {
    std::vector<Box> boxes;
    for (const Triangle& t : triangles_) {
        const Vec3 normal = area_normal(t);
        Box box;
        for (const Index v : t) {
            normals_[at(v)] += normal;
            box.extend(patch_.rest[at(v)]);
        }
        boxes.push_back(box);
    }
    boxes_ = BoxTree(boxes);
}

Vec3 MirrorSurface::area_normal(const Triangle& t) const {
    const Vec3& a = patch_.rest[at(t[0])];
    return (patch_.rest[at(t[1])] - a).cross(patch_.rest[at(t[2])] - a);
}

// Without corners if no triangle looks along `facing`; zero is along all of them. The first of
// equally near triangles is taken.
MirrorFoot MirrorSurface::nearest(const Vec3& point, const Vec3& facing) const {
    MirrorFoot best;
    double least = std::numeric_limits<double>::infinity();
    Index number = kNoIndex;
    const auto enter = [&](const Box& box) { return square_to_box(box, point) <= least; };
    boxes_.visit(enter, [&](Index item) {
        const Triangle& t = triangles_[at(item)];
        if (area_normal(t).dot(facing) < 0.0) return;
        const auto found = nearest_in(
            {patch_.rest[at(t[0])], patch_.rest[at(t[1])], patch_.rest[at(t[2])]}, point);
        if (found.square > least || (found.square == least && item > number)) return;
        best = {t, found.barycentric, std::sqrt(found.square)};
        least = found.square;
        number = item;
    });
    return best;
}

MirrorFoot MirrorSurface::foot_of(Index vertex) const {
    const Vec3 image = mirror_(patch_.rest[at(vertex)]);
    const MirrorFoot facing = nearest(image, mirror_.linear * normals_[at(vertex)]);
    return facing.corners[0] != kNoIndex ? facing : nearest(image, Vec3::Zero());
}

MirrorFoot MirrorSurface::foot_of(const Vec3& point) const {
    return nearest(mirror_(point), Vec3::Zero());
}

// Vertices of the region whose own mirror image lies on the `given` part: within a triangle the
// part that is nearer to its given corners. Only those no farther from it than `farthest` are
// looked at.
std::vector<Index> MirrorSurface::around(std::span<const Index> vertices,
                                         const std::vector<char>& given, double farthest) const {
    Box box;
    for (const Index v : vertices) box.extend(patch_.rest[at(v)]);
    box.min -= Vec3::Constant(farthest);
    box.max += Vec3::Constant(farthest);
    std::vector<Index> result;
    for (const Index w : patch_.of_region) {
        if (!box.contains(mirror_(patch_.rest[at(w)]))) continue;
        const MirrorFoot foot = foot_of(w);
        double share = 0.0;
        for (int i = 0; i < 3; ++i) {
            const Index corner = foot.corners[at(i)];
            if (corner != kNoIndex && given[at(corner)]) share += foot.barycentric[i];
        }
        if (share >= 0.5 && foot.distance <= farthest) result.push_back(w);
    }
    return result;
}

MirroredVertices MirrorSurface::mirrored(std::span<const Index> vertices) const {
    MirroredVertices result;
    std::vector<char> given(patch_.rest.size(), 0), found(patch_.rest.size(), 0);
    double greatest = 0.0;
    for (const Index v : vertices) {
        given[at(v)] = 1;
        const MirrorFoot foot = foot_of(v);
        result.distances.push_back(foot.distance);
        greatest = std::max(greatest, foot.distance);
        int corner = 0;
        foot.barycentric.maxCoeff(&corner);
        const Index image = foot.corners[at(corner)];
        const bool is_inside = image != kNoIndex && patch_.in_region[at(image)];
        if (is_inside) found[at(image)] = 1;
        if (!is_inside) result.outside.push_back(v);
    }
    double longest = 0.0;
    for (const Triangle& t : triangles_) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (!given[at(t[i])] && !given[at(t[(i + 1) % 3])]) continue;
            longest =
                std::max(longest, (patch_.rest[at(t[i])] - patch_.rest[at(t[(i + 1) % 3])]).norm());
        }
    }
    for (const Index w : around(vertices, given, 2.0 * greatest + 0.5 * longest)) found[at(w)] = 1;
    for (const Index w : patch_.of_region) {
        if (found[at(w)]) result.vertices.push_back(w);
    }
    std::sort(result.vertices.begin(), result.vertices.end());
    return result;
}

}  // namespace lissom
