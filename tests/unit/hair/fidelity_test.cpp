// Hair to the letter of chapter 4 of the thesis.
#include "kernel/hair/curve/fidelity.h"

#include <algorithm>
#include <set>

#include "kernel/hair/curve/curve.h"
#include "kernel/hair/curve/dividing_curve.h"
#include "kernel/hair/curve/ponytail.h"
#include "kernel/hair/hairstyle.h"
#include "kernel/hair/scalp/roots.h"
#include "kernel/mesh/query/region_select.h"
#include "tests/unit/hair/curve/curve_scenes.h"
#include "tests/unit/hair/style_scenes.h"

using namespace lissom;
using doctest::Approx;

namespace {

double ball_step() {
    return test::ball().layout().step;
}

// A ponytail outside the ball, straight in a direction, and what it constrains.
struct LiteralTail {
    PonytailOptions options = curve_with<Ponytail>(HairFidelity::thesis).options;
    Vec3 direction = -Vec3::UnitZ();

    PonytailShape shape() const {
        const Vec3 tie = (test::kBallRadius + 0.02) * direction.normalized();
        return ponytail_shape(std::vector{tie, Vec3(tie + 0.07 * direction.normalized())},
                              ball_step(), options);
    }
    std::vector<GridConstraint> constraints() const {
        return ponytail_constraints(test::ball(), shape(), options);
    }
};

bool is_kind(const GridConstraint& c, ConstraintKind kind) {
    return c.tag == static_cast<int>(kind);
}

bool same_constraints(const std::vector<GridConstraint>& a, const std::vector<GridConstraint>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const GridConstraint& x, const GridConstraint& y) { return x == y; });
}

// A parting along -z on a plane at the top of the ball, whose right side is at -x or x.
struct FlatParting {
    DividingOptions options = curve_with<DividingCurve>(HairFidelity::thesis).options;
    std::vector<Vec3> points, normals;

    FlatParting() {
        for (double z = 0.03; z > -0.031; z -= ball_step()) {
            points.emplace_back(0.001, test::kBallRadius, z);
            normals.push_back(Vec3::UnitY());
        }
    }
    std::vector<GridConstraint> constraints() const {
        return dividing_constraints(test::ball(), points, normals, options);
    }
};

Hairstyle literal_style() {
    HairstyleOptions options = style_options_with(HairFidelity::thesis);
    options.resolution = 6000;
    return Hairstyle(test::small_head(), test::small_scalp(), options);
}

StyleCurve literal_stream(std::vector<Vec3> points) {
    StreamCurve curve = curve_with<StreamCurve>(HairFidelity::thesis);
    curve.points = std::move(points);
    return {curve};
}

StyleCurve literal_ponytail(const Hairstyle& style) {
    Ponytail curve = curve_with<Ponytail>(HairFidelity::thesis);
    curve.spine = std::get<Ponytail>(test::tail(style).shape).spine;
    return {curve};
}

}  // namespace

TEST_CASE("thesis: the ring of a ponytail lies from 1.3 to 1.9 radii on the plane of its tie") {
    LiteralTail tail;
    for (const Vec3& direction : {Vec3(0, 0, -1), Vec3(1, 0.3, -0.4), Vec3(-0.5, 1, 0.2)}) {
        tail.direction = direction;
        const PonytailSection tie = tail.shape().tie();
        std::set<Index> ring;
        for (const GridConstraint& c : tail.constraints()) {
            if (!is_kind(c, ConstraintKind::gather)) continue;
            ring.insert(c.point);
            const Vec3 from = test::place_of(test::ball().layout(), c.point) - tie.center;
            CHECK((c.value + 0.6 * from.normalized()).norm() < 1e-12);
            CHECK(c.weight == 100.0);
        }
        // All grid points of the region, and no others.
        for (Index p = 0; p < test::ball().layout().size(); ++p) {
            const Vec3 from = test::place_of(test::ball().layout(), p) - tie.center;
            const double height = from.dot(tie.direction);
            const double radius = (from - height * tie.direction).norm() / tie.radius;
            const bool near = std::abs(height) <= 0.5 * ball_step();
            CHECK(ring.contains(p) == (near && radius >= 1.3 && radius <= 1.9));
        }
        CHECK(ring.size() > 5);
    }
}

TEST_CASE("thesis: cross sections and spine of a ponytail follow the surface of revolution") {
    LiteralTail tail;
    tail.options.fullness = 0.0;
    tail.options.share = 0.5;
    Index sections = 0, spine = 0;
    for (const GridConstraint& c : tail.constraints()) {
        CHECK(c.weight == 100.0);
        if (is_kind(c, ConstraintKind::spine)) {
            CHECK((c.value - tail.direction).norm() < 1e-12);
            ++spine;
        }
        if (!is_kind(c, ConstraintKind::section)) continue;
        ++sections;
        CHECK(c.value.norm() == Approx(1.0));
        // Vectors of a tube that gets narrower point at most that much inward.
        CHECK(c.value.dot(tail.direction) > 0.5);
    }
    CHECK(sections > 10);
    CHECK(spine > 4);
}

