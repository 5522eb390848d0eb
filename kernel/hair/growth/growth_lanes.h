/// Numbers side by side, one a lane, as vector instructions take them; private to kernel/hair. Code
/// that uses them is compiled several times, in files that say before with which instructions:
/// LISSOM_LANES_AVX2, LISSOM_LANES_AVX512 or none. It stands between LISSOM_LANES_BEGIN and
/// LISSOM_LANES_END, in namespace lissom::LISSOM_LANES, and behind the headers of others, as those
/// must run on any processor.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "kernel/core/lanes.h"

#if defined(LISSOM_LANES_AVX512)
#include <immintrin.h>
#define LISSOM_LANES lanes_avx512
#define LISSOM_LANES_TARGET "avx2,avx512f,avx512bw,avx512dq,avx512vl"
#elif defined(LISSOM_LANES_AVX2)
#include <immintrin.h>
#define LISSOM_LANES lanes_avx2
#define LISSOM_LANES_TARGET "avx2"
#else
#define LISSOM_LANES lanes_anywhere
#if defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif
#endif

// All functions between are compiled for one processor: were they only inlined into a function for
// it, gcc would have cut their vectors into pieces before.
#define LISSOM_PRAGMA_TEXT(x) _Pragma(#x)
#define LISSOM_PRAGMA(x) LISSOM_PRAGMA_TEXT(x)
#if !defined(LISSOM_LANES_TARGET)
#define LISSOM_LANES_BEGIN
#define LISSOM_LANES_END
#elif defined(__clang__)
#define LISSOM_LANES_BEGIN \
    LISSOM_PRAGMA(         \
        clang attribute push(__attribute__((target(LISSOM_LANES_TARGET))), apply_to = function))
#define LISSOM_LANES_END LISSOM_PRAGMA(clang attribute pop)
#else
#define LISSOM_LANES_BEGIN          \
    LISSOM_PRAGMA(GCC push_options) \
    LISSOM_PRAGMA(GCC target(LISSOM_LANES_TARGET))
#define LISSOM_LANES_END LISSOM_PRAGMA(GCC pop_options)
#endif

#if defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 12)
#define LISSOM_HAS_SHUFFLES
#endif

LISSOM_LANES_BEGIN
namespace lissom::LISSOM_LANES {

#if defined(LISSOM_LANES_AVX512)
inline constexpr int kLanes = 16;
#elif defined(LISSOM_LANES_AVX2)
inline constexpr int kLanes = 8;
#else
inline constexpr int kLanes = 4;
#endif

#if defined(__GNUC__)
using Floats = float __attribute__((vector_size(4 * kLanes)));
/// Also answers to comparisons, lane by lane: -1 for yes and 0 for no.
using Ints = std::int32_t __attribute__((vector_size(4 * kLanes)));
/// Not one a lane.
using EightFloats = float __attribute__((vector_size(32)));
#else
template <typename Number, int kCount>
struct Several {
    Number v[kCount]{};
    Number& operator[](int k) { return v[k]; }
    const Number& operator[](int k) const { return v[k]; }
    template <typename Operation>
    static auto each(const Several& a, const Several& b, const Operation& operation) {
        Several<decltype(operation(a.v[0], b.v[0])), kCount> result;
        for (int k = 0; k < kCount; ++k) result[k] = operation(a[k], b[k]);
        return result;
    }
    friend auto operator+(const Several& a, const Several& b) {
        return each(a, b, [](Number x, Number y) { return x + y; });
    }
    friend auto operator-(const Several& a, const Several& b) {
        return each(a, b, [](Number x, Number y) { return x - y; });
    }
    friend auto operator*(const Several& a, const Several& b) {
        return each(a, b, [](Number x, Number y) { return x * y; });
    }
    friend auto operator*(Number x, const Several& b) {
        Several a;
        for (Number& y : a.v) y = x;
        return a * b;
    }
    friend auto operator-(Number x, const Several& b) {
        Several a;
        for (Number& y : a.v) y = x;
        return a - b;
    }
    friend auto operator/(const Several& a, const Several& b) {
        return each(a, b, [](Number x, Number y) { return x / y; });
    }
    friend auto operator&(const Several& a, const Several& b) {
        return each(a, b, [](Number x, Number y) { return x & y; });
    }
    friend auto operator|(const Several& a, const Several& b) {
        return each(a, b, [](Number x, Number y) { return x | y; });
    }
    friend auto operator<(const Several& a, const Several& b) {
        return each(a, b, [](Number x, Number y) { return std::int32_t{-(x < y)}; });
    }
    friend auto operator>(const Several& a, const Several& b) { return b < a; }
    friend auto operator==(const Several& a, const Several& b) {
        return each(a, b, [](Number x, Number y) { return std::int32_t{-(x == y)}; });
    }
};
using Floats = Several<float, kLanes>;
using Ints = Several<std::int32_t, kLanes>;
using EightFloats = Several<float, 8>;
#endif

LISSOM_INLINE Floats all(float x) {
    return x - Floats{};
}

LISSOM_INLINE Ints all(std::int32_t x) {
    return x - Ints{};
}

LISSOM_INLINE EightFloats load(const float* from) {
    EightFloats result;
    std::memcpy(&result, from, sizeof(result));
    return result;
}

/// Returns a for true masks, else b.
template <typename Numbers>
LISSOM_INLINE Numbers choose(const Ints& yes, const Numbers& a, const Numbers& b) {
#if defined(__GNUC__)
    return yes ? a : b;
#else
    Numbers result;
    for (int k = 0; k < kLanes; ++k) result[k] = yes[k] ? a[k] : b[k];
    return result;
#endif
}

template <typename Numbers>
LISSOM_INLINE Numbers least(const Numbers& a, const Numbers& b) {
    return choose(a < b, a, b);
}

template <typename Numbers>
LISSOM_INLINE Numbers most(const Numbers& a, const Numbers& b) {
    return choose(a > b, a, b);
}

LISSOM_INLINE Ints no(const Ints& yes) {
    return yes == all(0);
}

LISSOM_INLINE bool any(const Ints& yes) {
#if defined(LISSOM_LANES_AVX512)
    const auto bits = reinterpret_cast<__m512i>(yes);
    return _mm512_test_epi32_mask(bits, bits) != 0;
#elif defined(LISSOM_LANES_AVX2)
    const auto bits = reinterpret_cast<__m256i>(yes);
    return _mm256_testz_si256(bits, bits) == 0;
#elif defined(__wasm_simd128__)
    return wasm_v128_any_true(reinterpret_cast<v128_t>(yes));
#else
    std::uint64_t pairs[kLanes / 2];
    std::memcpy(pairs, &yes, sizeof(pairs));
    return (pairs[0] | pairs[1]) != 0;
#endif
}

/// Bit k says whether lane k is not 0.
LISSOM_INLINE unsigned bits_of(const Ints& yes) {
#if defined(LISSOM_LANES_AVX512)
    const auto numbers = reinterpret_cast<__m512i>(yes);
    return _mm512_test_epi32_mask(numbers, numbers);
#elif defined(LISSOM_LANES_AVX2)
    return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(no(no(yes)))));
