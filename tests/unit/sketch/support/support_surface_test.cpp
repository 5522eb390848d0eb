// Properties of supporting surfaces and of strokes on them.
#include "kernel/sketch/support/support_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "kernel/sketch/support/support_stroke.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;

namespace {

constexpr PictureSize kPicture{1200, 900};

Camera camera_at(const Vec3& eye, std::optional<double> ortho = std::nullopt) {
    CameraOptions options;
    options.eye = eye;
    options.ortho = ortho;
    return Camera(options);
}

// Turned about the y axis by an angle from the front, 1 away from the origin.
Camera camera_turned(double degrees) {
    return camera_at({std::sin(degrees * kDegree), 0.1, std::cos(degrees * kDegree)});
}

// A lock of hair that falls and swings, .25 long.
std::vector<Vec3> lock(double scale = 1.0, const Vec3& shift = Vec3::Zero()) {
    std::vector<Vec3> points;
    for (int i = 0; i <= 60; ++i) {
        const double t = i / 60.0;
        points.emplace_back(shift + scale * Vec3(0.05 * std::sin(2.0 * t), 0.12 - 0.25 * t,
                                                 0.04 * std::cos(3.0 * t)));
    }
    return points;
}

std::vector<Vec2> image(const std::vector<Vec3>& points, const View& view) {
    std::vector<Vec2> pixels;
    for (const Vec3& point : points) pixels.emplace_back(view.project(point).head<2>());
    return pixels;
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
    return most;
}

template <typename Action>
void expect_error(const Action& action, ErrorCode code, std::string_view part) {
    const Error error = test::error_of(action);
    CHECK(error.code() == code);
    CHECK_MESSAGE(error.message().find(part) != std::string::npos, error.message());
}

}  // namespace

TEST_CASE("a ruled surface looks from its viewpoint like the curve") {
    for (const auto& ortho : {std::optional<double>(), std::optional(0.6)}) {
        const View view{camera_at({0.2, 0.1, 1.0}, ortho), kPicture};
        const SupportSurface surface(lock(), view.camera, {.mode = SupportMode::ruled});
        for (const auto& ruling : surface.rulings()) {
            const Vec2 center = view.project(ruling.center).head<2>();
            for (const double side : {-1.0, -0.4, 1.0}) {
                const Vec3 point = ruling.center + side * ruling.reach * ruling.direction;
                CHECK((view.project(point).head<2>() - center).norm() < 1e-9);
            }
        }
        CHECK(surface.seen_from(view.camera) < 1e-6);
        CHECK(surface.seen_from(camera_turned(95.0)) > 0.6);
    }
}

TEST_CASE("a strip is across the curve and the line of sight, and faces its viewpoint") {
    const Camera camera = camera_at({0.2, 0.1, 1.0});
    const std::vector<Vec3> curve = lock();
    const SupportSurface surface(curve, camera);
    for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
        const auto& ruling = surface.rulings()[i];
        const Vec3 along =
            (curve[i + 1] - curve[i]).normalized() + (curve[i] - curve[i - 1]).normalized();
        CHECK(std::abs(ruling.direction.dot(along.normalized())) < 1e-6);
        CHECK(std::abs(ruling.direction.dot((curve[i] - camera.eye()).normalized())) < 1e-6);
        CHECK(ruling.direction.dot(surface.rulings()[i - 1].direction) > 0.0);
    }
    CHECK(surface.seen_from(camera) > 0.8);
}

TEST_CASE("drawing the image of a curve on its surfaces gives the curve") {
    test::Random random(11);
    for (int trial = 0; trial < 40; ++trial) {
        const double scale = std::pow(10.0, random.uniform(-3.0, 3.0));
        const Vec3 shift = trial % 2 ? Vec3(3e3 * scale * random.direction()) : Vec3::Zero();
        const std::vector<Vec3> curve = lock(scale, shift);
        const auto camera = [&](double degrees) {
            CameraOptions options;
            options.eye = shift + scale * camera_turned(degrees).eye();
            options.target = shift;
            return Camera(options);
        };
        for (const auto mode : {SupportMode::ruled, SupportMode::strip}) {
            const double turn = mode == SupportMode::ruled ? random.uniform(45.0, 120.0)
                                                           : random.uniform(-45.0, 45.0);
            const SupportSurface surface(curve, camera(0.0),
                                         {mode, 0.03 * scale, 0.035 * scale, 0.015 * scale});
            const View view{camera(turn), kPicture};
            const auto stroke = stroke_on_support(image(curve, view), view, surface);
            CHECK(stroke.points.size() == curve.size());
            CHECK(farthest(stroke.points, curve) < 2e-4 * scale);
        }
    }
}