TEST_CASE("thesis: options of a ponytail count before its defaults") {
    const LiteralTail usual;
    const auto with = [&](const auto& change) {
        LiteralTail tail;
        change(tail.options);
        return tail.constraints();
    };
    const auto literal = usual.constraints();
    // The defaults of the thesis, and those that are not.
    CHECK(same_constraints(literal, with([](auto& o) { o.ring = 0.0; })));
    CHECK(same_constraints(literal, with([](auto& o) { o.lead = 0.5 * ball_step(); })));
    CHECK(same_constraints(literal, with([](auto& o) { o.clearance = 0.0; })));
    CHECK(same_constraints(literal, with([](auto& o) { o.grip = o.spread = 0.0; })));
    CHECK(!same_constraints(literal, with([](auto& o) { o.ring = 2.5 * ball_step(); })));
    CHECK(!same_constraints(literal, with([](auto& o) { o.lead = 1.5 * ball_step(); })));
    CHECK(!same_constraints(literal, with([](auto& o) { o.grip = 4.0; })));
    CHECK(!same_constraints(literal, with([](auto& o) { o.spread = 2.0; })));
    CHECK(!same_constraints(literal, with([](auto& o) { o.fidelity = HairFidelity::lissom; })));
}

TEST_CASE("thesis: a tail along the head leaves hair alone only where it is asked to") {
    const Vec3 tie(0.0, 0.03, -0.115);
    const std::vector<Vec3> spine{tie, Vec3(0, -0.02, -0.105), Vec3(0, -0.08, -0.08)};
    const auto sections = [&](std::optional<double> clearance) {
        PonytailOptions options = curve_with<Ponytail>(HairFidelity::thesis).options;
        options.clearance = clearance;
        const PonytailShape shape = ponytail_shape(spine, ball_step(), options);
        Index low = 0;
        for (const GridConstraint& c : ponytail_constraints(test::ball(), shape, options)) {
            const bool tail = is_kind(c, ConstraintKind::section);
            low += tail && test::ball().values()[static_cast<std::size_t>(c.point)] < 0.0;
        }
        return low;
    };
    CHECK(sections({}) > 0);
    CHECK(sections(0.0) == sections({}));
    CHECK(sections(0.02) < sections({}));
}

TEST_CASE("thesis: a ring without a grid point says what to do") {
    LiteralTail tail;
    tail.options.radius = 0.05 * ball_step();
    const Error error = test::error_of([&] { tail.constraints(); });
    CHECK(error.code() == ErrorCode::invalid_argument);
    for (const char* part :
         {"no grid point", "radius of at least one step", "resolution", "`ring`"}) {
        CHECK_MESSAGE(std::string(error.what()).find(part) != std::string::npos, part);
    }
    tail.options.ring = 2.5 * ball_step();
    CHECK(!tail.constraints().empty());
    tail.options.ring.reset();
    tail.options.tightness = 0.0;
    CHECK(!tail.constraints().empty());
    tail.options = PonytailOptions{};
    tail.options.radius = 0.05 * ball_step();
    CHECK(!tail.constraints().empty());
    // A radius of a step has points in any place.
    test::RandomPoints random(5);
    for (int i = 0; i < 50; ++i) {
        LiteralTail any;
        any.options.radius = ball_step();
        any.direction = random.in_box({Vec3::Constant(-1.0), Vec3::Constant(1.0)});
        CHECK(!any.constraints().empty());
    }
}

TEST_CASE("thesis: stream curves give the tangents of segments, and vanish evenly at their end") {
    const std::vector<Vec3> points = resampled_curve(
        smooth_curve(std::vector{Vec3(0.1, 0.05, 0), Vec3(0.12, 0, 0.02), Vec3(0.1, -0.06, 0.05)},
                     ball_step()),
        ball_step());
    const auto all = stream_constraints(test::ball().layout(), points,
                                        curve_with<StreamCurve>(HairFidelity::thesis).options);
    const double extra = std::ceil(0.04 / ball_step());
    std::set<int> steps;
    for (const GridConstraint& c : all) {
        CHECK(c.weight == 100.0);
        if (is_kind(c, ConstraintKind::stop)) {
            const double left = (1.0 - c.value.norm()) * extra;
            CHECK(left == Approx(std::round(left)));
            steps.insert(static_cast<int>(std::round(left)));
            continue;
        }
        bool found = false;
        for (std::size_t i = 1; i < points.size(); ++i) {
            found = found || (c.value - (points[i] - points[i - 1]).normalized()).norm() < 1e-12;
        }
        CHECK(found);
    }
    CHECK(steps.size() == static_cast<std::size_t>(extra));
    CHECK(*steps.rbegin() == static_cast<int>(extra));
}

