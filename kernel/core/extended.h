/// Extended: numbers for sums without visible rounding in a double.
#pragma once

#include <cfloat>

#if LDBL_MANT_DIG == 113 && defined(__SIZEOF_INT128__)
#include <Eigen/Core>
#include <bit>
#include <concepts>
#endif

namespace lissom {

#if LDBL_MANT_DIG == 113 && defined(__SIZEOF_INT128__)

/// A number with a mantissa of 64 bits, as `long double` on x86. Used if `long double` has 113
/// bits, so that sums are equal.
class Extended {
  public:
    Extended() = default;
    template <typename Number>
    requires std::integral<Number> || std::same_as<Number, double> || std::same_as<Number, float>
    Extended(Number value) : value_(value) {}

    template <std::floating_point Number>
    explicit operator Number() const {
        return static_cast<Number>(value_);
    }

    friend Extended operator+(Extended a, Extended b) { return rounded(a.value_ + b.value_); }
    friend Extended operator-(Extended a, Extended b) { return rounded(a.value_ - b.value_); }
    friend Extended operator*(Extended a, Extended b) { return rounded(a.value_ * b.value_); }
    friend Extended operator/(Extended a, Extended b) { return rounded(a.value_ / b.value_); }
    Extended operator-() const { return Extended(-value_, Exact{}); }
    Extended& operator+=(Extended b) { return *this = *this + b; }
    Extended& operator-=(Extended b) { return *this = *this - b; }
    Extended& operator*=(Extended b) { return *this = *this * b; }
    Extended& operator/=(Extended b) { return *this = *this / b; }
    bool operator==(const Extended&) const = default;
    auto operator<=>(const Extended&) const = default;

  private:
    __extension__ using Bits = unsigned __int128;
    struct Exact {};
    Extended(long double value, Exact) : value_(value) {}

    // To the nearest, of two the even one: the carry goes into the exponent by itself.
    static Extended rounded(long double value) {
        constexpr int kDropped = LDBL_MANT_DIG - 64;
        constexpr Bits kLast = Bits{1} << kDropped;
        const Bits bits = __builtin_bit_cast(Bits, value);
        const Bits odd = (bits >> kDropped) & 1;
        const Bits nearest = (bits + (kLast / 2 - 1) + odd) & ~(kLast - 1);
        return Extended(__builtin_bit_cast(long double, nearest), Exact{});
    }

    long double value_ = 0.0L;
};

#else

/// `long double`, with a mantissa of 64 bits on x86; with that of a double if the compiler has no
/// wider type.
using Extended = long double;

#endif

}  // namespace lissom

#if LDBL_MANT_DIG == 113 && defined(__SIZEOF_INT128__)
template <>
struct Eigen::NumTraits<lissom::Extended> : Eigen::GenericNumTraits<long double> {
    using Real = lissom::Extended;
    using NonInteger = lissom::Extended;
    using Nested = lissom::Extended;
    using Literal = lissom::Extended;
};
#endif
