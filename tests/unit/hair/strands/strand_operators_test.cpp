// What all operators keep, and the simple ones.
#include "kernel/hair/strands/strand_operators.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <string>
#include <thread>

#include "kernel/hair/strands/strand_clump.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_noise.h"
#include "tests/unit/hair/strands/strand_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

struct Operator {
    std::string name;
    std::function<void(Strands&, const Context&)> run;
};

std::vector<Operator> operators() {
    ClumpOptions clumps;
    clumps.clumps = 40;
    clumps.radius = 0.1;
    NoiseOptions cumulative;
    cumulative.cumulative = true;
    cumulative.keep_length = false;
    return {{"clump", [=](Strands& s, const Context& c) { clump(s, clumps, c); }},
            {"noise", [](Strands& s, const Context& c) { noise(s, {}, c); }},
            {"cumulative noise", [=](Strands& s, const Context& c) { noise(s, cumulative, c); }},
            {"smooth", [](Strands& s, const Context& c) { smooth(s, {}, c); }}};
}

Strands result_of(const Operator& op, Strands strands, const Context& context = {}) {
    op.run(strands, context);
    return strands;
}

Strands without_group_names(Strands strands) {
    strands.set_groups({}, {});
    return strands;
}

}  // namespace

TEST_CASE("operators move strands but never roots") {
    const Strands strands = rich_hair(300);
    for (const Operator& op : operators()) {
        CAPTURE(op.name);
        const Strands made = result_of(op, strands);
        CHECK(hash(made) != hash(strands));
        for (Index s = 0; s < strands.size(); ++s) CHECK(made.root(s) == strands.root(s));
        CHECK(strand_statistics(made).not_finite == 0);
    }
}

TEST_CASE("operators do not depend on threads") {
    const Strands strands = rich_hair(1000);
    for (const Operator& op : operators()) {
        CAPTURE(op.name);
        CHECK(hash(result_of(op, strands, threads(1))) == hash(result_of(op, strands, threads(4))));
    }
}

TEST_CASE("operators do not depend on the order of strands") {
    const Strands strands = rich_hair(300);
    std::vector<Index> order;
    for (Index s = 0; s < 300; ++s) order.push_back((7 * s + 100) % 300);
    for (const Operator& op : operators()) {
        CAPTURE(op.name);
        CHECK(hash(result_of(op, select(strands, order))) ==
              hash(select(result_of(op, strands), order)));
    }
}

TEST_CASE("a prefix stays the prefix") {
    const Strands strands = without_group_names(rich_hair(300));
    for (const Operator& op : operators()) {
        CAPTURE(op.name);
        CHECK(hash(result_of(op, prefix(strands, 100))) ==
              hash(prefix(result_of(op, strands), 100)));
    }
}

TEST_CASE("operators leave strands alone that they cannot move") {
    const double nan = std::nan("");
    Strands odd = strands_of({{{1, 1, 1}},
                              {{1, 1, 1}, {1, 1, 1}},
                              {{0, 0, 0}, {0, nan, 0}},
                              {{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, {0, 0.5, 0}}});
    for (const Operator& op : operators()) {
        CAPTURE(op.name);
        const Strands made = result_of(op, odd);
        CHECK(strand_statistics(made).not_finite == 1);
        CHECK(same_points(made.strand(0), odd.strand(0)));
        CHECK(result_of(op, Strands()).empty());
    }
}

TEST_CASE("operators that are cancelled change nothing") {
    Strands strands = random_hair(300);
    const std::uint64_t before = hash(strands);
    const Context context;
    context.cancel();
    for (const Operator& op : operators()) {
        CAPTURE(op.name);
        CHECK(error_of([&] { op.run(strands, context); }).code() == ErrorCode::cancelled);
        CHECK(hash(strands) == before);
    }
}

TEST_CASE("taper narrows towards the tip and moves no point") {
    Strands strands = random_hair(10);
    const Strands before = strands;
    taper(strands, {0.25, 0.5, 1.0});
    CHECK(std::equal(before.points().begin(), before.points().end(), strands.points().begin()));
    CHECK(strands.widths().factor(0.0) == 1.0f);
    CHECK(strands.widths().factor(0.5) == 1.0f);
    CHECK(strands.widths().factor(0.75) == doctest::Approx(0.625));
    CHECK(strands.widths().factor(1.0) == 0.25f);
    taper(strands, {0.5, 0.0, 1.0});
    CHECK(strands.widths().factor(1.0) == 0.125f);
    CHECK(error_of([&] { taper(strands, {0.0, 0.0, 1.0}); }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { taper(strands, {0.5, 1.0, 1.0}); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("smoothing makes turns smaller and keeps tips") {
    Strands strands = random_hair(50);
    const Strands before = strands;
    smooth(strands, {5, 0.5});
    CHECK(strand_statistics(strands).max_turn < strand_statistics(before).max_turn);
    for (Index s = 0; s < strands.size(); ++s) {
        const Index tip = strands.point_count(s) - 1;
        CHECK(strands.strand(s).col(tip) == before.strand(s).col(tip));
    }
    CHECK(error_of([&] { smooth(strands, {-1, 0.5}); }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { smooth(strands, {1, 0.0}); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("smoothing strands for ever can be cancelled, and then moves nothing") {
    Strands strands = random_hair(3);
    const std::uint64_t before = hash(strands);
    const Context context;
    std::thread canceller([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        context.cancel();
    });
    const Error error = error_of([&] {
        smooth(strands, {std::numeric_limits<Index>::max(), 0.5}, context);
    });
    canceller.join();
    CHECK(error.code() == ErrorCode::cancelled);
    CHECK(hash(strands) == before);
}

TEST_CASE("smoothing a straight strand of even steps changes nothing") {
    Strands line = strands_of({{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}}});
    const std::uint64_t before = hash(line);
    smooth(line);
    CHECK(hash(line) == before);
}