#elif defined(__wasm_simd128__)
    return static_cast<unsigned>(wasm_i32x4_bitmask(reinterpret_cast<v128_t>(no(no(yes)))));
#else
    unsigned bits = 0;
    for (int k = 0; k < kLanes; ++k) {
        if (yes[k] != 0) bits |= 1u << k;
    }
    return bits;
#endif
}

LISSOM_INLINE Floats root(const Floats& x) {
#if defined(LISSOM_LANES_AVX512)
    return _mm512_maskz_sqrt_ps(0xffff, x);
#elif defined(__wasm_simd128__)
    return reinterpret_cast<Floats>(wasm_f32x4_sqrt(reinterpret_cast<v128_t>(x)));
#else
    Floats result;
    for (int k = 0; k < kLanes; ++k) result[k] = std::sqrt(x[k]);
    return result;
#endif
}

LISSOM_INLINE Ints truncate(const Floats& x) {
#if defined(__GNUC__)
    return __builtin_convertvector(x, Ints);
#else
    Ints result;
    for (int k = 0; k < kLanes; ++k) result[k] = static_cast<std::int32_t>(x[k]);
    return result;
#endif
}

LISSOM_INLINE Floats to_floats(const Ints& x) {
#if defined(__GNUC__)
    return __builtin_convertvector(x, Floats);
#else
    Floats result;
    for (int k = 0; k < kLanes; ++k) result[k] = static_cast<float>(x[k]);
    return result;
#endif
}

// Shuffles of two vectors, in each part of four numbers alike: two numbers of a and two of b, or
// one and one, twice.
#if defined(LISSOM_HAS_SHUFFLES) && defined(LISSOM_LANES_AVX512)
#define LISSOM_SHUFFLE_QUADS(a, b, i, j, k, l)                                             \
    __builtin_shufflevector(a, b, i, j, k, l, (i) + 4, (j) + 4, (k) + 4, (l) + 4, (i) + 8, \
                            (j) + 8, (k) + 8, (l) + 8, (i) + 12, (j) + 12, (k) + 12, (l) + 12)
#elif defined(LISSOM_HAS_SHUFFLES) && defined(LISSOM_LANES_AVX2)
#define LISSOM_SHUFFLE_QUADS(a, b, i, j, k, l) \
    __builtin_shufflevector(a, b, i, j, k, l, (i) + 4, (j) + 4, (k) + 4, (l) + 4)
