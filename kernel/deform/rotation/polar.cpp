#include "kernel/deform/rotation/polar.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "kernel/core/error.h"
#include "kernel/core/lanes.h"
#include "kernel/deform/rotation/rotation_lanes.h"

namespace lissom {
namespace {

using namespace rotation_lanes;

// Below this ratio of the relevant singular value sums the Newton step is not to be trusted.
constexpr double kSmallestGap = 1e-3;

// A column of the adjugate longer than the root of this is accurate enough for the polish to
// finish.
constexpr double kGoodColumn = 0.25;

constexpr double kRootTolerance = 1e-10;
constexpr int kMaxIterations = 50;
constexpr double kRootOfThree = 1.7320508075688772;

Mat3 rotation_by_svd(const Mat3& m) {
    if (!(m.norm() > 0.0)) return Mat3::Identity();
    const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 u = svd.matrixU();
    if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) = -u.col(2);
    return u * svd.matrixV().transpose();
}

// The symmetric matrix whose top eigenvector is the quaternion (w, x, y, z) of the nearest
// rotation.
template <typename T>
LISSOM_INLINE void fill_quaternion_matrix(const LaneMatrix<T>& m, T (&k)[4][4]) {
    const T &xx = m.e[0], &yy = m.e[4], &zz = m.e[8];
    k[0][0] = xx + yy + zz;
    k[1][1] = xx - yy - zz;
    k[2][2] = yy - xx - zz;
    k[3][3] = zz - xx - yy;
    k[0][1] = k[1][0] = m.e[5] - m.e[7];
    k[0][2] = k[2][0] = m.e[6] - m.e[2];
    k[0][3] = k[3][0] = m.e[1] - m.e[3];
    k[1][2] = k[2][1] = m.e[3] + m.e[1];
    k[1][3] = k[3][1] = m.e[6] + m.e[2];
    k[2][3] = k[3][2] = m.e[7] + m.e[5];
}

// 2 x 2 minor of the rows r and s.
template <typename T>
LISSOM_INLINE void take_minor(const T (&k)[4][4], int r, int s, int a, int b, T& minor) {
    minor = k[r][a] * k[s][b] - k[r][b] * k[s][a];
}

template <typename T>
struct Minors {
    T m01, m02, m03, m12, m13, m23;
    LISSOM_INLINE Minors(const T (&k)[4][4], int r, int s) {
        take_minor(k, r, s, 0, 1, m01);
        take_minor(k, r, s, 0, 2, m02);
        take_minor(k, r, s, 0, 3, m03);
        take_minor(k, r, s, 1, 2, m12);
        take_minor(k, r, s, 1, 3, m13);
        take_minor(k, r, s, 2, 3, m23);
    }
};

// Greatest root of x^4 - 2 x^2 + c1 x + c0 by Newton's method from above, in its region of monotone
// convergence.
template <typename T>
LISSOM_INLINE void find_greatest_root(const T& c1, const T& c0, T& x) {
    x = T{} + kRootOfThree;
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
        const T value = ((x * x - 2.0) * x + c1) * x + c0;
        const T slope = (4.0 * x * x - 4.0) * x + c1;
        const T step = slope > 0.0 ? value / slope : T{};
        x -= step;
        if (!is_any((step > kRootTolerance) | (-step > kRootTolerance))) break;
    }
}

// Column of the adjugate of the symmetric matrix k: a multiple of its null vector q, by q[column].
template <typename T>
LISSOM_INLINE void take_adjugate_column(const T (&k)[4][4], int column, T (&q)[4]) {
    const int r0 = column == 0 ? 1 : 0, r1 = column <= 1 ? 2 : 1, r2 = column <= 2 ? 3 : 2;
    const Minors<T> n(k, r1, r2);
    const T &a = k[r0][0], &b = k[r0][1], &c = k[r0][2], &d = k[r0][3];
    const double sign = column % 2 == 0 ? 1.0 : -1.0;
    q[0] = sign * (b * n.m23 - c * n.m13 + d * n.m12);
    q[1] = -sign * (a * n.m23 - c * n.m03 + d * n.m02);
    q[2] = sign * (a * n.m13 - b * n.m03 + d * n.m01);
    q[3] = -sign * (a * n.m12 - b * n.m02 + c * n.m01);
}

