#include "kernel/deform/rotation/polar.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "kernel/core/error.h"
#include "kernel/core/lanes.h"

namespace lissom {
namespace {

// Below this ratio of the relevant singular value sums the Newton step is not to be trusted.
constexpr double kSmallestGap = 1e-3;

// A column of the adjugate longer than the root of this is accurate enough for the polish to
// finish.
constexpr double kGoodColumn = 0.25;

constexpr double kRootTolerance = 1e-10;
constexpr int kMostIterations = 50;
constexpr double kRootOfThree = 1.7320508075688772;

Mat3 rotation_by_svd(const Mat3& m) {
    if (!(m.norm() > 0.0)) return Mat3::Identity();
    const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 u = svd.matrixU();
    if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) = -u.col(2);
    return u * svd.matrixV().transpose();
}

// What follows runs on plain numbers, for one matrix, and on lanes, for four: conditions are then
// answered lane by lane, and what any lane needs is done for all.

LISSOM_INLINE void take_root(double& x) {
    x = std::sqrt(x);
}
// Of one condition, or of several that were combined bit by bit.
LISSOM_INLINE bool is_any(bool condition) {
    return condition;
}
LISSOM_INLINE bool is_any(int condition) {
    return condition != 0;
}
LISSOM_INLINE void load(const Mat3* m, int entry, double& x) {
    x = m->data()[entry];
}
LISSOM_INLINE void store(const double& x, Mat3* m, int entry) {
    m->data()[entry] = x;
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
LISSOM_INLINE void load(const Mat3* m, int entry, Lanes<double>& x) {
    x = Lanes<double>{m[0].data()[entry], m[1].data()[entry], m[2].data()[entry],
                      m[3].data()[entry]};
}
LISSOM_INLINE void store(const Lanes<double>& x, Mat3* m, int entry) {
    for (int c = 0; c < 4; ++c) m[c].data()[entry] = x[c];
}
#endif

// 3 x 3, column-major.
template <typename T>
struct Matrix {
    T e[9] = {};
};

template <typename T>
LISSOM_INLINE void multiply(const Matrix<T>& a, const Matrix<T>& b, Matrix<T>& product) {
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
            product.e[3 * c + r] =
                a.e[r] * b.e[3 * c] + a.e[3 + r] * b.e[3 * c + 1] + a.e[6 + r] * b.e[3 * c + 2];
        }
    }
}

template <typename T>
LISSOM_INLINE void multiply_transposed(const Matrix<T>& a, const Matrix<T>& b, Matrix<T>& product) {
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
            product.e[3 * c + r] = a.e[3 * r] * b.e[3 * c] + a.e[3 * r + 1] * b.e[3 * c + 1] +
                                   a.e[3 * r + 2] * b.e[3 * c + 2];
        }
    }
}