#elif defined(LISSOM_HAS_SHUFFLES)
#define LISSOM_SHUFFLE_QUADS(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l)
#endif

/// Returns the last numbers of both halves of a and b: both halves of the result end with one of a
/// and one of b; the numbers before are undefined.
LISSOM_INLINE EightFloats last_of(const EightFloats& a, const EightFloats& b) {
#if defined(LISSOM_HAS_SHUFFLES)
    return __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
#else
    return EightFloats{0.0f, 0.0f, a[3], b[3], 0.0f, 0.0f, a[7], b[7]};
#endif
}

#if defined(LISSOM_HAS_SHUFFLES)
// Four numbers of each of the rows 0, 4, 8 and so on. Works in registers: values stored in parts
// are slow to load at once.
LISSOM_INLINE Floats every_fourth(const EightFloats* rows, int first) {
    using Quad = float __attribute__((vector_size(16)));
    Quad quads[kLanes / 4];
    for (int i = 0; i < kLanes / 4; ++i) {
        std::memcpy(&quads[i], reinterpret_cast<const float*>(&rows[4 * i]) + first, sizeof(Quad));
    }
#if defined(LISSOM_LANES_AVX512)
    const EightFloats low = __builtin_shufflevector(quads[0], quads[1], 0, 1, 2, 3, 4, 5, 6, 7);
    const EightFloats high = __builtin_shufflevector(quads[2], quads[3], 0, 1, 2, 3, 4, 5, 6, 7);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
#elif defined(LISSOM_LANES_AVX2)
    return __builtin_shufflevector(quads[0], quads[1], 0, 1, 2, 3, 4, 5, 6, 7);
#else
    return quads[0];
#endif
}
#endif

/// columns[i][k] = rows[k][first + i].
LISSOM_INLINE void transpose(const EightFloats rows[kLanes], int first, Floats columns[4]) {
#if defined(LISSOM_HAS_SHUFFLES)
    constexpr int kEnd = kLanes;
    Floats part[4];
    for (int j = 0; j < 4; ++j) part[j] = every_fourth(rows + j, first);
    const Floats a = LISSOM_SHUFFLE_QUADS(part[0], part[1], 0, kEnd, 1, kEnd + 1);
    const Floats b = LISSOM_SHUFFLE_QUADS(part[2], part[3], 0, kEnd, 1, kEnd + 1);
    const Floats c = LISSOM_SHUFFLE_QUADS(part[0], part[1], 2, kEnd + 2, 3, kEnd + 3);
    const Floats d = LISSOM_SHUFFLE_QUADS(part[2], part[3], 2, kEnd + 2, 3, kEnd + 3);
    columns[0] = LISSOM_SHUFFLE_QUADS(a, b, 0, 1, kEnd, kEnd + 1);
    columns[1] = LISSOM_SHUFFLE_QUADS(a, b, 2, 3, kEnd + 2, kEnd + 3);
    columns[2] = LISSOM_SHUFFLE_QUADS(c, d, 0, 1, kEnd, kEnd + 1);
    columns[3] = LISSOM_SHUFFLE_QUADS(c, d, 2, 3, kEnd + 2, kEnd + 3);
#else
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < kLanes; ++k) columns[i][k] = rows[k][first + i];
    }
#endif
}

/// Lane k of three numbers side by side, in rows[k % 4] from k / 4 * 4 on; the fourth number there
/// means nothing.
LISSOM_INLINE void store_rows(const Floats& x, const Floats& y, const Floats& z,
                              float rows[4][kLanes]) {
#if defined(LISSOM_HAS_SHUFFLES)
    constexpr int kEnd = kLanes;
    const Floats low = LISSOM_SHUFFLE_QUADS(x, y, 0, kEnd, 1, kEnd + 1);
    const Floats high = LISSOM_SHUFFLE_QUADS(x, y, 2, kEnd + 2, 3, kEnd + 3);
    const Floats row[4] = {LISSOM_SHUFFLE_QUADS(low, z, 0, 1, kEnd, kEnd),
                           LISSOM_SHUFFLE_QUADS(low, z, 2, 3, kEnd + 1, kEnd + 1),
                           LISSOM_SHUFFLE_QUADS(high, z, 0, 1, kEnd + 2, kEnd + 2),
                           LISSOM_SHUFFLE_QUADS(high, z, 2, 3, kEnd + 3, kEnd + 3)};
    std::memcpy(rows, row, sizeof(row));
#else
    for (int k = 0; k < kLanes; ++k) {
        float* row = rows[k % 4] + k / 4 * 4;
        row[0] = x[k];
        row[1] = y[k];
        row[2] = row[3] = z[k];
    }
#endif
}

}  // namespace lissom::LISSOM_LANES
LISSOM_LANES_END
