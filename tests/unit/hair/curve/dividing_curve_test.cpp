#include "kernel/hair/curve/dividing_curve.h"

#include "kernel/hair/curve/curve.h"
#include "tests/unit/hair/curve/curve_scenes.h"

using namespace lissom;
using doctest::Approx;

namespace {

struct Line {
    std::vector<Vec3> points, normals;
};

// An arc on the ball in the plane x = `side`, over its top from front to back.
Line arc(double dividing_step, double side = 0.0, double from = -0.8, double to = 0.9) {
    const double radius = std::sqrt(std::pow(test::kBallRadius, 2) - side * side);
    const double count = std::max(1.0, std::round((to - from) * radius / dividing_step));
    Line line;
    for (double k = 0.0; k <= count; k += 1.0) {
        const double angle = from + (to - from) * k / count;
        line.points.emplace_back(side, radius * std::cos(angle), -radius * std::sin(angle));
        line.normals.push_back(line.points.back());
    }
    return line;
}

Line reversed(Line line) {
    std::reverse(line.points.begin(), line.points.end());
    std::reverse(line.normals.begin(), line.normals.end());
    return line;
}

std::vector<GridConstraint> dividing_constraints(const Line& line,
                                                 const DividingOptions& options = {}) {
    return dividing_constraints(test::ball(), line.points, line.normals, options);
}

double dividing_step() {
    return test::ball().layout().step;
}

// Vectors of full length everywhere.
DividingOptions as_thesis() {
    DividingOptions options;
    options.ramp = 0.0;
    return options;
}

struct Found {
    DividingPlace place;
    double distance = 0.0;
    Vec3 value;
};

std::vector<Found> found(const Line& line, const DividingOptions& options) {
    const DividingLine frames(line.points, line.normals);
    std::vector<Found> result;
    for (const GridConstraint& c : dividing_constraints(line, options)) {
        const Vec3 at = test::place_of(test::ball().layout(), c.point);
        result.push_back({frames.place(at), test::ball().value(at), c.value});
    }
    return result;
}

ErrorCode dividing_code_of(const Line& line, const DividingOptions& options = {}) {
    return test::error_of([&] { dividing_constraints(line, options); }).code();
}

}  // namespace

TEST_CASE("dividing: places beside a line, in its frame") {
    const Line line = arc(0.002);
    const DividingLine frames(line.points, line.normals);
    // The right of one who looks from front to back is the left of the head, +x.
    const DividingPlace right = frames.place(Vec3(0.01, 0.1, 0.0));
    CHECK(right.across == Approx(0.01));
    CHECK(right.height == Approx(0.01).epsilon(0.01));
    CHECK((right.tangent + Vec3::UnitZ()).norm() < 1e-3);
    CHECK((right.normal - Vec3::UnitY()).norm() < 1e-3);
    CHECK(right.along == Approx(0.8 / 1.7).epsilon(0.01));
    CHECK(right.beyond == 0.0);
    CHECK(frames.place(Vec3(-0.01, 0.1, 0.0)).across == Approx(-0.01));
    CHECK(frames.place(line.points.back() + Vec3(0, -0.01, -0.01)).beyond > 0.005);
    CHECK(frames.place(line.points.front() + Vec3(0, -0.01, 0.01)).beyond < -0.005);
}

TEST_CASE("dividing: the distance along the skin, for the gap") {
    const Line line = arc(dividing_step());
    const DividingLine frames(line.points, line.normals);
    for (const double angle : {-0.5, 0.03, 0.7}) {
        for (const double across : {0.0, 0.0012, 0.01}) {
            const double rest = std::sqrt(std::pow(test::kBallRadius, 2) - across * across);
            const Vec3 at(across, rest * std::cos(angle), rest * std::sin(angle));
            CHECK(frames.skin_distance(at) == Approx(across).epsilon(0.001));
        }
    }
    // In the plane of the line, on the other side of the head.
    CHECK(frames.skin_distance(Vec3(0, -test::kBallRadius, 0)) > 0.1);
}

