/// Eight numbers side by side, as vector instructions take them; private to kernel/hair. Code that
/// uses them is compiled twice, as kernel/core/lanes.h says.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "kernel/core/lanes.h"

#if defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 12)
#define LISSOM_HAS_SHUFFLES
#endif

namespace lissom {

inline constexpr int kLanes = 8;

#if defined(__GNUC__)
using Floats = float __attribute__((vector_size(32)));
/// Also answers to comparisons, lane by lane: -1 for yes and 0 for no.
using Ints = std::int32_t __attribute__((vector_size(32)));
using HalfFloats = float __attribute__((vector_size(16)));
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
using HalfFloats = Several<float, kLanes / 2>;
#endif

LISSOM_INLINE Floats all(float x) {
    return Floats{x, x, x, x, x, x, x, x};
}

LISSOM_INLINE Ints all(std::int32_t x) {
    return Ints{x, x, x, x, x, x, x, x};
}

LISSOM_INLINE Floats load(const float* from) {
    Floats result;
    std::memcpy(&result, from, sizeof(result));
    return result;
}

/// a where yes, else b.
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
    std::uint64_t pairs[kLanes / 2];
    std::memcpy(pairs, &yes, sizeof(pairs));
    return (pairs[0] | pairs[1] | pairs[2] | pairs[3]) != 0;
}

LISSOM_INLINE Floats root(const Floats& x) {
    Floats result;
    for (int k = 0; k < kLanes; ++k) result[k] = std::sqrt(x[k]);
    return result;
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

/// The halves of eight numbers, of which the lower comes first.
LISSOM_INLINE void split(const Floats& x, HalfFloats& low, HalfFloats& high) {
    std::memcpy(&low, &x, sizeof(low));
    std::memcpy(&high, reinterpret_cast<const char*>(&x) + sizeof(low), sizeof(high));
}

/// The last numbers of three, side by side; the fourth means nothing.
LISSOM_INLINE HalfFloats last_of(const HalfFloats& a, const HalfFloats& b, const HalfFloats& c) {
#if defined(LISSOM_HAS_SHUFFLES)
    const HalfFloats ab = __builtin_shufflevector(a, b, 3, 7, 3, 7);
    return __builtin_shufflevector(ab, c, 0, 1, 7, 7);
#else
    return HalfFloats{a[3], b[3], c[3], c[3]};
#endif
}

/// columns[i][k] = i-th number of rows[k].
LISSOM_INLINE void transpose(const HalfFloats rows[kLanes], Floats columns[4]) {
#if defined(LISSOM_HAS_SHUFFLES)
    Floats pair[4];
    for (int j = 0; j < 4; ++j) {
        pair[j] = __builtin_shufflevector(rows[j], rows[j + 4], 0, 1, 2, 3, 4, 5, 6, 7);
    }
    const Floats a = __builtin_shufflevector(pair[0], pair[1], 0, 8, 1, 9, 4, 12, 5, 13);
    const Floats b = __builtin_shufflevector(pair[2], pair[3], 0, 8, 1, 9, 4, 12, 5, 13);
    const Floats c = __builtin_shufflevector(pair[0], pair[1], 2, 10, 3, 11, 6, 14, 7, 15);
    const Floats d = __builtin_shufflevector(pair[2], pair[3], 2, 10, 3, 11, 6, 14, 7, 15);
    columns[0] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
    columns[1] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
    columns[2] = __builtin_shufflevector(c, d, 0, 1, 8, 9, 4, 5, 12, 13);
    columns[3] = __builtin_shufflevector(c, d, 2, 3, 10, 11, 6, 7, 14, 15);
#else
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < kLanes; ++k) columns[i][k] = rows[k][i];
    }
#endif
}

}  // namespace lissom
