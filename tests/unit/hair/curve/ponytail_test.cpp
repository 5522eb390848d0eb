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

namespace {

// A ring of this radius around the spine at a place, as a hand draws it from a view turned by
// `turn` from the spine's direction, on the plane that faces the viewer.
struct DrawnRing {
    double turn = 0.0;
    /// Share of the ring that is missing, or drawn twice where negative.
    double gap = 0.0;
    /// Where the gap is, as an angle around the ring.
    double from = 0.0;
    double jitter = 0.0;
};

constexpr double kRingRadius = 0.017;

std::vector<Vec3> drawn_ring(const DrawnRing& drawn, std::uint32_t seed = 1) {
    test::RandomPoints random(seed);
    const Vec3 view(std::sin(drawn.turn), 0.0, -std::cos(drawn.turn));
    const Vec3 center = kTie + Vec3(0, 0, -0.02);
    std::vector<Vec3> points;
    constexpr int kCount = 60;
    for (int k = 0; k <= kCount; ++k) {
        const double angle = drawn.from + 2.0 * kPi * (1.0 - drawn.gap) * k / kCount;
        const Vec3 from = kRingRadius * Vec3(std::cos(angle), std::sin(angle), 0.0);
        const auto noise = [&] { return random.uniform(-1.7, 1.7) * drawn.jitter; };
        const Vec3 off = from + Vec3(noise(), noise(), noise());
        points.push_back(center + off - off.dot(view) * view);
    }
    return points;
}

double tie_radius(std::vector<Vec3> section) {
    PonytailOptions options;
    options.section = std::move(section);
    return shape_of(straight(), options).tie().radius;
}

std::string shape_refusal(const PonytailOptions& options) {
    return test::error_of([&] { shape_of(straight(), options); }).message();
}

// Along the spine at this distance on one side, from one arc length to another, wavy by `wave`.
std::vector<Vec3> profile(const Vec3& side, double from, double to, double wave = 0.0) {
    std::vector<Vec3> points;
    for (int k = 0; k <= 30; ++k) {
        const double at = from + (to - from) * k / 30;
        const double away = 0.015 + 0.2 * at + wave * std::sin(400.0 * at);
        points.push_back(kTie + Vec3(0, 0, -at) + away * side);
    }
    return points;
}

std::vector<PonytailSection> sections_of(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    PonytailOptions options;
    options.profiles = {a, b};
    return shape_of(straight(), options).sections;
}

void check_alike(const std::vector<PonytailSection>& a, const std::vector<PonytailSection>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        CHECK((a[i].center - b[i].center).norm() < 1e-9);
        CHECK(a[i].radius == Approx(b[i].radius).epsilon(1e-9));
    }
}

std::vector<Vec3> backwards(std::vector<Vec3> points) {
    std::reverse(points.begin(), points.end());
    return points;
}

}  // namespace

TEST_CASE("ponytail: a section is as wide from every side, with gaps, overlaps and jitter") {
    for (const double degrees : {0.0, 15.0, 30.0, 45.0, 60.0, 80.0}) {
        const double turn = degrees * kDegree;
        CHECK(tie_radius(drawn_ring({turn})) == Approx(kRingRadius).epsilon(0.02));
        for (std::uint32_t seed = 1; seed < 6; ++seed) {
            const double from = 1.3 * seed;
            const double jittery = tie_radius(drawn_ring({turn, 0.0, from, 0.0003}, seed));
            CHECK(jittery == Approx(kRingRadius).epsilon(0.07));
            CHECK(tie_radius(drawn_ring({turn, -0.15, from})) == Approx(kRingRadius).epsilon(0.03));
            // A gap at the side of the ring hides some of its width.
            CHECK(tie_radius(drawn_ring({turn, 0.2, from})) == Approx(kRingRadius).epsilon(0.11));
        }
    }
    // Which way it runs, and how densely, does not matter.
    const auto ring = drawn_ring({60.0 * kDegree});
    CHECK(tie_radius(backwards(ring)) == Approx(tie_radius(ring)));
    // It may cross itself.
    auto eight = ring;
    std::reverse(eight.begin() + 20, eight.begin() + 40);
    CHECK(tie_radius(eight) == Approx(kRingRadius).epsilon(0.05));
}

