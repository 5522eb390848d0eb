/// Points and directions of strands side by side, one a lane; private to kernel/hair. Included as
/// growth_lanes.h is, and compiled for the same processor.
#pragma once

#include <Eigen/Core>

#include "kernel/hair/growth/growth_lanes.h"

LISSOM_LANES_BEGIN
namespace lissom::LISSOM_LANES {

// None of these has a constructor: the compiler would make it outside of LISSOM_LANES_BEGIN.
struct Floats3 {
    Floats x, y, z;
};

LISSOM_INLINE Floats3 all(const Eigen::Vector3f& v) {
    return {all(v[0]), all(v[1]), all(v[2])};
}

LISSOM_INLINE Floats3 sum(const Floats3& a, const Floats3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

LISSOM_INLINE Floats3 difference(const Floats3& a, const Floats3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

LISSOM_INLINE Floats3 scaled(const Floats3& a, const Floats& by) {
    return {a.x * by, a.y * by, a.z * by};
}

LISSOM_INLINE Floats between(const Floats& a, const Floats& b, const Floats& share) {
    return a + share * (b - a);
}

LISSOM_INLINE Floats dot(const Floats3& a, const Floats3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

LISSOM_INLINE Floats3 choose(const Ints& yes, const Floats3& a, const Floats3& b) {
    return {choose(yes, a.x, b.x), choose(yes, a.y, b.y), choose(yes, a.z, b.z)};
}

inline void set(Floats3& v, int k, const Eigen::Vector3f& to) {
    v.x[k] = to[0];
    v.y[k] = to[1];
    v.z[k] = to[2];
}

inline Eigen::Vector3f get(const Floats3& v, int k) {
    return {v.x[k], v.y[k], v.z[k]};
}

}  // namespace lissom::LISSOM_LANES
LISSOM_LANES_END
