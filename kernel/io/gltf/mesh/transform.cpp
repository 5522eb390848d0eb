#include "kernel/io/gltf/mesh/transform.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "kernel/core/roots.h"
#include "kernel/solve/dual/least_norm.h"

namespace lissom {
namespace {

using Direction = Eigen::Map<Vec3>;

Mat3 pseudo_inverse(const Mat3& a) {
    return least_norm_solution(a, Mat3::Identity());
}

// NaN if it has no length; a vector that is unit up to the rounding of a float stays as it is.
void normalize(Direction direction) {
    constexpr double kUnit = 1e-6;
    const double largest = direction.cwiseAbs().maxCoeff();
    if (!direction.allFinite() || !(largest > 0.0)) {
        direction.setConstant(std::nan(""));
        return;
    }
    if (std::abs(direction.squaredNorm() - 1.0) < kUnit) return;
    direction /= largest;
    direction.normalize();
}

double mean_scale(const Mat3& linear) {
    const double volume = std::abs(linear.determinant());
    return volume > 0.0 ? cube_root(volume) : 1.0;
}

// The inverse of the transpose, but with the size of a rotation.
Mat3 normal_matrix(const Mat3& linear, double scale) {
    Mat3 cofactors;
    for (int k = 0; k < 3; ++k) {
        cofactors.col(k) = linear.col((k + 1) % 3).cross(linear.col((k + 2) % 3));
    }
    if (linear.determinant() < 0.0) cofactors = -cofactors;
    return cofactors / (scale * scale);
}

}  // namespace

NodeTransform::NodeTransform(const Affine& transform)
    : NodeTransform(transform, normal_matrix(transform.linear, mean_scale(transform.linear)),
                    mean_scale(transform.linear)) {}

NodeTransform::NodeTransform(const Affine& transform, const Mat3& normals, double scale)
    : transform_(transform),
      normals_(normals),
      scale_(scale),
      mirrors_(transform.linear.determinant() < 0.0) {}

NodeTransform NodeTransform::inverse() const {
    if (is_identity()) return *this;
    Affine back;
    back.linear = pseudo_inverse(transform_.linear);
    back.translation = -(back.linear * transform_.translation);
    return {back, pseudo_inverse(normals_), 1.0 / scale_};
}

NodeTransform NodeTransform::moved(const Vec3& offset) const {
    NodeTransform result = *this;
    result.transform_.translation += offset;
    return result;
}

void NodeTransform::turn_normal(std::span<double> n) const {
    Direction direction(n.data());
    if (!is_identity()) direction = (normals_ * direction).eval();
    normalize(direction);
}

void NodeTransform::turn_tangent(std::span<double> t) const {
    Direction direction(t.data());
    if (!is_identity()) direction = (transform_.linear * direction).eval();
    normalize(direction);
    if (mirrors_) t[3] = -t[3];
}

void NodeTransform::turn_delta(GltfSemantic semantic, std::span<double> delta) const {
    if (is_identity()) return;
    Direction d(delta.data());
    if (semantic == GltfSemantic::position) d = (transform_.linear * d).eval();
    if (semantic == GltfSemantic::normal) d = (normals_ * d).eval();
    if (semantic == GltfSemantic::tangent) d = (transform_.linear * d / scale_).eval();
}

}  // namespace lissom
