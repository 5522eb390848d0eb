// Interpolated, copied and blended hair.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "kernel/core/error.h"
#include "kernel/hair/operators/strand_fill.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_measures.h"
#include "tests/unit/hair/strands/strand_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Strands on a line along x that lie to the right from x = 0 on, and to the left before.
Strands fence(Index count) {
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < count; ++s) {
        const double x = 0.01 * (s - count / 2) + 0.005, lean = x > 0.0 ? 1.0 : -1.0;
        std::vector<Vec3> points;
        for (int k = 0; k <= 8; ++k) points.push_back({x + 0.03 * lean * k, 0.002 * k, 0.0});
        lists.push_back(points);
    }
    return strands_of(lists);
}

Root root_at(const Vec3& position) {
    Root root;
    root.face = 0;
    root.position = position;
    return root;
}

}  // namespace

TEST_CASE(
    "interpolated strands are those of their guides at their roots, and between them elsewhere") {
    const Strands guides = fence(10);
    const Vec3 on = point_of(guides.strand(7), 0), between = on + Vec3(0.004, 0, 0);
    const std::vector<Root> roots{root_at(on), root_at(between)};
    const Strands made = interpolate(guides, roots, {.points = 9});
    REQUIRE(made.size() == 2);
    for (Index k = 0; k < 9; ++k) {
        CHECK((point_of(made.strand(0), k) - point_of(guides.strand(7), k)).norm() < 2e-4);
        CHECK((point_of(made.strand(1), k) - point_of(guides.strand(7), k) - Vec3(0.004, 0, 0))
                  .norm() < 1e-3);
    }
    CHECK(made.roots().faces == std::vector<Index>{0, 0});
}

TEST_CASE("interpolated strands stay on their side of a parting") {
    const std::vector<Root> roots{root_at({0.001, 0, 0}), root_at({-0.001, 0, 0})};
    const Strands made = interpolate(fence(10), roots);
    CHECK(point_of(made.strand(0), 23).x() > 0.2);
    CHECK(point_of(made.strand(1), 23).x() < -0.2);
}

TEST_CASE("interpolation needs guides") {
    const std::vector<Root> roots{root_at(Vec3::Zero())};
    const Strands bare = strands_of({{{0, 0, 0}}, {{1, 0, 0}, {1, 0, 0}}});
    for (const Strands& guides : {Strands(), bare}) {
        CHECK(error_of([&] { interpolate(guides, roots); }).code() == ErrorCode::invalid_argument);
    }
    CHECK(error_of([&] { interpolate(fence(2), roots, {.near = 0}); }).code() ==
          ErrorCode::invalid_argument);
    CHECK(interpolate(fence(2), {}).empty());
}

TEST_CASE("copies lie around their strand and have ids of their own") {
    Strands strands = fence(6);
    const Strands before = strands;
    duplicate(strands, {.copies = 3, .radius = 0.002, .tip = 0.5});
    REQUIRE(strands.size() == 24);
    std::set<std::uint32_t> ids;
    for (Index s = 0; s < 24; ++s) ids.insert(strands.id(s));
    CHECK(ids.size() == 24);
    for (Index s = 0; s < 24; ++s) {
        const StrandView original = before.strand(s % 6);
        CHECK(strands.guides().ids[at(s)] == before.id(s % 6));
        const double apart = (point_of(strands.strand(s), 0) - point_of(original, 0)).norm();
        const double tips = (point_of(strands.strand(s), 8) - point_of(original, 8)).norm();
        CHECK(apart <= 0.002 + 1e-6);
        CHECK(tips == doctest::Approx(0.5 * apart).epsilon(0.01));
    }
    Strands fewer = select(before, std::vector<Index>{4});
    duplicate(fewer, {.copies = 3, .radius = 0.002, .tip = 0.5});
    CHECK(fewer.strand(1) == strands.strand(6 + 4));
    CHECK(error_of([&] { duplicate(strands, {.copies = -1}); }).code() ==
          ErrorCode::invalid_argument);
    CHECK(strands.size() == 24);
}

TEST_CASE("strands without length have no copies, however many are asked for") {
    const Strands before = strands_of({{{0, 0, 0}}, {{1, 0, 0}, {1, 0, 0}}});
    Strands strands = before;
    duplicate(strands, {.copies = std::numeric_limits<Index>::max()});
    CHECK(hash(strands) == hash(before));
}

TEST_CASE("blending makes neighbours alike, and a factor of 0 changes nothing") {
    Strands strands = fence(10);
    for (Index s = 0; s < 10; s += 2) strands.edit_strand(s).row(2) *= 0.0f;
    for (Index s = 1; s < 10; s += 2) {
        for (Index k = 1; k < 9; ++k) strands.edit_strand(s)(2, k) = 0.01f * k;
    }
    const auto differs = [](const Strands& hair) {
        return std::abs(hair.strand(7)(2, 8) - hair.strand(8)(2, 8));
    };
    Strands blended = strands;
    BlendOptions options;
    options.guides = 4;
    options.near = 3;
    blend(blended, options);
    CHECK(differs(blended) < 0.5 * differs(strands));
    for (Index s = 0; s < 10; ++s) CHECK(blended.root(s) == strands.root(s));
    options.factor = 0.0;
    Strands same = strands;
    blend(same, options);
    CHECK(hash(same) == hash(strands));
}
