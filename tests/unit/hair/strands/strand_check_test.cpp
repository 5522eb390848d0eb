#include "kernel/hair/strands/strand_check.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "tests/unit/hair/strands/strand_support.h"
#include "tests/unit/support.h"

namespace lissom::test {
namespace {

constexpr double kBall = 0.1;

double to_ball(const Vec3& p) {
    return p.norm() - kBall;
}

// Hair without faults on the upper half of a ball of 10 cm.
Strands good_hair(Index count = 400, Index points = 8) {
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < count; ++s) {
        const double up = 0.1 + 0.85 * std::fmod(0.618034 * (s + 1), 1.0);
        const double turn = 2.0 * kPi * std::fmod(0.754878 * s, 1.0);
        const Vec3 out(std::sqrt(1.0 - up * up) * std::cos(turn), up,
                       std::sqrt(1.0 - up * up) * std::sin(turn));
        std::vector<Vec3> list;
        for (Index k = 0; k < points; ++k) list.push_back((kBall + 0.08 * k / (points - 1)) * out);
        lists.push_back(list);
    }
    Strands hair = strands_of(lists);
    StrandRoots roots;
    roots.faces.assign(at(count), 0);
    roots.barycentrics.assign(at(count), Eigen::Vector3f::Constant(1.0f / 3.0f));
    for (Index s = 0; s < count; ++s) {
        roots.uvs.emplace_back(float(s) / float(count), 0.5f);
    }
    hair.set_roots(roots);
    return hair;
}

StrandCheckOptions for_target(StrandTarget target) {
    StrandCheckOptions options;
    options.target = target;
    options.distance = to_ball;
    return options;
}

struct Planted {
    StrandFault fault;
    std::function<void(Strands&)> plant;
    // Empty for faults of all hair.
    std::vector<Index> strands;
};

void scale_points(Strands& hair, float factor) {
    for (float& x : hair.edit_points()) x *= factor;
}

// Faults that are planted into hair of 400 strands; others may follow from them.
std::vector<Planted> planted_faults() {
    return {
        {StrandFault::not_finite,
         [](Strands& h) { h.edit_strand(7)(1, 3) = std::numeric_limits<float>::quiet_NaN(); },
         {7}},
        {StrandFault::no_length,
         [](Strands& h) { h.edit_strand(9).colwise() = Eigen::Vector3f(h.root(9)); },
         {9}},
        {StrandFault::no_widths,
         [](Strands& h) {
             StrandWidths widths;
             widths.domain = StrandDomain::strand;
             widths.values.assign(at(h.size()), kHairWidth);
             widths.values[3] = 0.0f;
             widths.values[5] = -1.0f;
             h.set_widths(widths);
         },
         {3, 5}},
        {StrandFault::no_root_uvs,
         [](Strands& h) {
             StrandRoots roots = h.roots();
             roots.uvs.clear();
             h.set_roots(roots);
         },
         {}},
        {StrandFault::off_head,
         [](Strands& h) { h.edit_strand(11).row(1).array() += 0.02f; },
         {11}},
        {StrandFault::inside_head, [](Strands& h) { h.edit_strand(13).col(7).setZero(); }, {13}},
        {StrandFault::duplicate_roots,
         [](Strands& h) { h.edit_strand(21).col(0) = h.root(20); },
         {21}},
        {StrandFault::wrong_unit, [](Strands& h) { scale_points(h, 100.0f); }, {}},
        {StrandFault::wrong_axis,
         [](Strands& h) {
             for (Index s = 0; s < h.size(); ++s) {
                 const Eigen::Matrix3Xf old = h.strand(s);
                 h.edit_strand(s).row(1) = -old.row(2);
                 h.edit_strand(s).row(2) = old.row(1);
             }
         },
         {}},
        {StrandFault::lost_guide,
         [](Strands& h) {
             StrandGuides guides;
             guides.ids.assign(at(h.size()), 0);
             guides.arcs.assign(at(h.size()), 0.05f);
             guides.ids[2] = 4000;
             h.set_guides(guides);
         },
         {2}},
        {StrandFault::short_guide,
         [](Strands& h) {
             StrandGuides guides;
             guides.ids.assign(at(h.size()), 0);
             guides.arcs.assign(at(h.size()), 0.05f);
             guides.arcs[6] = 0.5f;
             h.set_guides(guides);
         },
         {6}},
    };
}

TEST_CASE("hair checks: none is found in hair without faults, for any target") {
    const Strands hair = good_hair();
    for (const StrandTarget target :
         {StrandTarget::unreal, StrandTarget::unity, StrandTarget::godot, StrandTarget::film}) {
        CHECK(check_strands(hair, for_target(target)).empty());
    }
    CHECK(check_strands({}, for_target(StrandTarget::unreal)).empty());
}

TEST_CASE("hair checks: each planted fault is found in its strands, alone where it can be") {
    for (const Planted& planted : planted_faults()) {
        CAPTURE(static_cast<int>(planted.fault));
        Strands hair = good_hair();
        planted.plant(hair);
        const auto found = check_strands(hair, for_target(StrandTarget::unreal));
        const auto it = std::find_if(found.begin(), found.end(), [&](const StrandCheckFinding& f) {
            return f.fault == planted.fault;
        });
        REQUIRE(it != found.end());
        CHECK(it->strands == planted.strands);
        CHECK(it->count == (planted.strands.empty() ? hair.size() : count_of(planted.strands)));
        CHECK(it->message.size() > 10);
        const bool moves_roots = planted.fault == StrandFault::wrong_unit ||
                                 planted.fault == StrandFault::wrong_axis ||
                                 planted.fault == StrandFault::duplicate_roots;
        if (!moves_roots) CHECK(found.size() == 1);
    }
}

TEST_CASE("hair checks: limits are those of the target") {
    CHECK(check_strands(good_hair(400, 2), for_target(StrandTarget::unreal)).empty());
    const auto few = check_strands(good_hair(400, 2), for_target(StrandTarget::unity));
    REQUIRE(few.size() == 1);
    CHECK(few[0].fault == StrandFault::few_points);
    CHECK(few[0].count == 400);
    for (const auto& [target, limit] :
         {std::pair(StrandTarget::unreal, 255), std::pair(StrandTarget::unity, 128)}) {
        CHECK(check_strands(good_hair(120, limit), for_target(target)).empty());
        const auto many = check_strands(good_hair(120, limit + 1), for_target(target));
        REQUIRE(many.size() == 1);
        CHECK(many[0].fault == StrandFault::many_points);
        CHECK(check_strands(good_hair(120, limit + 1), for_target(StrandTarget::film)).empty());
    }
    Strands large = good_hair(70000, 3);
    const auto found = check_strands(large, for_target(StrandTarget::unity));
    REQUIRE(found.size() == 1);
    CHECK(found[0].fault == StrandFault::large_group);
    CHECK(found[0].count == 70000);
    std::vector<Index> groups;
    for (Index s = 0; s < large.size(); ++s) groups.push_back(s % 2);
    large.set_groups(groups, {"left", "right"});
    CHECK(check_strands(large, for_target(StrandTarget::unity)).empty());
}

TEST_CASE("hair checks: triangles, distances, threads") {
    StrandCheckOptions options = for_target(StrandTarget::godot);
    options.triangles = 1000;
    CHECK(check_strands(good_hair(), options).empty());
    options.triangles = 1000000;
    const auto found = check_strands(good_hair(), options);
    REQUIRE(found.size() == 1);
    CHECK(found[0].fault == StrandFault::many_triangles);
    CHECK(found[0].count == 1000000);
    for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
        options.depth = bad;
        const Error error = error_of([&] { check_strands(good_hair(), options); });
        CHECK(error.code() == ErrorCode::invalid_argument);
    }
}

}  // namespace
}  // namespace lissom::test
