#include "kernel/hair/scalp/hairline_shape.h"

#include "kernel/hair/scalp/scalp.h"
#include "kernel/mesh/shapes/head.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// Degrees by which a changed line lies above the default one.
double rise_of(const HairlineShape& shape, double azimuth) {
    const std::vector<HairlinePoint> before = default_hairline();
    const std::vector<HairlinePoint> after = shaped_hairline(before, shape);
    return (hairline_elevation(after, azimuth * kDegree) -
            hairline_elevation(before, azimuth * kDegree)) /
           kDegree;
}

Vec3 towards(double azimuth, double elevation) {
    const double a = azimuth * kDegree, e = elevation * kDegree;
    return 0.1 * Vec3(std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a));
}

}  // namespace

TEST_CASE("words of a hairdresser change their part of the hairline alone") {
    CHECK(rise_of({}, 20) == 0.0);
    CHECK(shaped_hairline(default_hairline(), {}).size() == default_hairline().size());
    CHECK(rise_of({.recession = 0.02}, 40) > 8.0);
    CHECK(std::abs(rise_of({.recession = 0.02}, 0)) < 0.5);
    CHECK(std::abs(rise_of({.recession = 0.02}, 150)) < 0.5);
    CHECK(rise_of({.peak = 0.015}, 0) < -7.0);
    CHECK(std::abs(rise_of({.peak = 0.015}, 25)) < 0.5);
    CHECK(rise_of({.sideburns = 0.02}, 80) < -9.0);
    CHECK(std::abs(rise_of({.sideburns = 0.02}, 100)) < 0.5);
    CHECK(rise_of({.nape = 0.02}, 175) < -9.0);
    CHECK(rise_of({.nape = -0.02}, 175) > 9.0);
    CHECK(rise_of({.forehead = 0.01}, 10) > 4.0);
}

TEST_CASE("an irregular hairline wanders about the given one, differently on both sides") {
    constexpr double kWander = 0.004, kMostDegrees = kWander / 0.1 / kDegree;
    double sum = 0.0, most = 0.0, differences = 0.0;
    for (int azimuth = -179; azimuth <= 180; ++azimuth) {
        const double rise = rise_of({.irregular = kWander}, azimuth);
        sum += rise / 360.0;
        most = std::max(most, std::abs(rise));
        differences =
            std::max(differences, std::abs(rise - rise_of({.irregular = kWander}, -azimuth)));
    }
    CHECK(std::abs(sum) < 0.1 * kMostDegrees);
    CHECK(most > 0.4 * kMostDegrees);
    CHECK(most < 1.3 * kMostDegrees);
    CHECK(differences > 0.5 * kMostDegrees);
    CHECK(rise_of({.irregular = kWander}, 180) == Approx(rise_of({.irregular = kWander}, -180)));
    CHECK_THROWS_AS(shaped_hairline(default_hairline(), {.irregular = -0.001}), Error);
}

TEST_CASE("a larger recession leaves less hair, the more the more") {
    Mesh head = make_head({.vertices = 3000});
    REQUIRE(head.remove_region("scalp"));
    Index before = head.vertex_count();
    for (const double recession : {0.0, 0.02, 0.05}) {
        ScalpOptions options;
        options.hairline = shaped_hairline(default_hairline(), {.recession = recession});
        const Index now = Scalp(head, options).region().size();
        CHECK(now < before);
        before = now;
    }
}

TEST_CASE("a hairline of one's own counts before the region of the mesh") {
    const Mesh head = make_head({.vertices = 3000});
    CHECK(!Scalp(head).guessed());
    ScalpOptions options;
    options.hairline = shaped_hairline(default_hairline(), {.forehead = 0.02});
    CHECK(Scalp(head, options).guessed());
}

TEST_CASE("the sides of a hairline with negative azimuths differ") {
    std::vector<HairlinePoint> line = {{-1.0, 0.5}, {0.0, 0.5}, {1.0, 0.9}};
    CHECK(hairline_elevation(line, 1.0) == Approx(0.9));
    CHECK(hairline_elevation(line, -1.0) == Approx(0.5));
    ScalpOptions options;
    options.hints = {Vec3::UnitY(), Vec3::UnitZ()};
    options.hairline = line;
    const Scalp scalp(make_sphere({.radius = 0.1, .segments = 32}), options);
    int left = 0, right = 0;
    for (const Index v : scalp.region().vertices()) {
        const double azimuth =
            scalp.direction_of(scalp.tree().positions()[static_cast<std::size_t>(v)]).azimuth;
        left += azimuth > 0.8 && azimuth < 1.2;
        right += azimuth < -0.8 && azimuth > -1.2;
    }
    CHECK(right > left + 5);
}

TEST_CASE("a drawn hairline is passed through, on both sides if it was drawn on one") {
    const std::vector<HairlinePoint> before = default_hairline();
    const std::vector<Vec3> one = {towards(20, 50), towards(30, 55), towards(40, 50)};
    const auto both = drawn_hairline(before, one);
    CHECK(hairline_elevation(both, 30 * kDegree) == Approx(55 * kDegree).epsilon(0.01));
    CHECK(hairline_elevation(both, -30 * kDegree) == Approx(55 * kDegree).epsilon(0.01));
    CHECK(hairline_elevation(both, 120 * kDegree) ==
          Approx(hairline_elevation(before, 120 * kDegree)).epsilon(0.01));
    const std::vector<Vec3> across = {towards(-30, 40), towards(0, 45), towards(30, 60)};
    const auto skew = drawn_hairline(before, across);
    CHECK(hairline_elevation(skew, 28 * kDegree) == Approx(59 * kDegree).epsilon(0.01));
    CHECK(hairline_elevation(skew, -28 * kDegree) == Approx(40.3 * kDegree).epsilon(0.01));
    const std::vector<Vec3> behind = {towards(160, -30), towards(180, -20), towards(-170, -30)};
    const auto nape = drawn_hairline(before, behind);
    CHECK(hairline_elevation(nape, 180 * kDegree) == Approx(-20 * kDegree).epsilon(0.02));
    CHECK(hairline_elevation(nape, 0.0) == Approx(hairline_elevation(before, 0.0)));
}

TEST_CASE("hairlines without sense are refused") {
    const auto code = [](const auto& run) { return test::error_of(run).code(); };
    const std::vector<HairlinePoint> line = default_hairline();
    CHECK(code([&] { (void)shaped_hairline(line, {.peak = 0.2}); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { (void)shaped_hairline(line, {.nape = test::kNaN}); }) ==
          ErrorCode::invalid_argument);
    CHECK(code([&] { (void)shaped_hairline({}, {}); }) == ErrorCode::invalid_argument);
    const std::vector<Vec3> dot = {towards(20, 50), towards(20, 60)}, none;
    CHECK(code([&] { (void)drawn_hairline(line, dot); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { (void)drawn_hairline(line, none); }) == ErrorCode::invalid_argument);
    const std::vector<Vec3> wrong = {towards(20, 50), Vec3(test::kNaN, 0, 0)};
    CHECK(code([&] { (void)drawn_hairline(line, wrong); }) == ErrorCode::not_finite);
}
