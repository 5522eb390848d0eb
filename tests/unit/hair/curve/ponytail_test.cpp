#include "kernel/hair/curve/ponytail.h"

#include "kernel/hair/curve/curve.h"
#include "tests/unit/hair/curve/curve_scenes.h"

using namespace lissom;
using doctest::Approx;

namespace {

const Vec3 kTie(0.0, 0.03, -0.11);

// Straight back from the ball, long enough for a tail.
std::vector<Vec3> straight() {
    return {kTie, kTie + Vec3(0, 0, -0.08)};
}

// A spine that falls close to the ball.
std::vector<Vec3> falling() {
    return {kTie, Vec3(0, 0.02, -0.125), Vec3(0, -0.02, -0.115), Vec3(0, -0.1, -0.1)};
}

std::vector<Vec3> circle(const Vec3& center, double radius, int count = 24) {
    std::vector<Vec3> points;
    for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * kPi * k / count;
        points.push_back(center + radius * Vec3(std::cos(angle), std::sin(angle), 0.0));
    }
    return points;
}

double ponytail_step() {
    return test::ball().layout().step;
}

PonytailShape shape_of(const std::vector<Vec3>& spine, const PonytailOptions& options = {}) {
    return ponytail_shape(spine, ponytail_step(), options);
}

std::vector<GridConstraint> ponytail_constraints(const std::vector<Vec3>& spine,
                                                 const PonytailOptions& options = {}) {
    return ponytail_constraints(test::ball(), shape_of(spine, options), options);
}

ErrorCode ponytail_code_of(const std::vector<Vec3>& spine, const PonytailOptions& options = {}) {
    return test::error_of([&] { ponytail_constraints(spine, options); }).code();
}

}  // namespace

TEST_CASE("ponytail: cross sections from the tie along a share of the spine") {
    PonytailOptions options;
    options.radius = 0.02;
    const PonytailShape shape = shape_of(straight(), options);
    CHECK(shape.first == 0);
    CHECK((shape.tie().center - kTie).norm() < 1e-12);
    CHECK((shape.spine.back() - straight().back()).norm() < 1e-12);
    CHECK((shape.sections.back().center - kTie).norm() == Approx(0.7 * 0.08));
    CHECK(shape.spine[shape.last()] == shape.sections.back().center);
    CHECK(shape.tie().radius == Approx(0.02));
    for (const PonytailSection& s : shape.sections) {
        CHECK((s.direction + Vec3::UnitZ()).norm() < 1e-12);
        CHECK(s.radius >= 0.02 - 1e-12);
        CHECK(s.radius <= 0.04 + 1e-12);
    }
    options.share = 0.0;
    CHECK(shape_of(straight(), options).sections.size() == 1);
    options.share = 1.0;
    CHECK(shape_of(straight(), options).last() + 1 == shape_of(straight(), options).spine.size());
    CHECK(shape_of(straight()).tie().radius == Approx(1.5 * ponytail_step()));
}

TEST_CASE("ponytail: a drawn section tells where the tie is, and how wide") {
    PonytailOptions options;
    options.section = circle(kTie + Vec3(0.001, 0, -0.02), 0.025);
    const PonytailShape shape = shape_of(straight(), options);
    CHECK(shape.tie().center.z() == Approx(kTie.z() - 0.02));
    CHECK(shape.tie().radius == Approx(0.025).epsilon(0.01));
    CHECK(shape.first > 0);
    CHECK(shape.spine.front() == kTie);
    options.radius = 0.018;
    CHECK(shape_of(straight(), options).tie().radius == Approx(0.018));
    options.section = circle(kTie + Vec3(0.05, 0, -0.02), 0.025);
    CHECK(ponytail_code_of(straight(), options) == ErrorCode::invalid_argument);
}

