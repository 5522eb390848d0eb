/// Vectors of four numbers, and code compiled twice if the compiler can dispatch at run time: for
/// any processor and for those with AVX2. Loops are written once, as LISSOM_INLINE templates over
/// Lanes, and called from one plain function and from one marked LISSOM_AVX2; if eight numbers at a
/// time are faster, from one marked LISSOM_AVX512 too. Compiled with LISSOM_PORTABLE, code runs on
/// any processor only.
#pragma once

#if defined(__GNUC__) && defined(__x86_64__) && !defined(LISSOM_PORTABLE)
#define LISSOM_HAS_AVX2_PATH
#define LISSOM_AVX2 __attribute__((target("avx2,fma")))
#define LISSOM_AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,avx2,fma")))
#endif
#if defined(__GNUC__)
#define LISSOM_INLINE inline __attribute__((always_inline))
#else
#define LISSOM_INLINE inline
#endif

namespace lissom {

/// Returns whether this processor supports LISSOM_AVX2.
inline bool has_avx2() {
#ifdef LISSOM_HAS_AVX2_PATH
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
    return false;
#endif
}

/// Returns whether this processor supports LISSOM_AVX512.
inline bool has_avx512() {
#ifdef LISSOM_HAS_AVX2_PATH
    return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#else
    return false;
#endif
}

// Declares NAME: an array of numbers, aligned as a whole. clang forgets the alignment of an alias
// declaration, and gcc that of a const typedef. NOLINTBEGIN(bugprone-macro-parentheses)
#if defined(__clang__)
#define LISSOM_NUMBERS(Real, NAME, count) \
    typedef Real NAME                     \
        __attribute__((vector_size(count * sizeof(Real)), aligned(sizeof(Real)), may_alias))
#else
#define LISSOM_NUMBERS(Real, NAME, count) \
    using NAME =                          \
        Real __attribute__((vector_size(count * sizeof(Real)), aligned(sizeof(Real)), may_alias))
#endif  // NOLINTEND(bugprone-macro-parentheses)

/// Four numbers.
#if defined(__GNUC__)
template <typename Real>
struct LanesOf;
template <>
struct LanesOf<double> {
    LISSOM_NUMBERS(double, Type, 4);
};
template <>
struct LanesOf<float> {
    LISSOM_NUMBERS(float, Type, 4);
};
template <typename Real>
using Lanes = typename LanesOf<Real>::Type;
#else
template <typename Real>
struct Lanes {
    Real v[4];
    Lanes& operator+=(const Lanes& b) {
        for (int c = 0; c < 4; ++c) v[c] += b.v[c];
        return *this;
    }
    Lanes& operator-=(const Lanes& b) {
        for (int c = 0; c < 4; ++c) v[c] -= b.v[c];
        return *this;
    }
    friend Lanes operator*(Real a, Lanes b) {
        for (Real& x : b.v) x *= a;
        return b;
    }
    Real& operator[](int c) { return v[c]; }
    const Real& operator[](int c) const { return v[c]; }
};
#endif

/// Holders of adjacent numbers for templates. Templates lose the alignment of an alias; a holder
/// has the alignment of the whole, so it is copied from and to arrays. Holders of eight are for
/// LISSOM_AVX512.
#if defined(__GNUC__)
struct FourDoubles {
    using Type = double __attribute__((vector_size(4 * sizeof(double))));
};
struct EightDoubles {
    using Type = double __attribute__((vector_size(8 * sizeof(double))));
};
#else
struct FourDoubles {
    using Type = Lanes<double>;
};
#endif

}  // namespace lissom