TEST_CASE("ponytail: half a ring is refused, and says how wide it is open") {
    PonytailOptions options;
    for (const double from : {0.0, 0.5 * kPi}) {
        options.section = drawn_ring({0.0, 0.5, from});
        CHECK(shape_refusal(options).find("is open") != std::string::npos);
    }
    options.section = drawn_ring({60.0 * kDegree, 0.5, 0.5 * kPi});
    CHECK(shape_refusal(options).find("is open") != std::string::npos);
    options.section = {kTie + Vec3(0.01, 0, -0.02), kTie + Vec3(-0.01, 0, -0.02)};
    CHECK(ponytail_code_of(straight(), options) == ErrorCode::invalid_argument);
    options.section = drawn_ring({});
    options.section[7].x() = std::nan("");
    CHECK(ponytail_code_of(straight(), options) == ErrorCode::not_finite);
}

TEST_CASE("ponytail: profiles that are swapped, reversed or shifted mean the same") {
    const Vec3 x(1, 0, 0);
    const auto a = profile(x, 0.01, 0.06), b = profile(-x, 0.01, 0.06, 0.001);
    const auto meant = sections_of(a, b);
    check_alike(meant, sections_of(b, a));
    check_alike(meant, sections_of(backwards(a), b));
    check_alike(meant, sections_of(a, backwards(b)));
    // What only one of them has does not count.
    const auto longer = profile(x, 0.0, 0.07);
    const auto shifted = sections_of(longer, b);
    REQUIRE(shifted.size() == meant.size());
    for (std::size_t i = 0; i < meant.size(); ++i) {
        CHECK((shifted[i].center - meant[i].center).norm() < 1e-9);
        CHECK(shifted[i].radius == Approx(meant[i].radius).epsilon(0.01));
    }
    // One given twice is as one alone.
    check_alike(sections_of(a, a), sections_of(a, {}));
    // Points may be as unevenly dense as a slow hand makes them.
    std::vector<Vec3> dense;
    for (std::size_t i = 0; i + 1 < a.size(); ++i) {
        for (int k = 0; k < (i < 15 ? 200 : 1); ++k) {
            dense.push_back(a[i] + (a[i + 1] - a[i]) * k / (i < 15 ? 200 : 1));
        }
    }
    dense.push_back(a.back());
    const auto same = sections_of(dense, b);
    REQUIRE(same.size() == meant.size());
    CHECK(same.back().radius == Approx(meant.back().radius).epsilon(1e-6));
}