TEST_CASE("dividing: hair flows away on both sides, as mirror images") {
    DividingOptions options;
    options.left = options.right = {0.3, 0.9};
    const auto all = dividing_constraints(arc(dividing_step()), options);
    CHECK(all.size() > 50);
    CHECK(test::ascending(all));
    CHECK(test::asymmetry(test::ball().layout(), all) < 1e-12);
    for (const Found& f : found(arc(dividing_step()), options)) {
        CHECK(f.place.across * f.value.dot(f.place.right) > 0.0);
    }
}

TEST_CASE("dividing: unit vectors along the Gaussian, short ones above it") {
    const double d = dividing_step();
    Index along = 0, above = 0;
    for (const Found& f : found(arc(d), as_thesis())) {
        const double u = std::abs(f.place.across), x = (u - d) / d;
        const double g = 0.5 * d * (std::exp(-0.5 * x * x) - std::exp(-0.5));
        CHECK(std::abs(f.place.beyond) <= 0.5 * d);
        if (std::abs(f.distance - g) < 0.8 * d && u < 2.5 * d) {
            ++along;
            CHECK(f.value.norm() == Approx(1.0));
            // The slope of the Gaussian over the ball.
            const Vec3 away = f.place.across > 0.0 ? f.place.right : Vec3(-f.place.right);
            const Vec3 at = f.place.normal * (f.place.height + test::kBallRadius) + u * away;
            const Vec3 normal = at.normalized(), level = (away - away.dot(normal) * normal);
            const double slope = f.value.dot(normal) / f.value.dot(level.normalized());
            CHECK(slope == Approx(-0.5 * x * std::exp(-0.5 * x * x)).epsilon(0.02));
        } else {
            ++above;
            CHECK(f.value.norm() == Approx(0.3));
            CHECK(u < 1.2 * d);
            CHECK(f.distance > 0.0);
            CHECK(f.distance < g + 2.6 * d);
        }
        CHECK(f.distance > -1.2 * d);
    }
    CHECK(along > 30);
    CHECK(above > 10);
}

TEST_CASE("dividing: without separation there is no wall") {
    DividingOptions options = as_thesis();
    options.separation = 0.0;
    const auto all = dividing_constraints(arc(dividing_step()), options);
    CHECK(all.size() < dividing_constraints(arc(dividing_step())).size());
    for (const GridConstraint& c : all) CHECK(c.value.norm() == Approx(1.0));
}

TEST_CASE("dividing: tilts turn the flow to the end of the curve, from one to the other") {
    DividingOptions options = as_thesis();
    options.right = {0.2, 1.2};
    options.height = 0.0;
    for (const Found& f : found(arc(dividing_step()), options)) {
        const double side = f.place.across > 0.0 ? 1.0 : -1.0;
        const double turned =
            std::atan2(f.value.dot(f.place.tangent), side * f.value.dot(f.place.right));
        CHECK(turned == Approx(side > 0.0 ? 0.2 + f.place.along : 0.0).epsilon(0.08));
    }
}

TEST_CASE("dividing: the reverse of a curve with reversed tilts says the same") {
    DividingOptions options, other;
    options.left = {0.1, 0.5};
    options.right = {-0.2, 0.7};
    other.left = {-0.7, 0.2};
    other.right = {-0.5, -0.1};
    const auto forth = dividing_constraints(arc(dividing_step()), options);
    const auto back = dividing_constraints(reversed(arc(dividing_step())), other);
    REQUIRE(forth.size() == back.size());
    for (std::size_t i = 0; i < forth.size(); ++i) {
        CHECK(forth[i].point == back[i].point);
        CHECK((forth[i].value - back[i].value).norm() < 1e-9);
    }
}