TEST_CASE("ponytail: profiles tell radii, and where sections begin and end") {
    const Vec3 from = kTie + Vec3(0, 0, -0.01), to = kTie + Vec3(0, 0, -0.06);
    PonytailOptions options;
    options.profiles[0] = {from + Vec3(0.02, 0, 0), to + Vec3(0.04, 0, 0)};
    const PonytailShape one = shape_of(straight(), options);
    CHECK((one.tie().center - from).norm() < 1e-9);
    CHECK((one.sections.back().center - to).norm() < 1e-9);
    CHECK(one.tie().radius == Approx(0.02));
    CHECK(one.sections.back().radius == Approx(0.04));
    // The mean of both, whichever way they run.
    options.profiles[1] = {to + Vec3(0, 0.02, 0), from + Vec3(0, 0.02, 0)};
    CHECK(shape_of(straight(), options).sections.back().radius == Approx(0.03));
    // The ratio stays where the radius is given.
    options.radius = 0.01;
    CHECK(shape_of(straight(), options).sections.back().radius == Approx(0.015));
    options.profiles = {};
    options.profiles[0] = {kTie + Vec3(0.02, 0, 0.05), kTie + Vec3(0.02, 0, 0.02)};
    CHECK(ponytail_code_of(straight(), options) == ErrorCode::invalid_argument);
}

TEST_CASE("ponytail: the shape does not depend on how finely the spine is given") {
    const std::vector<Vec3> coarse = smooth_curve(falling(), ponytail_step()),
                            fine = smooth_curve(falling(), 0.05 * ponytail_step());
    const PonytailShape a = shape_of(coarse), b = shape_of(fine);
    REQUIRE(a.sections.size() == b.sections.size());
    for (std::size_t i = 0; i < a.sections.size(); ++i) {
        CHECK((a.sections[i].center - b.sections[i].center).norm() < 0.05 * ponytail_step());
        CHECK(a.sections[i].radius == Approx(b.sections[i].radius).epsilon(0.01));
    }
}

TEST_CASE("ponytail: three kinds of vectors") {
    PonytailOptions options;
    options.radius = 0.02;
    options.profiles[0] = {kTie + Vec3(0.02, 0, 0), kTie + Vec3(0.02, 0, -0.7 * 0.08)};
    options.grip = options.spread = 0.0;
    const double d = ponytail_step();
    const auto all = ponytail_constraints(straight(), options);
    CHECK(test::ascending(all));
    Index along = 0, to_center = 0, vanishing = 0;
    for (const GridConstraint& c : all) {
        const Vec3 at = test::place_of(test::ball().layout(), c.point), from = at - kTie;
        const double behind = -from.z(), aside = from.head<2>().norm();
        CHECK(!test::ball().inside(at));
        if (std::abs(c.value.norm() - 0.6) < 1e-9 && behind < d && aside > 0.02) {
            ++to_center;
            CHECK((c.value + 0.6 * from.normalized()).norm() < 1e-9);
            CHECK(aside >= 1.3 * 0.02);
            CHECK(aside <= 1.3 * 0.02 + 2.5 * d);
            CHECK(behind >= -1.5 * d);
            CHECK(behind <= 0.5 * d);
        } else if (behind < 0.7 * 0.08 + 0.5 * d) {
            ++along;
            CHECK((c.value + Vec3::UnitZ()).norm() < 0.01);
            CHECK(aside <= 0.02 + 0.6 * d);
            CHECK(behind >= 0.0);
        } else {
            CHECK((c.value.normalized() + Vec3::UnitZ()).norm() <
                  (c.value.norm() > 0.0 ? 1e-9 : 2));
            CHECK(aside <= 1.8 * d);
            if (c.value.norm() < 0.9) ++vanishing;
        }
    }
    CHECK(along > 20);
    CHECK(to_center > 20);
    CHECK(vanishing > 0);
    options.tightness = 0.0;
    CHECK(static_cast<Index>(ponytail_constraints(straight(), options).size()) ==
          static_cast<Index>(all.size()) - to_center);
}