// Null vector of the symmetric matrix k of rank 3 and norm about 1, and its squared norm. The first
// column of the adjugate serves unless its own component, the cosine of half the rotation's angle,
// is small.
template <typename T>
LISSOM_INLINE void find_null_vector(const T (&k)[4][4], T (&best)[4], T& best_norm) {
    take_adjugate_column(k, 0, best);
    take_squared_norm(best, best_norm);
    const auto poor = best_norm <= kGoodColumn;
    if (!is_any(poor)) return;
    for (int column = 1; column < 4; ++column) {
        T candidate[4], norm;
        take_adjugate_column(k, column, candidate);
        take_squared_norm(candidate, norm);
        const auto better = poor & (norm > best_norm);
        for (int i = 0; i < 4; ++i) best[i] = better ? candidate[i] : best[i];
        best_norm = better ? norm : best_norm;
    }
}

// One Newton step on the rotation: (tr S I - S) w = axial(S) for S = guess^T m, which is symmetric
// at the optimum. Gives the step as a quaternion, and the determinant on the left.
template <typename T>
LISSOM_INLINE void find_newton_step(const LaneMatrix<T>& s, T (&step)[4], T& determinant) {
    const T x = s.e[5] - s.e[7], y = s.e[6] - s.e[2], z = s.e[1] - s.e[3];
    const T a = s.e[4] + s.e[8], b = s.e[0] + s.e[8], c = s.e[0] + s.e[4];
    const T d = -0.5 * (s.e[1] + s.e[3]), e = -0.5 * (s.e[2] + s.e[6]),
            f = -0.5 * (s.e[5] + s.e[7]);
    const T aa = b * c - f * f, bb = a * c - e * e, cc = a * b - d * d;
    const T dd = e * f - d * c, ee = d * f - e * b, ff = d * e - a * f;
    determinant = a * aa + d * dd + e * ee;
    const T half = 0.5 / determinant;
    step[0] = T{} + 1.0;
    step[1] = half * (aa * x + dd * y + ee * z);
    step[2] = half * (dd * x + bb * y + ff * z);
    step[3] = half * (ee * x + ff * y + cc * z);
}

// The nearest rotations of the matrices at `m`, each as that of a quaternion and then of a small
// step.
template <typename T>
struct PolarParts {
    LaneMatrix<T> guess;
    T quaternion[4], step[4];
    // Above zero for each that is not to be trusted.
    T doubt;
};

template <typename T>
LISSOM_INLINE void find_parts(const Mat3* m, PolarParts<T>& parts) {
    LaneMatrix<T> unit, s;
    T norm = T{};
    for (int i = 0; i < 9; ++i) {
        load(m, i, unit.e[i]);
        norm += unit.e[i] * unit.e[i];
    }
    take_root(norm);
    for (T& entry : unit.e) entry = norm > 0.0 ? entry / norm : T{};

    T k[4][4], root, length, determinant;
    fill_quaternion_matrix(unit, k);
    const Minors<T> upper(k, 0, 1), lower(k, 2, 3);
    const T c0 = upper.m01 * lower.m23 - upper.m02 * lower.m13 + upper.m03 * lower.m12 +
                 upper.m12 * lower.m03 - upper.m13 * lower.m02 + upper.m23 * lower.m01;
    const T* e = unit.e;
    const T c1 = -8.0 * (e[0] * (e[4] * e[8] - e[7] * e[5]) - e[3] * (e[1] * e[8] - e[7] * e[2]) +
                         e[6] * (e[1] * e[5] - e[4] * e[2]));
    find_greatest_root(c1, c0, root);
    for (int i = 0; i < 4; ++i) k[i][i] -= root;
    find_null_vector(k, parts.quaternion, length);
    fill_rotation(parts.quaternion, parts.guess);

    multiply_transposed(parts.guess, unit, s);
    find_newton_step(s, parts.step, determinant);
    const auto trusted =
        (length > kSmallestGap * kSmallestGap) & (determinant > kSmallestGap) & (norm > 0.0);
    const T one = T{} + 1.0;
    parts.doubt = trusted ? T{} : one;
}

