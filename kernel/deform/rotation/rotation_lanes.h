/// Small matrices and quaternions of plain numbers, for one rotation, or of lanes, for four at a
/// time: conditions are then answered lane by lane, and a branch that any lane needs is computed
/// for all. Private to kernel/deform. They are compiled twice, as kernel/core/lanes.h says.
#pragma once

#include <cmath>

#include "kernel/core/geometry.h"
#include "kernel/core/lanes.h"

namespace lissom::rotation_lanes {

LISSOM_INLINE void take_root(double& x) {
    x = std::sqrt(x);
}
/// Returns the value of one condition, or of several that were combined bit by bit.
LISSOM_INLINE bool is_any(bool condition) {
    return condition;
}
LISSOM_INLINE bool is_any(int condition) {
    return condition != 0;
}
/// Number `entry` of the matrix or vector at `from`, or of those of all lanes.
template <typename Values>
LISSOM_INLINE void load(const Values* from, int entry, double& x) {
    x = from->data()[entry];
}
template <typename Values>
LISSOM_INLINE void store(const double& x, Values* to, int entry) {
    to->data()[entry] = x;
}

#if defined(__GNUC__)
#define LISSOM_HAS_LANES
LISSOM_INLINE void take_root(Lanes<double>& x) {
    for (int c = 0; c < 4; ++c) x[c] = std::sqrt(x[c]);
}
template <typename Condition>
LISSOM_INLINE bool is_any(const Condition& condition) {
    return (condition[0] | condition[1] | condition[2] | condition[3]) != 0;
}
template <typename Values>
LISSOM_INLINE void load(const Values* from, int entry, Lanes<double>& x) {
    x = Lanes<double>{from[0].data()[entry], from[1].data()[entry], from[2].data()[entry],
                      from[3].data()[entry]};
}
template <typename Values>
LISSOM_INLINE void store(const Lanes<double>& x, Values* to, int entry) {
    for (int c = 0; c < 4; ++c) to[c].data()[entry] = x[c];
}
#endif

/// 3 x 3, column-major.
template <typename T>
struct LaneMatrix {
    T e[9] = {};
};

template <typename T>
LISSOM_INLINE void multiply(const LaneMatrix<T>& a, const LaneMatrix<T>& b,
                            LaneMatrix<T>& product) {
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
            product.e[3 * c + r] =
                a.e[r] * b.e[3 * c] + a.e[3 + r] * b.e[3 * c + 1] + a.e[6 + r] * b.e[3 * c + 2];
        }
    }
}

template <typename T>
LISSOM_INLINE void multiply_transposed(const LaneMatrix<T>& a, const LaneMatrix<T>& b,
                                       LaneMatrix<T>& product) {
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
            product.e[3 * c + r] = a.e[3 * r] * b.e[3 * c] + a.e[3 * r + 1] * b.e[3 * c + 1] +
                                   a.e[3 * r + 2] * b.e[3 * c + 2];
        }
    }
}

/// Quaternions are (w, x, y, z).
template <typename T>
LISSOM_INLINE void take_squared_norm(const T (&q)[4], T& sum) {
    sum = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
}

/// The rotation of a quaternion that need not have unit length.
template <typename T>
LISSOM_INLINE void fill_rotation(const T (&q)[4], LaneMatrix<T>& r) {
    T norm;
    take_squared_norm(q, norm);
    const T two = 2.0 / norm;
    const T x = two * q[1], y = two * q[2], z = two * q[3];
    const T wx = x * q[0], wy = y * q[0], wz = z * q[0];
    const T xx = x * q[1], xy = x * q[2], xz = x * q[3];
    const T yy = y * q[2], yz = y * q[3], zz = z * q[3];
    r.e[0] = 1.0 - yy - zz;
    r.e[1] = xy + wz;
    r.e[2] = xz - wy;
    r.e[3] = xy - wz;
    r.e[4] = 1.0 - xx - zz;
    r.e[5] = yz + wx;
    r.e[6] = xz + wy;
    r.e[7] = yz - wx;
    r.e[8] = 1.0 - xx - yy;
}

/// First b, then a.
template <typename T>
LISSOM_INLINE void compose(const T (&a)[4], const T (&b)[4], T (&q)[4]) {
    q[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    q[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    q[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    q[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
}

}  // namespace lissom::rotation_lanes
