#include "kernel/hair/comb.h"

#include <doctest/doctest.h>

#include <limits>

#include "kernel/hair/curve/curve.h"
#include "tests/unit/hair/style_scenes.h"
#include "tests/unit/support.h"

namespace lissom {
namespace {

std::vector<Vec3> down_the_side(const Hairstyle& style, double azimuth) {
    return {test::over(style, azimuth, 60, 0.01), test::over(style, azimuth, 30, 0.02),
            test::over(style, azimuth, 0, 0.02), test::over(style, azimuth, -30, 0.02)};
}

std::vector<Vec3> to_the_back(const Hairstyle& style, double from, double to) {
    std::vector<Vec3> stroke;
    for (double azimuth = from; azimuth <= to; azimuth += 10) {
        stroke.push_back(test::over(style, azimuth, 20, 0.02));
    }
    return stroke;
}

}  // namespace

TEST_CASE("comb: a stream beside the stroke turns to it there, keeps its root and its directions") {
    std::vector<Vec3> stream, stroke;
    for (int i = 0; i <= 30; ++i) stream.emplace_back(0.0, -0.01 * i, 0.0);
    for (int i = 0; i <= 10; ++i) stroke.emplace_back(0.01 * i - 0.03, -0.12 - 0.01 * i, 0.0);
    const auto bent = combed_stream(stream, stroke, 0.04);
    REQUIRE(bent.has_value());
    REQUIRE(bent->size() == stream.size());
    CHECK(bent->front() == stream.front());
    CHECK(curve_length(*bent) == doctest::Approx(curve_length(stream)));
    const Vec3 beside = ((*bent)[16] - (*bent)[15]).normalized();
    CHECK(beside.dot(Vec3(1, -1, 0).normalized()) > 0.999);
    const Vec3 beyond = ((*bent)[30] - (*bent)[29]).normalized();
    CHECK(beyond.dot(-Vec3::UnitY()) == doctest::Approx(1.0));
    CHECK(bent->back().x() > 0.02);
}

TEST_CASE("comb: streams out of reach, and those that run against the stroke, stay") {
    const std::vector<Vec3> stream = {Vec3(0, 0, 0), Vec3(0, -0.1, 0), Vec3(0, -0.2, 0)};
    const std::vector<Vec3> far = {Vec3(0.05, 0, 0), Vec3(0.05, -0.2, 0.01)};
    CHECK_FALSE(combed_stream(stream, far, 0.04).has_value());
    const std::vector<Vec3> against = {Vec3(0.01, -0.2, 0), Vec3(0.01, 0, 0)};
    CHECK_FALSE(combed_stream(stream, against, 0.04).has_value());
}

TEST_CASE("comb: afterwards hair follows the stroke, and a second time nothing changes") {
    for (const CombBy by : {CombBy::least, CombBy::bend, CombBy::add}) {
        Hairstyle style = test::small_style();
        for (const double azimuth : {-90.0, -50.0, 60.0, 90.0, 120.0}) {
            style.add(test::stream(down_the_side(style, azimuth)));
        }
        const auto stroke = to_the_back(style, 70, 130);
        CombOptions options;
        options.by = by;
        const CombReport report = comb(style, stroke, options);
        CHECK(report.before > 40 * kDegree);
        CHECK(report.after < 0.5 * report.before);
        CHECK(report.change > 0.0);
        if (by == CombBy::bend) CHECK(report.bent.size() >= 2);
        if (report.after > options.tolerance) continue;
        const StyleInputs inputs = style.inputs();
        const CombReport again = comb(style, stroke, options);
        CHECK(again.bent.empty());
        CHECK_FALSE(again.added.has_value());
        CHECK(style.inputs() == inputs);
    }
}

TEST_CASE("comb: the least change is no greater than bending or adding that explain as well") {
    const auto made = [](CombBy by, CombReport& report) {
        Hairstyle style = test::small_style();
        style.add(test::stream(down_the_side(style, 60)));
        style.add(test::stream(down_the_side(style, 100)));
        CombOptions options;
        options.by = by;
        report = comb(style, to_the_back(style, 60, 110), options);
    };
    CombReport least, bent, added;
    made(CombBy::least, least);
    made(CombBy::bend, bent);
    made(CombBy::add, added);
    const double enough = std::max(15 * kDegree, least.after);
    CHECK((bent.after <= enough || added.after <= enough));
    if (bent.after <= enough) CHECK(least.change <= bent.change + 1e-9);
    if (added.after <= enough) CHECK(least.change <= added.change + 1e-9);
}

TEST_CASE("comb: of bending and adding that both explain a stroke, what changes less is taken") {
    struct Slant {
        double azimuth, by;
        bool bends;
    };
    for (const Slant slant : {Slant{100.0, 20.0, true}, Slant{80.0, 10.0, false}}) {
        const auto made = [&](CombBy by) {
            Hairstyle style = test::small_style();
            style.add(test::stream(down_the_side(style, slant.azimuth)));
            std::vector<Vec3> stroke;
            for (int i = 0; i <= 6; ++i) {
                const double azimuth = slant.azimuth + slant.by * i / 6.0;
                stroke.push_back(test::over(style, azimuth, 30 - 8 * i, 0.02));
            }
            CombOptions options;
            options.by = by;
            return comb(style, stroke, options);
        };
        const CombReport least = made(CombBy::least), bent = made(CombBy::bend),
                         added = made(CombBy::add);
        const double tolerance = CombOptions{}.tolerance;
        REQUIRE((bent.after < tolerance && added.after < tolerance));
        REQUIRE((bent.change < added.change) == slant.bends);
        CHECK(least.bent == (slant.bends ? bent.bent : added.bent));
        CHECK(least.added.has_value() == !slant.bends);
        CHECK(least.change == doctest::Approx(std::min(bent.change, added.change)));
    }
}

TEST_CASE("comb: what lies within reach of the stroke does not count as changed") {
    double before = std::numeric_limits<double>::infinity();
    for (const double reach : {0.02, 0.06, 0.12, 5.0}) {
        Hairstyle style = test::small_style();
        style.add(test::stream(down_the_side(style, 90)));
        CombOptions options;
        options.by = CombBy::add;
        options.reach = reach;
        const CombReport report = comb(style, to_the_back(style, 60, 120), options);
        CHECK(report.added.has_value());
        CHECK(report.change <= before);
        before = report.change;
    }
    CHECK(before == 0.0);
}

TEST_CASE("comb: what is refused leaves the style as it was") {
    Hairstyle style = test::small_style();
    style.add(test::stream(down_the_side(style, 90)));
    const StyleInputs inputs = style.inputs();
    const auto code = [&](std::vector<Vec3> stroke, const CombOptions& options) {
        return test::error_of([&] { comb(style, stroke, options); }).code();
    };
    CombOptions bend;
    bend.by = CombBy::bend;
    CHECK(code(to_the_back(style, -100, -40), bend) == ErrorCode::invalid_argument);
    const Vec3 p = test::over(style, 90, 20, 0.02);
    CHECK(code({p, p + Vec3(0.001, 0, 0)}, {}) == ErrorCode::invalid_argument);
    CHECK(code({p, Vec3::Constant(std::numeric_limits<double>::quiet_NaN())}, {}) ==
          ErrorCode::not_finite);
    CombOptions bad;
    bad.reach = -1.0;
    CHECK(code(to_the_back(style, 60, 100), bad) == ErrorCode::invalid_argument);
    CHECK(style.inputs() == inputs);
}

}  // namespace lissom
