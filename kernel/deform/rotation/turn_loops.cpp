#include "kernel/deform/rotation/turn_loops.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kernel/core/lanes.h"
#include "kernel/deform/rotation/rotation_lanes.h"
#include "kernel/deform/rotation/winding.h"

// gcc takes lanes that it cuts in two for read before they are written.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

namespace lissom {
namespace {

using namespace rotation_lanes;

// Half of pi as a number of 33 bits and the rest, so that multiples are exact.
constexpr double kQuarterHigh = 0x1.921fb544p+0, kQuarterLow = 0x1.0b4611a626331p-34;
// Beyond, multiples are not exact; nor does the turn mean much.
constexpr double kLongestTurn = 1e5;

// Adding and subtracting it rounds to the nearest integer.
constexpr double kRounder = 0x1.8p52;

// Sines and cosines up to an eighth turn: x (1 + x^2 (...)) and 1 + x^2 (...), by Taylor's series.
constexpr double kSine[] = {
    -1.0 / 6,        1.0 / 120,          -1.0 / 5040,         1.0 / 362880,
    -1.0 / 39916800, 1.0 / 6227020800.0, -1.0 / 1307674368e3, 1.0 / 355687428096e3};
constexpr double kCosine[] = {
    -1.0 / 2,       1.0 / 24,          -1.0 / 720,           1.0 / 40320,
    -1.0 / 3628800, 1.0 / 479001600.0, -1.0 / 87178291200.0, 1.0 / 20922789888e3};

// atan x = x (1 + x^2 (...)) up to the tangent of an eighth of pi, to 7e-17: the polynomial through
// Chebyshev's points.
constexpr double kArcTangent[] = {-0.3333333333332844,  0.1999999999885511,   -0.14285714180976467,
                                  0.11111106180455946,  -0.09090773074808414, 0.07689953496306857,
                                  -0.06640233930429408, 0.056883492268090106, -0.04348052215716462,
                                  0.021135373157693243};
constexpr double kEighthTangent = 0.41421356237309503;

// 1 + z (c[0] + z (c[1] + ...)).
template <typename T, std::size_t count>
LISSOM_INLINE void take_series(const double (&c)[count], const T& z, T& sum) {
    sum = T{} + c[count - 1];
    for (std::size_t i = count - 1; i-- > 0;) sum = sum * z + c[i];
    sum = sum * z + 1.0;
}

template <typename T>
LISSOM_INLINE void take_sine_and_cosine(const T& x, T& sine, T& cosine) {
    const T quarters = (x * (2.0 / kPi) + kRounder) - kRounder;
    const T r = (x - quarters * kQuarterHigh) - quarters * kQuarterLow, z = r * r;
    T s, c;
    take_series(kSine, z, s);
    take_series(kCosine, z, c);
    s = s * r;
    // Quarters from -2 to 2.
    const T turns = (quarters * 0.25 + kRounder) - kRounder;
    const T q = quarters - 4.0 * turns;
    const auto odd = (q == 1.0) | (q == -1.0);
    const T a = odd ? c : s, b = odd ? s : c, minus_a = -a, minus_b = -b;
    const auto below = (q < -0.5) | (q > 1.5), behind = (q > 0.5) | (q < -1.5);
    sine = below ? minus_a : a;
    cosine = behind ? minus_b : b;
}

// The angle of the point (x, y), neither of which is negative.
template <typename T>
LISSOM_INLINE void take_angle(const T& y, const T& x, T& angle) {
    const auto steep = y > x;
    const T low = steep ? x : y, high = steep ? y : x;
    const auto wide = low > kEighthTangent * high;
    const T above = wide ? low - high : low, below = wide ? low + high : high;
    const T t = above / below;
    T series;
    take_series(kArcTangent, t * t, series);
    series = series * t;
    const T beyond = series + 0.25 * kPi;
    angle = wide ? beyond : series;
    const T rest = 0.5 * kPi - angle;
    angle = steep ? rest : angle;
}

// q to the power `part`, the shorter way. With `fades`, by less near half a turn, at which that way
// is in doubt.
template <bool fades, typename T>
LISSOM_INLINE void take_part(const T (&q)[4], double part, T (&result)[4]) {
    const auto back = q[0] < 0.0;
    const T minus_w = -q[0], w = back ? minus_w : q[0];
    T length = q[1] * q[1] + q[2] * q[2] + q[3] * q[3], half;
    take_root(length);
    take_angle(length, w, half);
    T share = T{} + part;
    if constexpr (fades) {
        const T beyond = (2.0 * half - kSureTurn) / (kPi - kSureTurn), zero = T{}, one = T{} + 1.0;
        T t = beyond > 0.0 ? beyond : zero;
        t = t < 1.0 ? t : one;
        share = share * (1.0 - t * t * (3.0 - 2.0 * t));
    }
    T sine, cosine;
    take_sine_and_cosine(share * half, sine, cosine);
    const T least = T{} + 1e-300, divisor = length > 1e-300 ? length : least;
    const T scale = sine / divisor, minus_scale = -scale, by = back ? minus_scale : scale;
    result[0] = cosine;
    for (int i = 1; i < 4; ++i) result[i] = by * q[i];
}

template <typename T>
LISSOM_INLINE void load_quaternion(const Vec4* from, T (&q)[4]) {
    for (int i = 0; i < 4; ++i) load(from, i, q[i]);
}

// The same for all lanes.
template <typename T>
LISSOM_INLINE void spread(const Vec4& from, T (&q)[4]) {
    for (int i = 0; i < 4; ++i) q[i] = T{} + from[i];
}

template <typename T>
LISSOM_INLINE void store_matrix(const T (&q)[4], Mat3* r) {
    LaneMatrix<T> m;
    fill_rotation(q, m);
    for (int i = 0; i < 9; ++i) store(m.e[i], r, i);
}

// One step of each loop: for one rotation, or for those of all lanes.
struct TurnStep {
    const Vec4* turn;
    Vec4 base;
    Mat3* r;

