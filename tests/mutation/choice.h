/// What a mutated source is written with: each changed token stands beside the original one, and
/// the variable LISSOM_MUTANT chooses, when the program starts, which one of all is changed.
#pragma once
#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <type_traits>
#include <utility>

extern "C" {
__attribute__((weak)) int lissom_mutant = 0;
// Before any constant of a source is made from a choice.
__attribute__((weak, constructor(101))) void lissom_choose_mutant() {
    const char* number = std::getenv("LISSOM_MUTANT");
    lissom_mutant = number ? std::atoi(number) : 0;
}
}

namespace mutants {

template <int Number>
struct Choice {
    static bool on() { return lissom_mutant == Number; }
};

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

#define MUTANTS_BINARY(Kind, OPERATOR, OTHER)                   \
    template <int Number, class L>                              \
    Left<Number, L> operator OPERATOR(L&& left, Kind<Number>) { \
        return {std::forward<L>(left)};                         \
    }                                                           \
    template <int Number, class L, class R>                     \
    auto operator OPERATOR(Left<Number, L>&& left, R&& right) { \
        if (Choice<Number>::on()) {                             \
            return value_of(left.operand OTHER right);          \
        }                                                       \
        return value_of(left.operand OPERATOR right);           \
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
    return Choice<Number>::on() ? std::max(a, b) : std::min(a, b);
}
template <int Number, class T>
const T& max_of(const T& a, const T& b) {
    return Choice<Number>::on() ? std::min(a, b) : std::max(a, b);
}
template <int Number, class T>
T min_of(std::initializer_list<T> values) {
    return Choice<Number>::on() ? std::max(values) : std::min(values);
}
template <int Number, class T>
T max_of(std::initializer_list<T> values) {
    return Choice<Number>::on() ? std::min(values) : std::max(values);
}

}  // namespace mutants