TEST_CASE("ponytail: profiles on one side, across the spine or apart are refused") {
    const Vec3 x(1, 0, 0);
    PonytailOptions options;
    options.profiles = {profile(x, 0.01, 0.06), profile(Vec3(0.8, 0.6, 0), 0.01, 0.06)};
    CHECK(shape_refusal(options).find("on one side") != std::string::npos);
    options.profiles = {profile(x, 0.01, 0.03), profile(-x, 0.04, 0.06)};
    CHECK(shape_refusal(options).find("in common") != std::string::npos);
    auto across = profile(x, 0.01, 0.06);
    for (std::size_t i = 0; i < across.size(); ++i) across[i].x() = 0.02 - 0.04 * i / 30;
    options.profiles = {across, {}};
    CHECK(shape_refusal(options).find("crosses its spine") != std::string::npos);
    // The end that meets the spine, as the tip of a tail, may come a little over it.
    auto closing = profile(x, 0.01, 0.07);
    for (std::size_t i = 0; i < closing.size(); ++i) closing[i].x() = 0.02 * (1.0 - i / 28.0);
    options.profiles = {closing, {}};
    CHECK_NOTHROW(shape_of(straight(), options));
    // Around a bend the sides turn with the spine.
    std::vector<Vec3> bend, outer, inner;
    for (int k = 0; k <= 30; ++k) {
        const double angle = kPi * k / 30;
        const Vec3 way(0.0, std::cos(angle), -std::sin(angle));
        bend.push_back(kTie + Vec3(0, -0.05, 0) + 0.05 * way);
        outer.push_back(kTie + Vec3(0, -0.05, 0) + 0.07 * way);
        inner.push_back(kTie + Vec3(0, -0.05, 0) + 0.03 * way);
    }
    options.profiles = {outer, inner};
    CHECK(shape_of(bend, options).tie().radius == Approx(0.02).epsilon(0.02));
    options.profiles = {outer, outer};
    options.profiles[1].front().z() -= 1e-5;
    CHECK(test::error_of([&] { shape_of(bend, options); }).message().find("one side") !=
          std::string::npos);
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

TEST_CASE("ponytail: outside a tail of one width, vectors lean in by grip for every step") {
    PonytailOptions options;
    options.radius = 0.02;
    options.profiles[0] = {kTie + Vec3(0.02, 0, 0), kTie + Vec3(0.02, 0, -0.7 * 0.08)};
    options.spread = options.tightness = 0.0;
    const double d = ponytail_step();
    for (const double grip : {0.0, 1.0, 4.0}) {
        options.grip = grip;
        Index outside = 0;
        for (const GridConstraint& c : ponytail_constraints(straight(), options)) {
            const Vec3 from = test::place_of(test::ball().layout(), c.point) - kTie;
            if (-from.z() < d || -from.z() > 0.7 * 0.08 - d) continue;
            const Vec3 away(from.x(), from.y(), 0.0);
            const double beyond = std::max(0.0, away.norm() - 0.02);
            const Vec3 expected = -Vec3::UnitZ() - grip * beyond / d / 0.02 * away;
            CHECK((c.value.normalized() - expected.normalized()).norm() < 1e-6);
            if (beyond > 0.1 * d) ++outside;
        }
        CHECK(outside > 5);
    }
}

TEST_CASE("ponytail: with any grip points in front of the tie lead into it, without none do") {
    PonytailOptions options;
    options.radius = 0.03;
    const auto in_front = [&](double grip) {
        options.grip = grip;
        std::vector<Index> points;
        for (const GridConstraint& c : ponytail_constraints(straight(), options)) {
            const Vec3 from = test::place_of(test::ball().layout(), c.point) - kTie;
            if (from.z() <= 0.0 || from.head<2>().norm() > 0.02) continue;
            points.push_back(c.point);
            CHECK(c.value.dot(-Vec3::UnitZ()) > 0.0);
        }
        return points;
    };
    const auto usual = in_front(4.0);
    CHECK(!usual.empty());
    for (const double grip : {0.01, 0.5, 1.0}) CHECK(in_front(grip) == usual);
    CHECK(in_front(0.0).empty());
}

TEST_CASE("ponytail: hair spreads on the first half of a tail, and no more behind it") {
    PonytailOptions options;
    options.radius = 0.03;
    options.share = 1.0;
    const auto spreading = ponytail_constraints(straight(), options);
    options.spread = 0.0;
    const auto plain = ponytail_constraints(straight(), options);
    REQUIRE(plain.size() == spreading.size());
    Index wider = 0, same = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        REQUIRE(plain[i].point == spreading[i].point);
        const Vec3 from = test::place_of(test::ball().layout(), plain[i].point) - kTie;
        const Vec3 away(from.x(), from.y(), 0.0);
        if (-from.z() > 0.5 * 0.08) {
            ++same;
            CHECK((plain[i].value - spreading[i].value).norm() < 1e-12);
        } else {
            CHECK(spreading[i].value.dot(away) >= plain[i].value.dot(away) - 1e-12);
            if (spreading[i].value.dot(away) > plain[i].value.dot(away) + 1e-6) ++wider;
        }
    }
    CHECK(wider > 5);
    CHECK(same > 5);
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
