/// What a mutated source is written with: each changed token stands beside the original one, and
/// the variable LISSOM_MUTANT chooses, when the program starts, which one of all is changed. Where
/// LISSOM_MUTANTS_REACHED names a file, a byte of each mutant is written to it at the end: 0 where
/// the program never came to it; 1 where both tokens gave the same value whenever it did, 2 where
/// that was a comparison of floating-point numbers, which never were equal; else 3.
#pragma once
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <type_traits>
#include <utility>

extern "C" {
__attribute__((weak)) int lissom_mutant = 0;
__attribute__((weak)) unsigned char lissom_mutants_reached[4096] = {};
// Before any constant of a source is made from a choice.
__attribute__((weak, constructor(101))) void lissom_choose_mutant() {
    const char* number = std::getenv("LISSOM_MUTANT");
    lissom_mutant = number ? std::atoi(number) : 0;
}
__attribute__((weak, destructor(101))) void lissom_tell_reached() {
    const char* name = std::getenv("LISSOM_MUTANTS_REACHED");
    std::FILE* file = name ? std::fopen(name, "wb") : nullptr;
    if (!file) return;
    std::fwrite(lissom_mutants_reached, 1, sizeof(lissom_mutants_reached), file);
    std::fclose(file);
}
}

namespace mutants {

template <int Number>
struct Choice {
    static_assert(Number < sizeof(lissom_mutants_reached));
    static bool on() {
        reach(3);
        return lissom_mutant == Number;
    }
    // By several threads at once.
    static void reach(unsigned char now) {
        unsigned char& most = lissom_mutants_reached[Number];
        if (__atomic_load_n(&most, __ATOMIC_RELAXED) < now) {
            __atomic_store_n(&most, now, __ATOMIC_RELAXED);
        }
    }
};

/// One of two values, either of which is at hand, of a token that compares or computes with
/// operands of type Operand.
template <int Number, class Operand, class T>
const T& chosen(const T& original, const T& other) {
    constexpr bool kMayTie = std::is_same_v<T, bool> && std::is_floating_point_v<Operand>;
    Choice<Number>::reach(original != other ? 3 : kMayTie ? 2 : 1);
    return lissom_mutant == Number ? other : original;
}

/// Numbers of which both results can be found: none traps, as the division of integers does.
template <class L, class R, class Result>
constexpr bool can_find_both =
    std::is_arithmetic_v<std::decay_t<L>>&& std::is_arithmetic_v<std::decay_t<R>> &&
    (std::is_same_v<Result, bool> || std::is_floating_point_v<Result>);

/// What an operator gives, as a value where it is an expression of Eigen that would hold on to its
/// operands.
template <class T>
auto value_of(T&& result) {
    if constexpr (requires { result.eval(); }) {
        return result.eval();
    } else {
        return std::decay_t<T>(std::forward<T>(result));
    }
}

template <int Number, class Operand>
struct Left {
    Operand&& operand;
};
template <int Number, class Operand>
struct Right {
    Operand&& operand;
};

/// `a < Compare<3>{} < b` is `a < b`, or `a <= b` where mutant 3 is chosen: the token stands twice
/// around it, so that what binds how to what stays.
template <int Number>
struct Compare {};
template <int Number>
struct Arithmetic {};
template <int Number>
struct Assign {};

#define MUTANTS_BINARY(Kind, OPERATOR, OTHER)                                                  \
    template <int Number, class L>                                                             \
    Left<Number, L> operator OPERATOR(L&& left, Kind<Number>) {                                \
        return {std::forward<L>(left)};                                                        \
    }                                                                                          \
    template <int Number, class L, class R>                                                    \
    auto operator OPERATOR(Left<Number, L>&& left, R&& right) {                                \
        using Result = decltype(value_of(left.operand OPERATOR right));                        \
        if constexpr (can_find_both<L, R, Result>) {                                           \
            return Result(chosen<Number, std::decay_t<L>, Result>(left.operand OPERATOR right, \
                                                                  left.operand OTHER right));  \
        } else if (Choice<Number>::on()) {                                                     \
            return value_of(left.operand OTHER right);                                         \
        } else {                                                                               \
            return value_of(left.operand OPERATOR right);                                      \
        }                                                                                      \
    }
MUTANTS_BINARY(Compare, <, <=)
MUTANTS_BINARY(Compare, <=, <)
MUTANTS_BINARY(Compare, >, >=)
MUTANTS_BINARY(Compare, >=, >)
MUTANTS_BINARY(Compare, ==, !=)
MUTANTS_BINARY(Compare, !=, ==)
MUTANTS_BINARY(Arithmetic, +, -)
MUTANTS_BINARY(Arithmetic, -, +)
MUTANTS_BINARY(Arithmetic, *, /)
MUTANTS_BINARY(Arithmetic, /, *)
#undef MUTANTS_BINARY

/// `a += Assign<3>{} += b`: these bind from the right.
#define MUTANTS_ASSIGN(OPERATOR, OTHER)                               \
    template <int Number, class R>                                    \
    Right<Number, R> operator OPERATOR(Assign<Number>&&, R&& right) { \
        return {std::forward<R>(right)};                              \
    }                                                                 \
    template <int Number, class L, class R>                           \
    void operator OPERATOR(L&& left, Right<Number, R>&& right) {      \
        if (Choice<Number>::on()) {                                   \
            left OTHER right.operand;                                 \
        } else {                                                      \
            left OPERATOR right.operand;                              \
        }                                                             \
    }
MUTANTS_ASSIGN(+=, -=)
MUTANTS_ASSIGN(-=, +=)
MUTANTS_ASSIGN(*=, /=)
MUTANTS_ASSIGN(/=, *=)
#undef MUTANTS_ASSIGN

/// `Sign<3>{} * a` is `-a`, `Not<3>{} * a` is `!a`.
template <int Number>
struct Sign {};
template <int Number>
struct Not {};

template <int Number, class T>
auto operator*(Sign<Number>, const T& operand) {
    using Value = decltype(value_of(-operand));
    return Choice<Number>::on() ? Value(operand) : Value(-operand);
}
template <int Number, class T>
bool operator*(Not<Number>, const T& operand) {
    return Choice<Number>::on() != !operand;
}

template <int Number, class T>
const T& min_of(const T& a, const T& b) {
    return chosen<Number, T>(std::min(a, b), std::max(a, b));
}
template <int Number, class T>
const T& max_of(const T& a, const T& b) {
    return chosen<Number, T>(std::max(a, b), std::min(a, b));
}
template <int Number, class T>
T min_of(std::initializer_list<T> values) {
    return chosen<Number, T>(std::min(values), std::max(values));
}
template <int Number, class T>
T max_of(std::initializer_list<T> values) {
    return chosen<Number, T>(std::max(values), std::min(values));
}

}  // namespace mutants