TEST_CASE("a stroke goes on beside the surface with the slope of its last part, which fades") {
    const std::vector<Vec3> curve{{0.0, 0.1, 0.0}, {0.0, 0.0, 0.0}, {0.0, -0.1, 0.05}};
    const SupportSurface surface(curve, camera_turned(0.0));
    const View view{camera_turned(40.0), kPicture};
    std::vector<Vec3> meant;
    for (int i = 0; i <= 100; ++i) meant.emplace_back(0.0, -0.002 * i, i < 50 ? 0.001 * i : 0.05);
    const auto stroke = stroke_on_support(image(meant, view), view, surface);
    CHECK(stroke.beside > 20);
    CHECK(stroke.beside < 60);
    for (std::size_t i = 1; i < stroke.points.size(); ++i) {
        CHECK((stroke.points[i] - stroke.points[i - 1]).norm() < 0.006);
    }
    CHECK(farthest(stroke.points, meant) < 0.06);
}

TEST_CASE("a strip is no wider than the bend of its curve") {
    std::vector<Vec3> ring;
    for (int i = 0; i <= 40; ++i) {
        const double angle = 2.0 * kPi * i / 60;
        ring.emplace_back(0.02 * std::cos(angle), 0.02 * std::sin(angle), 0.0);
    }
    const SupportSurface surface(ring, camera_at({0.0, 0.0, 1.0}), {.width = 0.03});
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        CHECK(surface.rulings()[i].reach == doctest::Approx(0.016).epsilon(0.01));
    }
}

TEST_CASE("a curve seen end-on is told, and its surface neither flips nor breaks") {
    std::vector<Vec3> towards;
    for (int i = 0; i <= 30; ++i) towards.emplace_back(0.001 * std::sin(i), 0.0, -0.3 + 0.02 * i);
    const Camera camera = camera_at({0.0, 0.0, 1.0});
    const SupportSurface surface(towards, camera);
    CHECK(surface.end_on() > 0.9);
    for (std::size_t i = 1; i < surface.rulings().size(); ++i) {
        const auto &a = surface.rulings()[i - 1], &b = surface.rulings()[i];
        CHECK(b.direction.norm() == doctest::Approx(1.0));
        CHECK(a.direction.dot(b.direction) > 0.0);
    }
    CHECK(SupportSurface(lock(), camera_turned(0.0)).end_on() < 0.2);
}

TEST_CASE("a stroke as deep as a curve") {
    const std::vector<Vec3> curve = lock();
    const View view{camera_turned(20.0), kPicture};
    CHECK(farthest(stroke_beside_curve(image(curve, view), view, curve), curve) < 1e-9);
    auto aside = image(curve, view);
    for (Vec2& pixel : aside) pixel.x() += 30.0;
    const auto drawn = stroke_beside_curve(aside, view, curve);
    for (std::size_t i = 0; i < drawn.size(); ++i) CHECK((drawn[i] - curve[i]).norm() < 0.03);
}

TEST_CASE("what no surface or stroke can be made of is refused") {
    const View view{camera_turned(0.0), kPicture};
    const std::vector<Vec3> curve = lock(), point{Vec3::Zero(), Vec3::Zero()};
    const auto make = [&](const std::vector<Vec3>& points, const SupportOptions& options = {}) {
        return SupportSurface(points, view.camera, options);
    };
    expect_error([&] { static_cast<void>(make(point)); }, ErrorCode::invalid_argument,
                 "two points");
    expect_error(
        [&] {
            static_cast<void>(make({Vec3::Zero(), {kNone, 0, 0}}));
        },
        ErrorCode::not_finite, "point 2");
    expect_error(
        [&] {
            static_cast<void>(make({Vec3::Zero(), view.camera.eye()}));
        },
        ErrorCode::invalid_argument, "viewpoint");
    expect_error([&] { static_cast<void>(make(curve, {.width = 0.0})); },
                 ErrorCode::invalid_argument, "width");
    const SupportSurface ruled = make(curve, {.mode = SupportMode::ruled}), strip = make(curve);
    const auto pixels = image(curve, view);
    expect_error([&] { static_cast<void>(stroke_on_support(pixels, view, ruled)); },
                 ErrorCode::invalid_argument, "strip");
    expect_error([&] { static_cast<void>(stroke_on_support({}, view, strip)); },
                 ErrorCode::invalid_argument, "one point");
    expect_error(
        [&] {
            static_cast<void>(stroke_on_support(std::vector<Vec2>{{1, kNone}}, view, strip));
        },
        ErrorCode::not_finite, "finite");
    expect_error(
        [&] {
            static_cast<void>(stroke_on_support(std::vector<Vec2>{{1, 1}, {9, 9}}, view, strip));
        },
        ErrorCode::invalid_argument, "nowhere");
    const Camera inside = camera_at({0.0, 0.0, 0.0001});
    expect_error(
        [&] {
            static_cast<void>(stroke_beside_curve(pixels, View{inside, kPicture}, curve));
        },
        ErrorCode::invalid_argument, "behind the camera");
}
