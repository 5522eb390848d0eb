#include "kernel/sketch/stroke_cloud.h"

#include <doctest/doctest.h>

#include <limits>

#include "tests/unit/support.h"

namespace lissom {
namespace {

View front_view() {
    return {Camera({.eye = {0, 0, 5}}), {800.0, 600.0}};
}

// Layers of points at heights z, wide enough for the whole picture but for |x| below `gap`.
std::vector<float> layers(std::initializer_list<double> heights, double gap) {
    std::vector<float> cloud;
    for (const double z : heights) {
        for (double x = -2.0; x <= 2.0; x += 0.02) {
            for (double y = -0.5; y <= 0.5; y += 0.02) {
                if (std::abs(x) < gap) continue;
                for (const double c : {x, y, z}) cloud.push_back(static_cast<float>(c));
            }
        }
    }
    return cloud;
}

std::vector<Vec2> across(int count) {
    std::vector<Vec2> stroke;
    for (int i = 0; i < count; ++i) stroke.emplace_back(150.0 + 500.0 * i / (count - 1), 300.0);
    return stroke;
}

}  // namespace

TEST_CASE("a stroke before a cloud lies on its front, whatever is behind") {
    const auto line = stroke_before_cloud(across(40), front_view(), layers({0.3, 0.0, -1.0}, 0.0));
    REQUIRE(line.size() == 40);
    for (const Vec3& p : line) CHECK(p.z() == doctest::Approx(0.3).epsilon(0.01));
}

TEST_CASE("a stroke before a cloud: a few points that stand out do not count") {
    std::vector<float> cloud = layers({0.0}, 0.0);
    for (double x = -2.0; x <= 2.0; x += 0.5) {
        for (const double c : {x, 0.0, 1.0}) cloud.push_back(static_cast<float>(c));
    }
    for (const Vec3& p : stroke_before_cloud(across(40), front_view(), cloud)) {
        CHECK(p.z() == doctest::Approx(0.0));
    }
}

TEST_CASE("a stroke before a cloud bridges what is empty, and no cloud is refused") {
    const View view = front_view();
    const auto line = stroke_before_cloud(across(40), view, layers({0.2}, 0.4));
    for (const Vec3& p : line) CHECK(p.z() == doctest::Approx(0.2).epsilon(0.01));
    CHECK(test::error_of([&] { stroke_before_cloud(across(9), view, {}); }).code() ==
          ErrorCode::invalid_argument);
    const std::vector<float> behind = {0.0f, 0.0f, 9.0f};
    CHECK(test::error_of([&] { stroke_before_cloud(across(9), view, behind); }).code() ==
          ErrorCode::invalid_argument);
    const std::vector<Vec2> bad = {Vec2::Constant(std::numeric_limits<double>::quiet_NaN())};
    CHECK(test::error_of([&] { stroke_before_cloud(bad, view, layers({0.0}, 0.0)); }).code() ==
          ErrorCode::not_finite);
}

}  // namespace lissom
