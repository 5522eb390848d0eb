#include "kernel/merge/loop/rim_flare.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/merge/loop/face_angles.h"

namespace lissom {
namespace {

// Strips within one radius of a seam, and points of it at which they are looked at, at most.
constexpr double kFlareStrips = 6.0;
constexpr std::size_t kFlarePoints = 48;
// Part of a radius by which a strip at a point is wider than it is far away.
constexpr double kFlareSlack = 0.08;

// A face as it is and as it was: its middle, and its normal with the area that it has now.
struct RimFace {
    Vec3 middle[2], area[2];
};

using Strips = std::vector<std::vector<RimFace>>;

Vec3 face_middle(const Mesh& mesh, Index f) {
    Vec3 sum = Vec3::Zero();
    for (const Index v : mesh.topology().face(f)) sum += mesh.position(v);
    return sum / static_cast<double>(mesh.topology().face(f).size());
}

// The face as it was, between the vertices that its own come from; nothing if it had no area.
bool put_rest(const Mesh& made, Index f, const Mesh& rest, std::span<const Index> origin,
              RimFace& face) {
    const std::span<const Index> vertices = made.topology().face(f);
    Vec3 sum = Vec3::Zero(), area = Vec3::Zero();
    for (const Index v : vertices) {
        if (origin[at(v)] == kNoIndex) return false;
        sum += rest.position(origin[at(v)]);
    }
    const Vec3& first = rest.position(origin[at(vertices[0])]);
    for (std::size_t k = 1; k + 1 < vertices.size(); ++k) {
        area += (rest.position(origin[at(vertices[k])]) - first)
                    .cross(rest.position(origin[at(vertices[k + 1])]) - first);
    }
    if (!(area.norm() > 0.0)) return false;
    face.middle[1] = sum / static_cast<double>(vertices.size());
    face.area[1] = area.normalized() * face.area[0].norm();
    return true;
}

double distance_of(const MadeRim& made, Index f) {
    double sum = 0.0;
    for (const Index v : made.mesh.topology().face(f)) sum += made.distance[at(v)];
    return sum / static_cast<double>(made.mesh.topology().face(f).size());
}

// Number of strips wider than the root of most faces' area, of the surface as a whole and not of
// its smallest faces: the faces of a narrower strip have few directions.
std::size_t strip_count(const MadeRim& made) {
    double sum = 0.0, squares = 0.0;
    for (const Index f : made.faces) {
        if (!(distance_of(made, f) < made.radius)) continue;
        const double area = 0.5 * area_vector(made.mesh, f).norm();
        sum += area;
        squares += area * area;
    }
    const double width = sum > 0.0 ? std::sqrt(squares / sum) : made.radius;
    return static_cast<std::size_t>(std::min(kFlareStrips, made.radius / width));
}

Strips strips_of(const MadeRim& made, const Mesh& rest, std::span<const Index> origin) {
    Strips strips(strip_count(made));
    for (const Index f : made.faces) {
        const double far = distance_of(made, f);
        if (!(far < made.radius) || strips.empty()) continue;
        RimFace face{{face_middle(made.mesh, f), Vec3::Zero()},
                     {area_vector(made.mesh, f), Vec3::Zero()}};
        if (!put_rest(made.mesh, f, rest, origin, face)) continue;
        const double count = static_cast<double>(strips.size());
        const std::size_t strip = static_cast<std::size_t>(count * far / made.radius);
        strips[std::min(strip, strips.size() - 1)].push_back(face);
    }
    return strips;
}

// The part of a strip near a point of the seam.
struct StripPatch {
    Vec3 middle[2] = {Vec3::Zero(), Vec3::Zero()}, normal[2] = {Vec3::Zero(), Vec3::Zero()};
    double area = 0.0;

    void add(const RimFace& face) {
        const double weight = face.area[0].norm();
        for (const std::size_t k : {0, 1}) {
            middle[k] += weight * face.middle[k];
            normal[k] += face.area[k];
        }
        area += weight;
    }
    bool has_normals() const {
        return area > 0.0 && normal[0].norm() > 0.0 && normal[1].norm() > 0.0;
    }
};

StripPatch patch_near(const std::vector<RimFace>& strip, const Vec3& point, double reach) {
    StripPatch patch;
    for (const RimFace& face : strip) {
        if ((face.middle[0] - point).norm() <= reach) patch.add(face);
    }
    return patch;
}

// Above 0 if the surface stands out between both, now or at rest.
double outward_turn(const StripPatch& a, const StripPatch& b, std::size_t when) {
    const Vec3 apart = b.middle[when] / b.area - a.middle[when] / a.area;
    const double turn = angle_between(a.normal[when], b.normal[when]);
    const Vec3 change = b.normal[when].normalized() - a.normal[when].normalized();
    return change.dot(apart) >= 0.0 ? turn : -turn;
}

double greatest_gain(const Strips& strips, const Vec3& point, double radius, double outward) {
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

double rim_flare(const MadeRim& made, const Mesh& rest, std::span<const Index> origin,
                 bool inside_out) {
    if (!(made.radius > 0.0)) return 0.0;
    const Strips strips = strips_of(made, rest, origin);
    const std::size_t step = std::max<std::size_t>(1, made.loop.size() / kFlarePoints);
    double squares = 0.0, count = 0.0;
    for (std::size_t k = 0; k < made.loop.size(); k += step) {
        const double gain = greatest_gain(strips, made.mesh.position(made.loop[k]), made.radius,
                                          inside_out ? -1.0 : 1.0);
        squares += gain * gain;
        count += 1.0;
    }
    return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

}  // namespace lissom
