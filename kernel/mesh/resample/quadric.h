/// Quadric: a sum of weighted squared distances to planes (Garland and Heckbert 1997). Private to
/// kernel/mesh.
#pragma once

#include <Eigen/Core>

#include "kernel/core/geometry.h"

namespace lissom {

/// The value at p is p' A p + 2 b' p + c.
struct Quadric {
    Mat3 a = Mat3::Zero();
    Vec3 b = Vec3::Zero();
    double c = 0.0;
    /// Sum of the weights.
    double weight = 0.0;

    /// Adds the squared distance to the plane through `point` with the unit normal `normal`.
    void add_plane(const Vec3& normal, const Vec3& point, double w) {
        const double d = -normal.dot(point);
        a += w * normal * normal.transpose();
        b += w * d * normal;
        c += w * d * d;
        weight += w;
    }

    Quadric& operator+=(const Quadric& other) {
        a += other.a;
        b += other.b;
        c += other.c;
        weight += other.weight;
        return *this;
    }

    double at(const Vec3& p) const { return p.dot(a * p) + 2.0 * b.dot(p) + c; }
};

}  // namespace lissom