TEST_CASE("dividing: a finer curve says nearly the same") {
    const auto coarse = test::by_point(dividing_constraints(arc(dividing_step(), 0.004)));
    const auto fine = test::by_point(dividing_constraints(arc(0.1 * dividing_step(), 0.004)));
    double shared = 0.0;
    for (const auto& [point, value] : coarse) {
        const auto other = fine.find(point);
        if (other == fine.end()) continue;
        shared += 1.0;
        CHECK((value - other->second).norm() < 0.1);
    }
    CHECK(shared > 0.95 * static_cast<double>(std::max(coarse.size(), fine.size())));
}

TEST_CASE("dividing: points on the plane belong to no side") {
    const double d = dividing_step();
    const GridLayout odd{{29, 29, 29}, Vec3::Constant(-14.0 * d), d};
    const DistanceGrid grid(make_sphere({.radius = test::kBallRadius, .segments = 16}), odd);
    const Line line = arc(d);
    const auto all = dividing_constraints(grid, line.points, line.normals, as_thesis());
    CHECK(all.size() > 30);
    for (const GridConstraint& c : all) {
        CHECK(std::abs(test::place_of(odd, c.point).x()) > 0.5 * d);
    }
}

TEST_CASE("dividing: vectors fade evenly to nothing across the line") {
    const double d = dividing_step();
    DividingOptions options;
    options.ramp = 2.0 * d;
    const auto full = found(arc(d), as_thesis()), faded = found(arc(d), options);
    REQUIRE(full.size() == faded.size());
    for (std::size_t i = 0; i < full.size(); ++i) {
        const double u = std::abs(full[i].place.across);
        const double ratio =
            faded[i].value.dot(full[i].place.right) / full[i].value.dot(full[i].place.right);
        CHECK(ratio == Approx(std::min(1.0, u / (2.0 * d))));
    }
}

TEST_CASE("dividing: bad curves and options are refused") {
    const Line good = arc(dividing_step());
    Line line = good;
    line.points[1].y() = test::kNaN;
    CHECK(dividing_code_of(line) == ErrorCode::not_finite);
    line = good;
    line.normals[1].y() = test::kNaN;
    CHECK(dividing_code_of(line) == ErrorCode::not_finite);
    line = good;
    line.normals.pop_back();
    CHECK(dividing_code_of(line) == ErrorCode::invalid_argument);
    CHECK(dividing_code_of({{good.points[0]}, {good.normals[0]}}) == ErrorCode::invalid_argument);
    CHECK(dividing_code_of({}) == ErrorCode::invalid_argument);
    // Straight out of the head.
    CHECK(dividing_code_of({{Vec3(0, 0.09, 0), Vec3(0, 0.12, 0)},
                            {Vec3::UnitY(), Vec3::UnitY()}}) == ErrorCode::invalid_argument);
    line = good;
    for (Vec3& p : line.points) p.y() += 0.08;
    CHECK(dividing_code_of(line) == ErrorCode::out_of_range);
    for (Vec3& p : line.points) p.y() += 1e200;
    CHECK(dividing_code_of(line) == ErrorCode::out_of_range);

    for (const double bad : {-1.0, test::kNaN, 2.0}) {
        DividingOptions options;
        options.separation = bad;
        CHECK(dividing_code_of(good, options) == ErrorCode::invalid_argument);
        options = {};
        options.left.end = bad < 0.0 ? -2.0 : bad;
        CHECK(dividing_code_of(good, options) == ErrorCode::invalid_argument);
        if (bad > 0.0) continue;
        for (auto length : {&DividingOptions::sigma, &DividingOptions::height,
                            &DividingOptions::reach, &DividingOptions::ramp}) {
            options = {};
            options.*length = bad;
            CHECK(dividing_code_of(good, options) == ErrorCode::invalid_argument);
        }
    }
}

TEST_CASE("dividing: a curve shorter than a step still parts hair or says that it does not") {
    const Line line = arc(0.001, 0.004, 0.0, 0.02);
    const auto all = dividing_constraints(line);
    CHECK(!all.empty());
    for (const GridConstraint& c : all) CHECK(c.value.allFinite());
}
