#include "kernel/core/rotation.h"

#include <cmath>

namespace lissom {

// By half angles, without the singular value decomposition of Eigen's FromTwoVectors, which takes
// compilers longer than a whole room.
Eigen::Quaterniond min_rotation(const Vec3& from, const Vec3& to) {
    // Twice the cosine of half the angle below which the cross product has lost the axis.
    constexpr double kOpposite = 1e-8;
    const Vec3 a = from.normalized(), b = to.normalized();
    const double cosine = a.dot(b);
    // The sum keeps the digits that 1 + cosine loses beyond a right angle.
    const double s = cosine > 0.0 ? std::sqrt(2.0 * (1.0 + cosine)) : (a + b).norm();
    if (s < kOpposite) {
        const Vec3 axis = a.unitOrthogonal();
        return {0.0, axis.x(), axis.y(), axis.z()};
    }
    const Vec3 axis = a.cross(b) * (1.0 / s);
    return {0.5 * s, axis.x(), axis.y(), axis.z()};
}

}  // namespace lissom