template <typename T>
LISSOM_INLINE void store_nearest(const PolarParts<T>& parts, Mat3* r) {
    LaneMatrix<T> turn, result;
    fill_rotation(parts.step, turn);
    multiply(parts.guess, turn, result);
    for (int i = 0; i < 9; ++i) store(result.e[i], r, i);
}

template <typename T>
LISSOM_INLINE void store_nearest(const PolarParts<T>& parts, Vec4* q) {
    T product[4], norm;
    compose(parts.quaternion, parts.step, product);
    take_squared_norm(product, norm);
    take_root(norm);
    for (int i = 0; i < 4; ++i) store(product[i] / norm, q, i);
}

void store_by_svd(const Mat3& m, Mat3& r) {
    r = rotation_by_svd(m);
}

void store_by_svd(const Mat3& m, Vec4& q) {
    const Eigen::Quaterniond nearest(rotation_by_svd(m));
    q = {nearest.w(), nearest.x(), nearest.y(), nearest.z()};
}

template <typename Rotation>
void store_one(const Mat3& m, Rotation& r) {
    PolarParts<double> parts;
    find_parts(&m, parts);
    if (parts.doubt > 0.0) return store_by_svd(m, r);
    store_nearest(parts, &r);
}

#ifdef LISSOM_HAS_LANES
constexpr std::size_t kWidth = 4;

template <typename Rotation>
LISSOM_INLINE void find_four(const Mat3* m, Rotation* r) {
    const Mat3 copy[kWidth] = {m[0], m[1], m[2], m[3]};
    PolarParts<double __attribute__((vector_size(32)))> parts;
    find_parts(copy, parts);
    store_nearest(parts, r);
    if (!is_any(parts.doubt > 0.0)) return;
    for (std::size_t c = 0; c < kWidth; ++c) {
        if (parts.doubt[c] > 0.0) store_by_svd(copy[c], r[c]);
    }
}

template <typename Rotation>
void find_fours(const Mat3* m, Rotation* r, std::size_t count) {
    for (std::size_t i = 0; i < count; i += kWidth) find_four(m + i, r + i);
}

#ifdef LISSOM_HAS_AVX2_PATH
template <typename Rotation>
LISSOM_AVX2 void find_fours_with_avx2(const Mat3* m, Rotation* r, std::size_t count) {
    for (std::size_t i = 0; i < count; i += kWidth) find_four(m + i, r + i);
}
#endif

// Multiples of four; returns how many were done.
template <typename Rotation>
std::size_t find_in_lanes(const Mat3* m, Rotation* r, std::size_t count) {
    count -= count % kWidth;
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx2()) {
        find_fours_with_avx2(m, r, count);
        return count;
    }
#endif
    find_fours(m, r, count);
    return count;
}
#else
template <typename Rotation>
std::size_t find_in_lanes(const Mat3*, Rotation*, std::size_t) {
    return 0;
}
#endif

template <typename Rotation>
void find_nearest(std::span<const Mat3> m, std::span<Rotation> r) {
    if (m.size() != r.size()) {
        throw Error(ErrorCode::invalid_argument, "one rotation is needed for each matrix");
    }
    std::size_t i = find_in_lanes(m.data(), r.data(), m.size());
    for (; i < m.size(); ++i) store_one(m[i], r[i]);
}

}  // namespace

Mat3 nearest_rotation(const Mat3& m) {
    Mat3 r;
    store_one(m, r);
    return r;
}

void nearest_rotations(std::span<const Mat3> m, std::span<Mat3> r) {
    find_nearest(m, r);
}

void nearest_quaternions(std::span<const Mat3> m, std::span<Vec4> q) {
    find_nearest(m, q);
}

double uniform_scale(const Mat3& m) {
    return m.norm() / std::sqrt(3.0);
}

}  // namespace lissom