TEST_CASE("ponytail: mirror images, and vectors no longer than one") {
    for (const auto& spine : {straight(), falling()}) {
        const auto all = ponytail_constraints(spine);
        CHECK(test::asymmetry(test::ball().layout(), all) < 1e-9);
        for (const GridConstraint& c : all) CHECK(c.value.norm() <= 1.0 + 1e-12);
    }
}

TEST_CASE("ponytail: the outline holds hair in, and hair inside spreads") {
    PonytailOptions options;
    options.radius = 0.03;
    options.fullness = 0.0;
    options.share = 1.0;
    Index inside = 0, outside = 0;
    for (const GridConstraint& c : ponytail_constraints(straight(), options)) {
        const Vec3 from = test::place_of(test::ball().layout(), c.point) - kTie;
        const Vec3 away(from.x(), from.y(), 0.0);
        // Behind the ring, on the first half of the tail.
        if (-from.z() < 0.6 * ponytail_step() || -from.z() > 0.035) continue;
        if (away.norm() < 0.028) {
            ++inside;
            CHECK(c.value.dot(away) > 0.0);
        }
        if (away.norm() > 0.035) {
            ++outside;
            CHECK(c.value.dot(away) < 0.0);
        }
    }
    CHECK(inside > 5);
    CHECK(outside > 5);
}

TEST_CASE("ponytail: a tail leaves the points next to the head to the hair there") {
    const std::vector<Vec3> spine = smooth_curve(falling(), 0.5 * ponytail_step());
    PonytailOptions options;
    options.tightness = 0.0;
    options.clearance = 0.0;
    const auto all = ponytail_constraints(spine, options);
    options.clearance = 0.03;
    const auto fewer = ponytail_constraints(spine, options);
    CHECK(fewer.size() < all.size());
    for (const GridConstraint& c : fewer) {
        const Vec3 at = test::place_of(test::ball().layout(), c.point);
        const bool kept = test::ball().value(at) > 0.03 - 1.8 * ponytail_step() ||
                          (at - kTie).norm() < 0.03 + 0.06;
        CHECK(kept);
    }
}

TEST_CASE("ponytail: bad spines and options are refused") {
    CHECK(ponytail_code_of({}) == ErrorCode::invalid_argument);
    CHECK(ponytail_code_of({kTie}) == ErrorCode::invalid_argument);
    CHECK(ponytail_code_of({kTie, Vec3(0, test::kNaN, 0)}) == ErrorCode::not_finite);
    CHECK(ponytail_code_of({Vec3(5, 5, 5), Vec3(5, 6, 5)}) == ErrorCode::out_of_range);
    CHECK(ponytail_code_of({Vec3(1e200, 0, 0), Vec3(1e200, 1, 0)}) != ErrorCode::internal);
    for (const double bad : {-2.0, test::kNaN}) {
        for (auto number :
             {&PonytailOptions::share, &PonytailOptions::inner, &PonytailOptions::outer,
              &PonytailOptions::tightness, &PonytailOptions::fullness, &PonytailOptions::grip,
              &PonytailOptions::stop_length, &PonytailOptions::weight}) {
            PonytailOptions options;
            options.*number = bad;
            CHECK(ponytail_code_of(straight(), options) == ErrorCode::invalid_argument);
        }
        for (auto length : {&PonytailOptions::radius, &PonytailOptions::ring,
                            &PonytailOptions::lead, &PonytailOptions::clearance}) {
            PonytailOptions options;
            options.*length = bad;
            CHECK(ponytail_code_of(straight(), options) == ErrorCode::invalid_argument);
        }
    }
    PonytailOptions nan;
    nan.section = circle(kTie, 0.02);
    nan.section[3].x() = test::kNaN;
    CHECK(ponytail_code_of(straight(), nan) == ErrorCode::not_finite);
}
