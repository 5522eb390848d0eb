#include "kernel/core/geometry.h"

#include <Eigen/Geometry>

#include "kernel/core/error.h"

namespace lissom {

Affine translation(const Vec3& offset) {
    return {Mat3::Identity(), offset};
}

Affine rotation(const Vec3& axis, double angle, const Vec3& about) {
    const double length = axis.norm();
    if (!(length > 0.0) || !std::isfinite(length) || !std::isfinite(angle)) {
        throw Error(ErrorCode::invalid_argument,
                    "rotation needs an axis of non-zero length and a finite angle");
    }
    const Mat3 linear = Eigen::AngleAxisd(angle, axis / length).toRotationMatrix();
    return {linear, about - linear * about};
}

Affine scaling(const Vec3& factors, const Vec3& about) {
    const Mat3 linear = factors.asDiagonal();
    return {linear, about - linear * about};
}

}  // namespace lissom
