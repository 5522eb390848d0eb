#include "kernel/merge/loop/rim_flare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "kernel/merge/loop/face_angles.h"

namespace lissom {
namespace {

// Strips within one radius of a seam, and points of it at which they are looked at, at most.
constexpr double kFlareStrips = 6.0;
constexpr std::size_t kFlarePoints = 48;
// Part of a radius by which a strip at a point is wider than it is far away.
constexpr double kFlareSlack = 0.08;
// Part of a long face's reach that a strip is wide at least: those of faces as long as wide are as
// wide as the root of their area.
constexpr double kFlareReach = 0.65;

// The middle of a face, and its normal with its area as length.
struct RimFace {
    Vec3 middle = Vec3::Zero(), area = Vec3::Zero();
};

// A face as it is, and as it was.
using RimFaces = std::array<RimFace, 2>;
using Strips = std::vector<std::vector<RimFaces>>;

RimFace rim_face(std::span<const Index> vertices, std::span<const Vec3> positions) {
    RimFace face;
    const Vec3& first = positions[at(vertices[0])];
    for (const Index v : vertices) face.middle += positions[at(v)];
    face.middle /= static_cast<double>(vertices.size());
    for (std::size_t k = 1; k + 1 < vertices.size(); ++k) {
        face.area +=
            0.5 *
            (positions[at(vertices[k])] - first).cross(positions[at(vertices[k + 1])] - first);
    }
    return face;
}

double distance_of(const MadeRim& made, Index f) {
    double sum = 0.0;
    for (const Index v : made.mesh.topology().face(f)) sum += made.distance[at(v)];
    return sum / static_cast<double>(made.mesh.topology().face(f).size());
}

// Extent of a face across the strips.
double reach_across(const MadeRim& made, Index f) {
    double least = INFINITY, most = 0.0;
    for (const Index v : made.mesh.topology().face(f)) {
        least = std::min(least, made.distance[at(v)]);
        most = std::max(most, std::min(made.distance[at(v)], made.radius));
    }
    return most - least;
}

// Number of strips wider than the root of most faces' area and than their extent, of the surface as
// a whole and not of its smallest faces: the faces of a narrower strip have few directions.
std::size_t strip_count(const MadeRim& made) {
    double sum = 0.0, widths = 0.0;
    for (const Index f : made.faces) {
        if (!(distance_of(made, f) < made.radius)) continue;
        const double area = 0.5 * area_vector(made.mesh, f).norm();
        sum += area;
        widths += area * std::max(area, std::pow(kFlareReach * reach_across(made, f), 2.0));
    }
    const double width = sum > 0.0 ? std::sqrt(widths / sum) : made.radius;
    return static_cast<std::size_t>(std::min(kFlareStrips, made.radius / width));
}

Strips strips_of(const MadeRim& made, std::span<const Vec3> rest) {
    Strips strips(strip_count(made));
    for (const Index f : made.faces) {
        const double far = distance_of(made, f);
        if (!(far < made.radius) || strips.empty()) continue;
        const std::span<const Index> vertices = made.mesh.topology().face(f);
        const RimFaces face{rim_face(vertices, made.mesh.positions()), rim_face(vertices, rest)};
        if (!face[1].middle.allFinite()) continue;
        const double count = static_cast<double>(strips.size());
        const std::size_t strip = static_cast<std::size_t>(count * far / made.radius);
        strips[std::min(strip, strips.size() - 1)].push_back(face);
    }
    return strips;
}

// The part of a strip near a point of the seam, now and at rest.
struct StripPatch {
    RimFaces sum;
    double area[2] = {0.0, 0.0};

    void add(const RimFaces& face) {
        for (const std::size_t k : {0, 1}) {
            const double weight = face[k].area.norm();
            sum[k].middle += weight * face[k].middle;
            sum[k].area += face[k].area;
            area[k] += weight;
        }
    }
    bool has_normals() const {
        return sum[0].area.squaredNorm() > 0.0 && sum[1].area.squaredNorm() > 0.0;
    }
};

StripPatch patch_near(const std::vector<RimFaces>& strip, const Vec3& point, double reach) {
    StripPatch patch;
    for (const RimFaces& face : strip) {
        if ((face[0].middle - point).norm() <= reach) patch.add(face);
    }
    return patch;
}

// Above 0 if the surface stands out between both, now or at rest.
double outward_turn(const StripPatch& a, const StripPatch& b, std::size_t when) {
    const RimFace &first = a.sum[when], &second = b.sum[when];
    const Vec3 apart = second.middle / b.area[when] - first.middle / a.area[when];
    const double turn = angle_between(first.area, second.area);
    const Vec3 change = second.area.normalized() - first.area.normalized();
    return change.dot(apart) >= 0.0 ? turn : -turn;
}

double max_gain(const Strips& strips, const Vec3& point, double radius, double outward) {
    double greatest = 0.0;
    StripPatch before;
    for (std::size_t i = 0; i < strips.size(); ++i) {
        const double end = static_cast<double>(i + 1) / static_cast<double>(strips.size());
        const StripPatch patch = patch_near(strips[i], point, (end + kFlareSlack) * radius);
        if (before.has_normals() && patch.has_normals()) {
            const double gain = outward_turn(before, patch, 0) - outward_turn(before, patch, 1);
            greatest = std::max(greatest, outward * gain);
        }
        before = patch;
    }
    return greatest;
}

}  // namespace

double rim_flare(const MadeRim& made, std::span<const Vec3> rest, bool inside_out) {
    if (!(made.radius > 0.0)) return 0.0;
    const Strips strips = strips_of(made, rest);
    const std::size_t step = std::max<std::size_t>(1, made.loop.size() / kFlarePoints);
    double squares = 0.0, count = 0.0;
    for (std::size_t k = 0; k < made.loop.size(); k += step) {
        const double gain = max_gain(strips, made.mesh.position(made.loop[k]), made.radius,
                                     inside_out ? -1.0 : 1.0);
        squares += gain * gain;
        count += 1.0;
    }
    return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

}  // namespace lissom
