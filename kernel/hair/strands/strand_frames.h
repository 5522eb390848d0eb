/// Frames along strands that turn about them as little as possible; private to kernel/hair.
#pragma once

#include "kernel/core/geometry.h"

namespace lissom {

/// Carries a normal from one point of a curve to the next, `step` further: one step of double
/// reflection (Wang et al. 2008, Computation of rotation minimizing frames).
inline Vec3 carried_normal(const Vec3& normal, const Vec3& step, const Vec3& tangent,
                           const Vec3& next) {
    const double c1 = step.squaredNorm();
    if (c1 == 0.0) return normal;
    const Vec3 reflected = normal - (2.0 / c1) * step.dot(normal) * step;
    const Vec3 tangent_reflected = tangent - (2.0 / c1) * step.dot(tangent) * step;
    const Vec3 turn = next - tangent_reflected;
    const double c2 = turn.squaredNorm();
    return c2 == 0.0 ? reflected : Vec3(reflected - (2.0 / c2) * turn.dot(reflected) * turn);
}

}  // namespace lissom