    template <typename T>
    LISSOM_INLINE void run(std::size_t i) const {
        T t[3] = {}, half = T{}, sine, q[4], first[4], result[4];
        for (int d = 0; d < 3; ++d) {
            load(turn + i, d, t[d]);
            half += t[d] * t[d];
        }
        take_root(half);
        half = 0.5 * half;
        take_sine_and_cosine(half, sine, q[0]);
        const T least = T{} + 1e-300, divisor = half > 1e-300 ? half : least;
        const T scale = 0.5 * sine / divisor;
        for (int d = 0; d < 3; ++d) q[d + 1] = scale * t[d];
        spread(base, first);
        compose(q, first, result);
        store_matrix(result, r + i);
    }
};

struct FurtherStep {
    const Vec4* rotation;
    Vec4 back;
    double part;
    Mat3* m;

    template <typename T>
    LISSOM_INLINE void run(std::size_t i) const {
        T whole[4] = {}, away[4], relative[4], further[4];
        load_quaternion(rotation + i, whole);
        spread(back, away);
        compose(whole, away, relative);
        take_part<true>(relative, part, further);
        LaneMatrix<T> turn, before, after;
        fill_rotation(further, turn);
        for (int e = 0; e < 9; ++e) load(m + i, e, before.e[e]);
        multiply(turn, before, after);
        for (int e = 0; e < 9; ++e) store(after.e[e], m + i, e);
    }
};

struct BlendStep {
    const Vec4* from;
    const Vec4* to;
    double share;
    Mat3* r;

    template <typename T>
    LISSOM_INLINE void run(std::size_t i) const {
        T a[4] = {}, b[4] = {}, back[4], way[4], part[4], result[4];
        load_quaternion(from + i, a);
        load_quaternion(to + i, b);
        back[0] = a[0];
        for (int d = 1; d < 4; ++d) back[d] = -a[d];
        compose(b, back, way);
        take_part<false>(way, share, part);
        compose(part, a, result);
        store_matrix(result, r + i);
    }
};

#ifdef LISSOM_HAS_LANES
constexpr std::size_t kTurnLanes = 4;
using TurnLanes = double __attribute__((vector_size(32)));

template <typename Step>
LISSOM_INLINE void run_lanes(const Step& step, std::size_t count) {
    for (std::size_t i = 0; i < count; i += kTurnLanes) step.template run<TurnLanes>(i);
}

template <typename Step>
void run_lanes_anywhere(const Step& step, std::size_t count) {
    run_lanes(step, count);
}

#ifdef LISSOM_HAS_AVX2_PATH
template <typename Step>
LISSOM_AVX2 void run_lanes_with_avx2(const Step& step, std::size_t count) {
    run_lanes(step, count);
}
#endif

// Multiples of four; returns how many were done.
template <typename Step>
std::size_t run_in_lanes(const Step& step, std::size_t count) {
    count -= count % kTurnLanes;
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx2()) {
        run_lanes_with_avx2(step, count);
        return count;
    }
#endif
    run_lanes_anywhere(step, count);
    return count;
}
#else
template <typename Step>
std::size_t run_in_lanes(const Step&, std::size_t) {
    return 0;
}
#endif

template <typename Step>
void run_steps(const Step& step, std::size_t count) {
    for (std::size_t i = run_in_lanes(step, count); i < count; ++i) step.template run<double>(i);
}

}  // namespace

void rotations_of_turns(std::span<const Vec4> turns, const Vec4& base, std::span<Mat3> r) {
    const auto is_long = [](const Vec4& t) { return !(t.head<3>().norm() < kLongestTurn); };
    if (std::none_of(turns.begin(), turns.end(), is_long)) {
        return run_steps(TurnStep{turns.data(), base, r.data()}, turns.size());
    }
    const Mat3 first = Eigen::Quaterniond(base[0], base[1], base[2], base[3]).toRotationMatrix();
    for (std::size_t i = 0; i < turns.size(); ++i) {
        r[i] = rotation_of_turn(turns[i].head<3>()) * first;
    }
}

void turn_further(std::span<const Vec4> rotation, const Vec4& base, double part,
                  std::span<Mat3> m) {
    const Vec4 back(base[0], -base[1], -base[2], -base[3]);
    run_steps(FurtherStep{rotation.data(), back, part, m.data()}, rotation.size());
}

void blend_rotations(std::span<const Vec4> from, std::span<const Vec4> to, double share,
                     std::span<Mat3> r) {
    run_steps(BlendStep{from.data(), to.data(), share, r.data()}, from.size());
}

}  // namespace lissom
