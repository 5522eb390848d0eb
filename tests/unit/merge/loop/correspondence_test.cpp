#include "kernel/merge/loop/correspondence.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
#include <optional>

#include "kernel/core/error.h"
#include "tests/unit/shapes.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Loop ring(const Mesh& mesh, Index count) {
    std::vector<Index> ids(static_cast<std::size_t>(count));
    std::iota(ids.begin(), ids.end(), 0);
    return Loop(mesh, ids);
}

std::optional<Error> error_of(const Loop& source, const Loop& target, std::vector<KeyPair> keys) {
    try {
        key_parameters(source, target, keys);
    } catch (const Error& error) {
        return error;
    }
    return std::nullopt;
}

double parameter(const Loop& loop, const LoopPoint& place, double from) {
    const double u = loop.parameter_of(place) - from;
    return u - std::floor(u);
}

// Every place follows the one before, around once.
void check_order(const Loop& loop, const std::vector<LoopPoint>& places) {
    const double first = loop.parameter_of(places.front());
    double last = 0.0;
    for (std::size_t k = 1; k < places.size(); ++k) {
        const double u = parameter(loop, places[k], first);
        CHECK(u >= last);
        last = u;
    }
}

}  // namespace

TEST_CASE("one key turns one loop against the other; between keys arc length decides") {
    const Mesh a = round_tube(60, 3), b = round_tube(90, 3);
    const Loop source = ring(a, 60), target = ring(b, 90);
    const auto keys = key_parameters(source, target, std::vector<KeyPair>{{Index{10}, Index{60}}});
    const LoopPair pair = corresponding(source, target, keys);
    CHECK(pair.on_target[10] == LoopPoint{60, 0.0});
    CHECK(pair.on_source[60] == LoopPoint{10, 0.0});
    // Vertices at 6 degrees meet every other vertex at 4 degrees.
    CHECK(pair.on_target[12] == LoopPoint{63, 0.0});
    CHECK(pair.on_target[11].segment == 61);
    CHECK(pair.on_target[11].t == doctest::Approx(0.5).epsilon(1e-6));
    check_order(target, pair.on_target);
    check_order(source, pair.on_source);
}

TEST_CASE("several keys: each meets its partner, and stretches follow") {
    const Mesh a = round_tube(48, 3), b = round_tube(131, 3);
    const Loop source = ring(a, 48), target = ring(b, 131);
    const std::vector<KeyPair> keys{{Index{0}, Index{100}},
                                    {Index{30}, Index{10}},
                                    {Index{40}, Vec3(std::cos(3.0), std::sin(3.0), 0.0)}};
    const LoopPair pair = corresponding(source, target, key_parameters(source, target, keys));
    CHECK(pair.on_target[0] == LoopPoint{100, 0.0});
    CHECK(pair.on_target[30] == LoopPoint{10, 0.0});
    const Vec3 third = point_of(target.points(), pair.on_target[40]);
    CHECK((third - Vec3(std::cos(3.0), std::sin(3.0), 0)).norm() < 0.02);
    check_order(target, pair.on_target);
    check_order(source, pair.on_source);
}

TEST_CASE("loops of very different counts: vertices meet at most once, and places agree") {
    for (const auto& [n, m] : std::vector<std::pair<Index, Index>>{{3, 200}, {200, 3}, {37, 41}}) {
        const Mesh a = round_tube(n, 3), b = round_tube(m, 3);
        const Loop source = ring(a, n), target = ring(b, m);
        const LoopPair pair =
            corresponding(source, target, std::vector<ParameterPair>{{0.0, 0.123}});
        REQUIRE(pair.on_target.size() == static_cast<std::size_t>(n));
        REQUIRE(pair.on_source.size() == static_cast<std::size_t>(m));
        check_order(target, pair.on_target);
        check_order(source, pair.on_source);
        for (Index i = 0; i < n; ++i) {
            if (pair.on_target[i].t > 0.0) continue;
            CHECK(pair.on_source[pair.on_target[i].segment] == LoopPoint{i, 0.0});
        }
        for (Index j = 0; j < m; ++j) {
            if (pair.on_source[j].t > 0.0) continue;
            CHECK(pair.on_target[pair.on_source[j].segment] == LoopPoint{j, 0.0});
        }
    }
}

TEST_CASE("keys that contradict each other are refused by name") {
    const Mesh a = round_tube(40, 4), b = round_tube(40, 4);
    const Loop source = ring(a, 40), target = ring(b, 40);
    CHECK(!error_of(source, target,
                    {{Index{0}, Index{0}}, {Index{9}, Index{5}}, {Index{20}, Index{33}}}));
    const auto order = error_of(
        source, target, {{Index{0}, Index{0}}, {Index{20}, Index{10}}, {Index{10}, Index{30}}});
    REQUIRE(order);
    CHECK(order->code() == ErrorCode::key_conflict);
    CHECK(order->message().find("keys ") != std::string::npos);
    const auto off = error_of(source, target, {{Index{50}, Index{0}}});
    REQUIRE(off);
    CHECK(off->code() == ErrorCode::key_conflict);
    CHECK(off->elements().ids == std::vector<Index>{50});
    CHECK(off->elements().count == 1);
    // Ids run with the angle.
    const auto away = error_of(source, target, {{Vec3(0, 9, 0), Index{0}}});
    REQUIRE(away);
    CHECK(away->elements().ids == std::vector<Index>{10});
    CHECK(away->elements().count == 1);
    CHECK(error_of(source, target, {{Index{3}, Index{0}}, {Index{3}, Index{10}}}));
    CHECK(error_of(source, target, {{Index{3}, Index{7}}, {Index{9}, Index{7}}}));
}

TEST_CASE("without snapping every vertex goes to its own place; those that are one still meet") {
    const Mesh a = round_tube(60, 3), b = round_tube(61, 3);
    const Loop source = ring(a, 60), target = ring(b, 61);
    const auto keys = key_parameters(source, target, std::vector<KeyPair>{{Index{0}, Index{0}}});
    const LoopPair snapped = corresponding(source, target, keys);
    const LoopPair raw = corresponding(source, target, keys, false);
    CHECK(raw.on_target[0] == LoopPoint{0, 0.0});
    CHECK(raw.on_source[0] == LoopPoint{0, 0.0});
    Index met = 0;
    for (Index i = 0; i < 60; ++i) {
        met += snapped.on_target[i].t == 0.0 ? 1 : 0;
        const double u = target.parameter_of(raw.on_target[i]);
        CHECK(u == doctest::Approx(source.parameters()[i]).epsilon(1e-9));
    }
    CHECK(met > 20);
    check_order(target, raw.on_target);
    check_order(source, raw.on_source);
}