// The symmetric matrix whose top eigenvector is the quaternion (w, x, y, z) of the nearest
// rotation.
template <typename T>
LISSOM_INLINE void fill_quaternion_matrix(const Matrix<T>& m, T (&k)[4][4]) {
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

// Greatest root of x^4 - 2 x^2 + c1 x + c0 by Newton's method from above, where it converges
// monotonically.
template <typename T>
LISSOM_INLINE void find_greatest_root(const T& c1, const T& c0, T& x) {
    x = T{} + kRootOfThree;
    for (int iteration = 0; iteration < kMostIterations; ++iteration) {
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

template <typename T>
LISSOM_INLINE void take_squared_norm(const T (&q)[4], T& sum) {
    sum = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
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

// The rotation of a quaternion that need not have unit length.
template <typename T>
LISSOM_INLINE void fill_rotation(const T (&q)[4], Matrix<T>& r) {
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

// One Newton step on the rotation: (tr S I - S) w = axial(S) for S = guess^T m, which is symmetric
// at the optimum. Gives the step as a quaternion, and the determinant on the left.
template <typename T>
LISSOM_INLINE void find_newton_step(const Matrix<T>& s, T (&step)[4], T& determinant) {
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

// Nearest rotations of the matrices at `m`; `doubt` is above zero for each that is not to be
// trusted.
template <typename T>
LISSOM_INLINE void find_rotations(const Mat3* m, Mat3* r, T& doubt) {
    Matrix<T> unit, guess, s, turn, result;
    T norm = T{};
    for (int i = 0; i < 9; ++i) {
        load(m, i, unit.e[i]);
        norm += unit.e[i] * unit.e[i];
    }
    take_root(norm);
    for (T& entry : unit.e) entry = norm > 0.0 ? entry / norm : T{};

    T k[4][4], root, quaternion[4], length, step[4], determinant;
    fill_quaternion_matrix(unit, k);
    const Minors<T> upper(k, 0, 1), lower(k, 2, 3);
    const T c0 = upper.m01 * lower.m23 - upper.m02 * lower.m13 + upper.m03 * lower.m12 +
                 upper.m12 * lower.m03 - upper.m13 * lower.m02 + upper.m23 * lower.m01;
    const T* e = unit.e;
    const T c1 = -8.0 * (e[0] * (e[4] * e[8] - e[7] * e[5]) - e[3] * (e[1] * e[8] - e[7] * e[2]) +
                         e[6] * (e[1] * e[5] - e[4] * e[2]));
    find_greatest_root(c1, c0, root);
    for (int i = 0; i < 4; ++i) k[i][i] -= root;
    find_null_vector(k, quaternion, length);
    fill_rotation(quaternion, guess);

    multiply_transposed(guess, unit, s);
    find_newton_step(s, step, determinant);
    fill_rotation(step, turn);
    multiply(guess, turn, result);
    for (int i = 0; i < 9; ++i) store(result.e[i], r, i);
    const auto trusted =
        (length > kSmallestGap * kSmallestGap) & (determinant > kSmallestGap) & (norm > 0.0);
    const T one = T{} + 1.0;
    doubt = trusted ? T{} : one;
}

#ifdef LISSOM_HAS_LANES
constexpr std::size_t kWidth = 4;

LISSOM_INLINE void find_four(const Mat3* m, Mat3* r) {
    const Mat3 copy[kWidth] = {m[0], m[1], m[2], m[3]};
    double __attribute__((vector_size(32))) doubt;
    find_rotations(copy, r, doubt);
    if (!is_any(doubt > 0.0)) return;
    for (std::size_t c = 0; c < kWidth; ++c) {
        if (doubt[c] > 0.0) r[c] = rotation_by_svd(copy[c]);
    }
}

void find_fours(const Mat3* m, Mat3* r, std::size_t count) {
    for (std::size_t i = 0; i < count; i += kWidth) find_four(m + i, r + i);
}

#ifdef LISSOM_HAS_AVX2_PATH
LISSOM_AVX2 void find_fours_with_avx2(const Mat3* m, Mat3* r, std::size_t count) {
    for (std::size_t i = 0; i < count; i += kWidth) find_four(m + i, r + i);
}
#endif

// Multiples of four; returns how many were done.
std::size_t find_in_lanes(const Mat3* m, Mat3* r, std::size_t count) {
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
std::size_t find_in_lanes(const Mat3*, Mat3*, std::size_t) {
    return 0;
}
#endif

}  // namespace

Mat3 nearest_rotation(const Mat3& m) {
    Mat3 r;
    double doubt = 0.0;
    find_rotations(&m, &r, doubt);
    return doubt > 0.0 ? rotation_by_svd(m) : r;
}

void nearest_rotations(std::span<const Mat3> m, std::span<Mat3> r) {
    if (m.size() != r.size()) {
        throw Error(ErrorCode::invalid_argument, "one rotation is needed for each matrix");
    }
    std::size_t i = find_in_lanes(m.data(), r.data(), m.size());
    for (; i < m.size(); ++i) r[i] = nearest_rotation(m[i]);
}

double uniform_scale(const Mat3& m) {
    return m.norm() / std::sqrt(3.0);
}

}  // namespace lissom
