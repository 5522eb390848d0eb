#include "kernel/deform/patch/operators.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kernel/core/roots.h"

namespace lissom {
namespace {

// Height of a triangle, in its longest edge, below which its normal counts for less and less.
constexpr double kNeedle = 1e-6;

// Angles, cotangents and area of one triangle, clamped.
struct TriangleShape {
    double cotangent[3], angle[3];
    double area = 0.0;
    double edge_squared[3];  // opposite each corner
    // Unit, but shorter for a needle, whose direction is that of rounding errors.
    Vec3 normal = Vec3::Zero();

    TriangleShape(const Vec3& a, const Vec3& b, const Vec3& c, double smallest_angle) {
        const Vec3 e[3] = {c - b, a - c, b - a};
        const Vec3 cross = e[2].cross(-e[1]);
        const double twice_area = cross.norm();
        double longest = 0.0;
        for (int k = 0; k < 3; ++k) {
            edge_squared[k] = e[k].squaredNorm();
            longest = std::max(longest, edge_squared[k]);
        }
        if (twice_area > 0.0) normal = cross / hypotenuse(twice_area, kNeedle * longest);
        area = 0.5 * std::max(twice_area, std::sin(smallest_angle) * longest);
        for (int k = 0; k < 3; ++k) {
            const double dot = -e[(k + 1) % 3].dot(e[(k + 2) % 3]);
            angle[k] =
                std::clamp(std::atan2(twice_area, dot), smallest_angle, kPi - smallest_angle);
            cotangent[k] = std::cos(angle[k]) / std::sin(angle[k]);
        }
    }

    // Share of the area that is nearest to corner k, or Meyer's safe share in an obtuse triangle.
    double corner_area(int k) const {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        if (angle[k] > 0.5 * kPi) return 0.5 * area;
        if (angle[i] > 0.5 * kPi || angle[j] > 0.5 * kPi) return 0.25 * area;
        const double share =
            (edge_squared[i] * cotangent[i] + edge_squared[j] * cotangent[j]) / 8.0;
        return std::max(share, 0.1 * area);
    }
};

}  // namespace

RingGeometry ring_geometry(const Rings& rings, const WeightedTriangles& triangles,
                           std::span<const Vec3> positions, double smallest_angle) {
    RingGeometry geometry;
    geometry.cotangent.assign(rings.neighbor.size(), 0.0);
    geometry.area.assign(rings.size(), 0.0);
    geometry.normal.assign(rings.size(), Vec3::Zero());
    for (std::size_t n = 0; n < triangles.size(); ++n) {
        const Triangle& t = triangles.triangle[n];
        const double weight = triangles.weight[n];
        const TriangleShape shape(positions[t[0]], positions[t[1]], positions[t[2]],
                                  smallest_angle);
        for (int k = 0; k < 3; ++k) {
            const Index i = t[(k + 1) % 3], j = t[(k + 2) % 3];
            geometry.cotangent[rings.entry(i, j)] += 0.5 * weight * shape.cotangent[k];
            geometry.cotangent[rings.entry(j, i)] += 0.5 * weight * shape.cotangent[k];
            geometry.area[t[k]] += weight * shape.corner_area(k);
            geometry.normal[t[k]] += weight * shape.angle[k] * shape.normal;
        }
    }
    for (Vec3& n : geometry.normal) {
        const double length = n.norm();
        if (length > 0.0) n /= length;
    }
    return geometry;
}

Vec3 Laplacian::apply(const Rings& rings, std::span<const Vec3> x, Index i) const {
    Vec3 sum = self[i] * x[i];
    for (Index e = rings.begin[i]; e < rings.begin[i + 1]; ++e) {
        sum += neighbor[e] * x[rings.neighbor[e]];
    }
    return sum;
}

Laplacian make_laplacian(const Rings& rings, const RingGeometry& geometry, LaplacianWeights weights,
                         bool scale_free) {
    Laplacian laplacian;
    laplacian.self.assign(rings.size(), 0.0);
    laplacian.neighbor.assign(rings.neighbor.size(), 0.0);
    laplacian.weight.assign(rings.size(), 0.0);
    const bool uniform = weights == LaplacianWeights::uniform;
    for (Index i = 0; i < rings.size(); ++i) {
        if (rings.count(i) == 0 || !(geometry.area[i] > 0.0)) continue;
        for (Index e = rings.begin[i]; e < rings.begin[i + 1]; ++e) {
            const double literal = scale_free ? 1.0 : 2.0;
            laplacian.neighbor[e] =
                uniform ? 1.0 / rings.count(i) : literal * geometry.cotangent[e] / geometry.area[i];
            laplacian.self[i] -= laplacian.neighbor[e];
        }
        laplacian.weight[i] = !scale_free ? 1.0
                              : uniform   ? 1.0 / geometry.area[i]
                                          : geometry.area[i];
    }
    return laplacian;
}

double surface_radius_of(const WeightedTriangles& triangles, std::span<const Vec3> positions) {
    double area = 0.0, second_moment = 0.0;
    Vec3 first_moment = Vec3::Zero();
    for (std::size_t n = 0; n < triangles.size(); ++n) {
        const Triangle& t = triangles.triangle[n];
        const Vec3 &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
        const double weight = 0.5 * triangles.weight[n] * (b - a).cross(c - a).norm();
        const Vec3 sum = a + b + c;
        area += weight;
        first_moment += weight * sum / 3.0;
        second_moment += weight *
                         (sum.squaredNorm() + a.squaredNorm() + b.squaredNorm() + c.squaredNorm()) /
                         12.0;
    }
    if (!(area > 0.0)) return 0.0;
    return std::sqrt(std::max(0.0, second_moment / area - (first_moment / area).squaredNorm()));
}

double mean_edge_length_of(const Rings& rings, std::span<const Vec3> positions) {
    double sum = 0.0;
    for (Index i = 0; i < rings.size(); ++i) {
        for (const Index j : rings.ring(i)) sum += (positions[i] - positions[j]).norm();
    }
    return rings.neighbor.empty() ? 0.0 : sum / rings.neighbor.size();
}

}  // namespace lissom
