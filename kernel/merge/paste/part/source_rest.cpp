#include "kernel/merge/paste/part/source_rest.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <vector>

#include "kernel/merge/loop/band_quality.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/paste/part/target_bite.h"

namespace lissom {
namespace {

// Width of the strips, as for the planes beside a seam (band_quality.cpp).
constexpr double kRestStrip = 1.0 / 3.0;
constexpr std::size_t kRestPlanes = 48;

std::vector<Vec3> rim_points(const PastePart& part) {
    std::vector<Vec3> points;
    for (const Index v : part.loop) points.push_back(part.mesh.position(v));
    return points;
}

// The faces around the vertices that the loop's vertices were made of.
std::vector<Index> faces_at_loop(const Mesh& source, const PastePart& part) {
    std::set<Index> faces;
    for (const Index v : part.loop) {
        for (const ElementMap::Source& from : part.map.vertices[v]) {
            for (const Index f : source.topology().faces_around(from.element)) faces.insert(f);
        }
    }
    return {faces.begin(), faces.end()};
}

// A face near the loop: its place, along its normal, and whether it belongs to the part.
struct RestFace {
    Vec3 center = Vec3::Zero(), area = Vec3::Zero();
    bool inside = false;
};

std::vector<RestFace> faces_near(const Mesh& source, const PastePart& part, const Vec3& middle,
                                 double reach) {
    std::vector<char> inside(at(source.face_count()), 0);
    for (Index f = 0; f < part.mesh.face_count(); ++f) {
        for (const ElementMap::Source& from : part.map.faces[f]) inside[at(from.element)] = 1;
    }
    std::vector<RestFace> near;
    for (Index f = 0; f < source.face_count(); ++f) {
        const std::span<const Index> face = source.topology().face(f);
        Vec3 center = Vec3::Zero();
        for (const Index v : face) center += source.position(v);
        center /= static_cast<double>(face.size());
        if ((center - middle).norm() > reach) continue;
        near.push_back({center, area_vector(source, f), inside[at(f)] != 0});
    }
    return near;
}

void measure_bend(std::span<const Vec3> rim, std::span<const RestFace> faces, double strip,
                  SourceRest& rest) {
    double squares = 0.0, count = 0.0;
    const std::size_t step = std::max<std::size_t>(1, rim.size() / kRestPlanes);
    for (std::size_t k = 0; k < rim.size(); k += step) {
        Vec3 within = Vec3::Zero(), beyond = Vec3::Zero();
        for (const RestFace& face : faces) {
            if ((face.center - rim[k]).norm() > strip) continue;
            (face.inside ? within : beyond) += face.area;
        }
        if (!(within.squaredNorm() > 0.0 && beyond.squaredNorm() > 0.0)) continue;
        const double angle = angle_between(within, beyond);
        rest.max_bend = std::max(rest.max_bend, angle);
        squares += angle * angle;
        count += 1.0;
    }
    if (count > 0.0) rest.bend = std::sqrt(squares / count);
}

// Area vector of the polygon that a rim is, counter-clockwise: along its axis.
Vec3 rim_axis(std::span<const Vec3> rim, const Vec3& middle) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < rim.size(); ++k) {
        sum += (rim[k] - middle).cross(rim[(k + 1) % rim.size()] - middle);
    }
    return sum;
}

// The volume of a cap of a sphere over a circle that the surface around it is as steep as.
double dome_volume(std::span<const Vec3> rim, std::span<const RestFace> faces, const Vec3& middle,
                   double radius) {
    const Vec3 axis = rim_axis(rim, middle);
    double slope = 0.0, area = 0.0;
    for (const RestFace& face : faces) {
        if (face.inside) continue;
        slope += face.area.norm() * angle_between(face.area, axis);
        area += face.area.norm();
    }
    if (!(area > 0.0)) return 0.0;
    const double height = radius * std::tan(std::min(0.5 * slope / area, 0.25 * kPi));
    return kPi * height * (3.0 * radius * radius + height * height) / 6.0;
}

}  // namespace

SourceRest source_rest(const Mesh& source, const PastePart& part, const Context& context) {
    context.checkpoint();
    SourceRest rest;
    const std::vector<Index> at_loop = faces_at_loop(source, part);
    rest.steep = steep_dihedral(source, at_loop);
    rest.roughness = rms_dihedral(source, at_loop);
    const std::vector<Vec3> rim = rim_points(part);
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : rim) middle += p / static_cast<double>(rim.size());
    double radius = 0.0, farthest = 0.0;
    for (const Vec3& p : rim) {
        radius += (p - middle).norm() / static_cast<double>(rim.size());
        farthest = std::max(farthest, (p - middle).norm());
    }
    const double strip = kRestStrip * radius;
    const std::vector<RestFace> near = faces_near(source, part, middle, farthest + strip);
    measure_bend(rim, near, strip, rest);
    // Below 0 if the source is inside out, or the part a pit.
    const double volume = std::abs(volume_over(part.mesh, part.loop));
    if (volume > 0.0) rest.dome = dome_volume(rim, near, middle, radius) / volume;
    return rest;
}

}  // namespace lissom