TEST_CASE("thesis: vectors beside a dividing curve lie in its tilted planes, along the Gaussian") {
    for (const double tilt : {0.0, 0.4, -0.9}) {
        FlatParting parting;
        parting.options.left = parting.options.right = {tilt, tilt};
        const double d = ball_step();
        Index along = 0, above = 0;
        for (const GridConstraint& c : parting.constraints()) {
            const Vec3 p = test::place_of(test::ball().layout(), c.point) - parting.points[0];
            const double side = p.x() > 0.0 ? 1.0 : -1.0;
            const Vec3 x(side * std::cos(tilt), 0.0, -std::sin(tilt));
            const double u = std::abs(p.x()) / std::cos(tilt), v = p.y();
            const double bell = std::exp(-0.5 * std::pow(u / d - 1.0, 2));
            const double g = 0.5 * d * (bell - std::exp(-0.5));
            CHECK(c.weight == 100.0);
            // Beyond the ends they belong to the last planes.
            const double at = -p.z() - u * std::sin(tilt);
            if (at < 0.0 || at > parting.points[0].z() - parting.points.back().z()) continue;
            if (is_kind(c, ConstraintKind::separation)) {
                CHECK((c.value - 0.3 * x).norm() < 1e-9);
                CHECK(u < 1.2 * d);
                CHECK(v > 0.0);
                ++above;
                continue;
            }
            const double slope = -0.5 * (u / d - 1.0) * bell;
            CHECK((c.value - (x + slope * Vec3::UnitY()).normalized()).norm() < 1e-9);
            CHECK(u < 2.5 * d);
            CHECK(std::abs(v - g) < 0.8 * d);
            ++along;
        }
        CHECK(along > 10);
        CHECK(above > 10);
    }
}

TEST_CASE("thesis: each side of a dividing curve has its own tilt, which changes along it") {
    FlatParting parting;
    parting.options.left = {0.5, 0.5};
    parting.options.right = {0.0, 0.6};
    const double length = (parting.points.back() - parting.points.front()).norm();
    for (const GridConstraint& c : parting.constraints()) {
        if (!is_kind(c, ConstraintKind::separation)) continue;
        const Vec3 p = test::place_of(test::ball().layout(), c.point);
        const double tilt = std::asin(std::clamp(-c.value.z() / 0.3, -1.0, 1.0));
        if (p.x() < parting.points[0].x()) {
            CHECK(tilt == Approx(0.5));
            continue;
        }
        // The plane's origin lies behind the point by its shift along the curve.
        const double u = (p.x() - parting.points[0].x()) / std::cos(tilt);
        const double at = parting.points[0].z() - p.z() - u * std::sin(tilt);
        CHECK(tilt == Approx(0.6 * std::clamp(at / length, 0.0, 1.0)).epsilon(0.03));
    }
    FlatParting ramped;
    ramped.options.ramp = ball_step();
    CHECK(!same_constraints(ramped.constraints(), FlatParting().constraints()));
    ramped.options.ramp = 0.0;
    CHECK(same_constraints(ramped.constraints(), FlatParting().constraints()));
}

TEST_CASE("thesis: roots stand in equal steps of the angles, moved by a quarter of a step") {
    const Mesh& head = test::small_head();
    const Scalp& scalp = *test::small_scalp();
    const std::vector<Root> roots =
        make_roots(head, scalp, {.count = 700, .pattern = RootPattern::steps});
    CHECK(roots.size() == 700);
    const auto off = [](double angle, double step) {
        const double cell = angle / step - 0.5;
        return std::abs(cell - std::round(cell));
    };
    Index found = 0;
    for (int rows = 5; rows < 100; ++rows) {
        const double step = kPi / rows;
        found += std::all_of(roots.begin(), roots.end(), [&](const Root& root) {
            const Vec3 p = scalp.to_metres(root.position);
            return off(std::atan2(p.x(), p.z()) + kPi, step) < 0.251 &&
                   off(std::acos(p.y() / p.norm()), step) < 0.251;
        });
    }
    CHECK(found >= 1);
    // Any number of threads, the same; another seed, others.
    const std::vector<Root> again =
        make_roots(head, scalp, {.count = 700, .pattern = RootPattern::steps}, test::threads(4));
    const std::vector<Root> other =
        make_roots(head, scalp, {.count = 700, .seed = 2, .pattern = RootPattern::steps});
    CHECK(roots[17].position == again[17].position);
    CHECK(roots[17].position != other[17].position);
    CHECK(make_roots(head, scalp, {.count = 0, .pattern = RootPattern::steps}).empty());
}

