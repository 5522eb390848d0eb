#include "kernel/hair/strands/strand_pass.h"

#include <cmath>

#include "kernel/hair/strands/strand_edit.h"
#include "tests/unit/hair/operators/operator_scenes.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Strands styled(Strands strands, const NamedOperator& one, const StrandOperatorOptions& effect = {},
               const Context& context = {}) {
    one.run(strands, effect, context);
    return strands;
}

bool same_strands(const Strands& a, const Strands& b, Index count) {
    for (Index s = 0; s < count; ++s) {
        if (!same_points(a.strand(s), b.strand(s))) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("every operator changes strands and keeps roots, ids, groups and widths") {
    const Strands strands = rich_hair(200);
    for (const NamedOperator& one : all_operators()) {
        CAPTURE(one.name);
        const Strands made = styled(strands, one);
        CHECK(hash(made) != hash(strands));
        REQUIRE(made.size() == strands.size());
        for (Index s = 0; s < strands.size(); ++s) CHECK(made.root(s) == strands.root(s));
        CHECK(made.ids() == strands.ids());
        CHECK(made.groups() == strands.groups());
        CHECK(made.widths().values == strands.widths().values);
        CHECK(made.roots().faces == strands.roots().faces);
    }
}

TEST_CASE("lengths are kept where an operator promises it") {
    const Strands strands = random_hair(200);
    for (const NamedOperator& one : all_operators()) {
        if (!one.keeps_length) continue;
        CAPTURE(one.name);
        const Strands made = styled(strands, one);
        for (Index s = 0; s < strands.size(); ++s) {
            CHECK(length(made.strand(s)) ==
                  doctest::Approx(length(strands.strand(s))).epsilon(2e-4));
        }
    }
}

TEST_CASE("a factor of 0 and a mask of 0 leave strands as they are, to the bit") {
    const Strands strands = rich_hair(100);
    for (const NamedOperator& one : all_operators()) {
        CAPTURE(one.name);
        StrandOperatorOptions effect;
        effect.factor = 0.0;
        CHECK(hash(styled(strands, one, effect)) == hash(strands));
        effect.factor = 1.0;
        effect.mask.assign(100, 0.0f);
        for (std::size_t s = 50; s < 100; ++s) effect.mask[s] = 1.0f;
        const Strands made = styled(strands, one, effect), whole = styled(strands, one);
        for (Index s = 0; s < 50; ++s) CHECK(same_points(made.strand(s), strands.strand(s)));
        for (Index s = 50; s < 100; ++s) CHECK(same_points(made.strand(s), whole.strand(s)));
    }
}

TEST_CASE("half of the effect lies between none and all of it") {
    const Strands strands = strands_of({{{0, 0, 0}, {0, 0.1, 0}, {0, 0.2, 0}}});
    DisplaceOptions options;
    options.offset = {0.1, 0, 0};
    options.keep_length = false;
    options.factor = 0.5;
    Strands made = strands;
    displace(made, options);
    CHECK(made.strand(0)(0, 1) == doctest::Approx(0.025));
    CHECK(made.strand(0)(0, 2) == doctest::Approx(0.05));
    options.profile = {0.0, 1.0, 0.0};
    made = strands;
    displace(made, options);
    CHECK(made.strand(0)(0, 1) == doctest::Approx(0.05));
    CHECK(made.strand(0)(0, 2) == doctest::Approx(0.0));
}

TEST_CASE(
    "operators do the same on 1, 2 and 16 threads, and to the first strands whatever follows") {
    const Strands strands = random_hair(600), few = prefix(strands, 150);
    for (const NamedOperator& one : all_operators()) {
        CAPTURE(one.name);
        const Strands made = styled(strands, one);
        for (const int count : {2, 16}) {
            CHECK(hash(styled(strands, one, {}, threads(count))) == hash(made));
        }
        // Roots of a few are elsewhere in the mean, which roll and puff take as the head's middle.
        if (one.name == "roll" || one.name == "puff") continue;
        CHECK(same_strands(styled(few, one), made, 150));
    }
}

TEST_CASE("another seed gives another result where chance has a part") {
    const Strands strands = random_hair(50);
    for (const NamedOperator& one : all_operators()) {
        const bool random = one.name == "gather" || one.name == "curl" || one.name == "frizz" ||
                            one.name == "rotate" || one.name == "set_length";
        if (!random) continue;
        CAPTURE(one.name);
        StrandOperatorOptions effect;
        effect.seed = 2;
        CHECK(hash(styled(strands, one, effect)) != hash(styled(strands, one)));
    }
}

TEST_CASE("no strands, roots alone, strands without length or beyond numbers stay as they are") {
    const float nan = std::nanf("");
    Strands odd = strands_of({{{0, 0.1, 0}},
                              {{0, 0.1, 0}, {0, 0.1, 0}, {0, 0.1, 0}},
                              {{0.01, 0.1, 0}, {0.01, 0.2, 0}, {0.01, 0.3, 0.05}}});
    odd.edit_strand(2)(1, 1) = nan;
    for (const NamedOperator& one : all_operators()) {
        CAPTURE(one.name);
        CHECK(styled(Strands(), one).empty());
        const Strands made = styled(odd, one);
        CHECK(made.strand(0) == odd.strand(0));
        for (Index k = 0; k < made.point_count(1); ++k) {
            CHECK(made.strand(1).col(k) == odd.strand(1).col(0));
        }
        CHECK(made.strand(2).col(2) == odd.strand(2).col(2));
    }
}

TEST_CASE("strands far from the origin get finite results") {
    Strands far = random_hair(40);
    for (Index s = 0; s < far.size(); ++s)
        far.edit_strand(s).colwise() += Eigen::Vector3f(1000, 0, -500);
    for (const NamedOperator& one : all_operators()) {
        CAPTURE(one.name);
        const Strands made = styled(far, one);
        for (Index s = 0; s < made.size(); ++s) CHECK(made.strand(s).allFinite());
    }
}

TEST_CASE("results beyond 32-bit numbers are refused, and nothing has changed") {
    Strands strands = strands_of({{{0, 0, 0}, {0, 0.1, 0}}, {{3e38, 0, 0}, {3e38, 1e37, 0}}});
    const std::uint64_t before = hash(strands);
    LengthOptions options;
    options.scale = 100.0;
    const Error error = error_of([&] { set_length(strands, options); });
    CHECK(error.code() == ErrorCode::not_finite);
    CHECK(hash(strands) == before);
}

TEST_CASE("an operator that is cancelled has changed nothing, guides included") {
    Strands strands = random_hair(500);
    const std::uint64_t before = hash(strands);
    for (const NamedOperator& one : all_operators()) {
        CAPTURE(one.name);
        const Context context;
        context.cancel();
        CHECK(error_of([&] { one.run(strands, {}, context); }).code() == ErrorCode::cancelled);
        CHECK(hash(strands) == before);
    }
}

TEST_CASE("parts of an effect out of range are refused") {
    const Strands strands = random_hair(10);
    const auto refused = [&](const auto& change) {
        StrandOperatorOptions effect;
        change(effect);
        Strands made = strands;
        return error_of([&] { straighten(made, effect); }).code() == ErrorCode::invalid_argument;
    };
    CHECK(refused([](auto& e) { e.factor = 1.1; }));
    CHECK(refused([](auto& e) { e.factor = std::nan(""); }));
    CHECK(refused([](auto& e) { e.shape = -1.0; }));
    CHECK(refused([](auto& e) { e.profile = {0.0, 2.0}; }));
    CHECK(refused([](auto& e) { e.mask = {1.0f, 0.5f}; }));
    CHECK(refused([](auto& e) { e.mask.assign(10, 1.5f); }));
}

TEST_CASE("the sine of turns is the sine") {
    for (double x = -7.3; x < 7.3; x += 0.0137) {
        CHECK(std::abs(sine_of_turns(x) - std::sin(2.0 * kPi * x)) < 1e-5);
    }
}
