#include "kernel/deform/polar.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

namespace lissom {
namespace {

// Below this ratio of the relevant singular value sums the Newton step is not to be trusted.
constexpr double kSmallestGap = 1e-3;

// A column of the adjugate longer than the root of this is accurate enough for the polish to
// finish.
constexpr double kGoodColumn = 0.25;

Mat3 rotation_by_svd(const Mat3& m) {
    const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 u = svd.matrixU();
    if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) = -u.col(2);
    return u * svd.matrixV().transpose();
}

// The symmetric matrix whose top eigenvector is the quaternion (w, x, y, z) of the nearest
// rotation.
Mat4 quaternion_matrix(const Mat3& m) {
    const double a = m(2, 1) - m(1, 2), b = m(0, 2) - m(2, 0), c = m(1, 0) - m(0, 1);
    const double d = m(0, 1) + m(1, 0), e = m(0, 2) + m(2, 0), f = m(1, 2) + m(2, 1);
    Mat4 k;
    k << m(0, 0) + m(1, 1) + m(2, 2), a, b, c,  //
        a, m(0, 0) - m(1, 1) - m(2, 2), d, e,   //
        b, d, m(1, 1) - m(0, 0) - m(2, 2), f,   //
        c, e, f, m(2, 2) - m(0, 0) - m(1, 1);
    return k;
}

// Greatest root of x^4 + c2 x^2 + c1 x + c0 by Newton's method from above, where it converges
// monotonically.
double greatest_root(double c2, double c1, double c0, double start) {
    double x = start;
    for (int iteration = 0; iteration < 50; ++iteration) {
        const double value = ((x * x + c2) * x + c1) * x + c0;
        const double slope = (4.0 * x * x + 2.0 * c2) * x + c1;
        if (!(slope > 0.0)) break;
        const double step = value / slope;
        x -= step;
        if (std::abs(step) < 1e-10 * std::abs(start)) break;
    }
    return x;
}

// Column of the adjugate of the symmetric matrix k: a multiple of its null vector q, by q[column].
Vec4 adjugate_column(const Mat4& k, int column) {
    const int r0 = column == 0 ? 1 : 0, r1 = column <= 1 ? 2 : 1, r2 = column <= 2 ? 3 : 2;
    // 2 x 2 minors of rows r1 and r2.
    const auto minor = [&](int a, int b) { return k(r1, a) * k(r2, b) - k(r1, b) * k(r2, a); };
    const double m01 = minor(0, 1), m02 = minor(0, 2), m03 = minor(0, 3);
    const double m12 = minor(1, 2), m13 = minor(1, 3), m23 = minor(2, 3);
    const double a = k(r0, 0), b = k(r0, 1), c = k(r0, 2), d = k(r0, 3);
    const Vec4 cofactors(b * m23 - c * m13 + d * m12, -(a * m23 - c * m03 + d * m02),
                         a * m13 - b * m03 + d * m01, -(a * m12 - b * m02 + c * m01));
    return column % 2 == 0 ? cofactors : Vec4(-cofactors);
}

// Null vector of the symmetric matrix k of rank 3 and norm about 1. The first column of the
// adjugate serves unless its own component, the cosine of half the rotation's angle, is small.
Vec4 null_vector(const Mat4& k) {
    Vec4 best = adjugate_column(k, 0);
    if (best.squaredNorm() > kGoodColumn) return best;
    for (int column = 1; column < 4; ++column) {
        const Vec4 candidate = adjugate_column(k, column);
        if (candidate.squaredNorm() > best.squaredNorm()) best = candidate;
    }
    return best;
}

Mat3 rotation_of(const Vec4& quaternion) {
    return Eigen::Quaterniond(quaternion[0], quaternion[1], quaternion[2], quaternion[3])
        .normalized()
        .toRotationMatrix();
}

}  // namespace

Mat3 nearest_rotation(const Mat3& m) {
    const double norm = m.norm();
    if (!(norm > 0.0)) return Mat3::Identity();
    const Mat3 unit = m / norm;

    const Mat4 k = quaternion_matrix(unit);
    const double root =
        greatest_root(-2.0, -8.0 * unit.determinant(), k.determinant(), std::sqrt(3.0));
    const Vec4 quaternion = null_vector(k - root * Mat4::Identity());
    if (!(quaternion.squaredNorm() > kSmallestGap * kSmallestGap)) return rotation_by_svd(m);
    const Mat3 guess = rotation_of(quaternion);

    // Newton step on the rotation: (tr S I - S) w = axial(S) for S = guess^T m, symmetric at the
    // optimum.
    const Mat3 s = guess.transpose() * unit;
    const Vec3 axial(s(2, 1) - s(1, 2), s(0, 2) - s(2, 0), s(1, 0) - s(0, 1));
    const Mat3 hessian = s.trace() * Mat3::Identity() - 0.5 * (s + s.transpose());
    const double determinant = hessian.determinant();
    if (!(determinant > kSmallestGap)) return rotation_by_svd(m);
    const Vec3 w = hessian.inverse() * axial;
    return guess * rotation_of(Vec4(1.0, 0.5 * w.x(), 0.5 * w.y(), 0.5 * w.z()));
}

double uniform_scale(const Mat3& m) {
    return m.norm() / std::sqrt(3.0);
}

}  // namespace lissom