TEST_CASE("thesis: strands follow the field alone, half a step times the vector a segment") {
    Hairstyle style = literal_style();
    style.add(literal_stream(test::side(style, 1.0)));
    style.add(literal_stream(test::side(style, -1.0)));
    HairOptions options = style.default_hair();
    options.roots.count = 300;
    options.growth.placement = {};
    const Strands hair = style.grow(options);
    const double half = 0.5 * style.layout().step;
    double longest = 0.0;
    Index inside = 0;
    for (Index s = 0; s < hair.size(); ++s) {
        const StrandView strand = hair.strand(s);
        const auto at = [&](Index i) { return style.scalp().to_metres(point_of(strand, i)); };
        for (Index i = 1; i < strand.cols(); ++i) {
            const HairField::Sample here = style.field().sample(at(i - 1));
            longest = std::max(longest, here.direction.norm());
            CHECK((at(i) - at(i - 1) - half * here.direction).norm() < 1e-3 * half);
            if (here.distance < -0.001) ++inside;
        }
    }
    CHECK(longest > 1.0);
    CHECK(inside > 0);
}

TEST_CASE("thesis: a tie names the hair that it catches and leaves its length alone") {
    Hairstyle style = literal_style();
    style.add(literal_stream(test::side(style, 1.0)));
    StyleCurve pony = literal_ponytail(style);
    const CurveId id = style.add(pony);
    HairOptions options = style.default_hair();
    options.roots.count = 2000;
    Strands tied;
    const GrowthReport report = style.grow(options, tied);
    CHECK(std::any_of(report.ties.begin(), report.ties.end(), [](Index tie) { return tie == 0; }));
    CHECK(report.ended_by(StrandEnd::turned) == 0);
    CHECK(report.ended_by(StrandEnd::slow) + report.ended_by(StrandEnd::left_grid) +
              report.ended_by(StrandEnd::segments) + report.ended_by(StrandEnd::length) ==
          2000);
    // A length of the tail is kept to, and chance needs one.
    std::get<Ponytail>(pony.shape).tail_length = 0.02;
    style.set(id, pony);
    Strands cut;
    style.grow(options, cut);
    CHECK(cut.point_count() < tied.point_count());
    std::get<Ponytail>(pony.shape).tail_length.reset();
    std::get<Ponytail>(pony.shape).ragged = 0.3;
    CHECK(test::error_of([&] { style.set(id, pony); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("thesis: the field has the thesis's weights and no tension, by whichever solver") {
    const HairstyleOptions literal = style_options_with(HairFidelity::thesis);
    CHECK(literal.field.boundary == GridBoundary::thesis);
    CHECK(literal.field.tension == 0.0);
    CHECK(literal.resolution == HairstyleOptions{}.resolution);
    HairstyleOptions slow = literal, fast = literal;
    fast.resolution = slow.resolution = 3000;
    slow.field.solver = GridSolver::cholesky;
    Hairstyle a(test::small_head(), test::small_scalp(), fast),
        b(test::small_head(), test::small_scalp(), slow);
    for (Hairstyle* style : {&a, &b}) {
        style->add(literal_stream(test::side(*style, 1.0)));
        style->add(literal_ponytail(*style));
    }
    const std::vector<float> dual = test::field_of(a), factored = test::field_of(b);
    double worst = 0.0;
    for (std::size_t i = 0; i < dual.size(); ++i) {
        worst = std::max(worst, std::abs(static_cast<double>(dual[i]) - factored[i]));
    }
    CHECK(worst < 1e-4);
}

TEST_CASE("thesis: default hair is that of the style's fidelity") {
    CHECK(test::small_style().default_hair().roots == RootOptions{});
    CHECK(test::small_style().default_hair().growth.length == GrowthOptions{}.length);
    const Hairstyle style = literal_style();
    CHECK(style.default_hair().roots.pattern == RootPattern::steps);
    CHECK(style.default_hair().growth.length == longest_hair(style.layout()));
    CHECK(fidelity_of(StyleCurve{curve_with<StreamCurve>(HairFidelity::thesis)}) ==
          HairFidelity::thesis);
    CHECK(fidelity_of(StyleCurve{DividingCurve{}}) == HairFidelity::lissom);
    CHECK(curve_with<Ponytail>(HairFidelity::thesis).ragged == 0.0);
    CHECK(curve_with<Ponytail>(HairFidelity::lissom) == Ponytail{});
}
