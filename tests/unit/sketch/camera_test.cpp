#include "kernel/sketch/camera.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <vector>

#include "tests/unit/support.h"

using namespace lissom;

namespace {

constexpr PictureSize kSize{640.0, 480.0};

constexpr std::array kViews{StandardView::front,        StandardView::back, StandardView::left,
                            StandardView::right,        StandardView::top,  StandardView::bottom,
                            StandardView::three_quarter};

Camera perspective() {
    return Camera({.eye = Vec3(3.0, 2.0, 4.0), .target = Vec3(0.5, 0.0, -1.0), .fov = 0.7});
}

Camera parallel() {
    return Camera({.eye = Vec3(3.0, 2.0, 4.0), .target = Vec3(0.5, 0.0, -1.0), .ortho = 2.5});
}

std::vector<Vec3> corners(const Box& box) {
    std::vector<Vec3> result;
    for (int i = 0; i < 8; ++i) {
        result.push_back({(i & 1 ? box.max : box.min).x(), (i & 2 ? box.max : box.min).y(),
                          (i & 4 ? box.max : box.min).z()});
    }
    return result;
}

// What the picture shows of `points`, in pixels.
Box seen(const Camera& camera, const std::vector<Vec3>& points) {
    Box box;
    for (const Vec3& p : points) box.extend(camera.project(p, kSize));
    return box;
}

}  // namespace

TEST_CASE("the target is seen in the middle of the picture") {
    for (const Camera& camera : {perspective(), parallel()}) {
        const Vec3 seen_at = camera.project(camera.target(), kSize);
        CHECK((seen_at.head<2>() - Vec2(320.0, 240.0)).norm() < 1e-9);
        CHECK(seen_at.z() == doctest::Approx((camera.target() - camera.eye()).norm()));
    }
}

TEST_CASE("unproject is the inverse of project") {
    for (const Camera& camera : {perspective(), parallel()}) {
        for (const Vec3& p : {Vec3(0.2, 0.1, 0.3), Vec3(-1.0, 0.7, -2.0), Vec3(1.0, -2.0, -9.0)}) {
            CHECK((camera.unproject(camera.project(p, kSize), kSize) - p).norm() < 1e-12);
        }
    }
}

TEST_CASE("the ray of a pixel passes through every point seen there") {
    for (const Camera& camera : {perspective(), parallel()}) {
        const Vec3 p(0.4, -0.3, -0.8);
        const Vec3 pixel = camera.project(p, kSize);
        const Ray ray = camera.ray(pixel.x(), pixel.y(), kSize);
        CHECK(ray.direction.norm() == doctest::Approx(1.0));
        CHECK((p - ray.origin).cross(ray.direction).norm() < 1e-12);
        CHECK((p - ray.origin).dot(ray.direction) > 0.0);
    }
}

TEST_CASE("x runs to the right and y down") {
    const Camera camera({.eye = Vec3(0, 0, 5)});
    const Vec3 pixel = camera.project(Vec3(1.0, 1.0, 0.0), kSize);
    CHECK(pixel.x() > 320.0);
    CHECK(pixel.y() < 240.0);
}

TEST_CASE("the opening angle spans the height of the picture") {
    const Camera camera({.eye = Vec3(0, 0, 2), .fov = kPi / 2.0});
    CHECK(std::abs(camera.project(Vec3(0.0, 2.0, 0.0), kSize).y()) < 1e-9);
    CHECK(std::abs(camera.project(Vec3(0.0, -2.0, 0.0), kSize).y() - 480.0) < 1e-9);
}

TEST_CASE("without perspective the picture has the given height at every depth") {
    const Camera camera({.eye = Vec3(0, 0, 2), .ortho = 3.0});
    for (const double z : {1.0, 0.0, -7.0}) {
        CHECK(std::abs(camera.project(Vec3(0.0, 1.5, z), kSize).y()) < 1e-9);
    }
}

TEST_CASE("a point behind the eye has no place in the picture") {
    const Camera camera({.eye = Vec3(0, 0, 2)});
    const Vec3 pixel = camera.project(Vec3(0.0, 0.0, 3.0), kSize);
    CHECK(std::isnan(pixel.x()));
    CHECK(pixel.z() == doctest::Approx(-1.0));
}

TEST_CASE("standard views hold the whole box, touch the margin and are centred") {
    Box box;
    box.extend({-3.0, 10.0, 0.5});
    box.extend({4.0, 11.0, 9.0});
    for (const bool ortho : {false, true}) {
        for (const StandardView view : kViews) {
            CAPTURE(view_name(view));
            const FramingOptions framing{.aspect = kSize.aspect(), .ortho = ortho, .margin = 0.1};
            const Box picture = seen(frame_box(view, box, framing), corners(box));
            const double left = picture.min.x() / 640.0, right = 1.0 - picture.max.x() / 640.0;
            const double top = picture.min.y() / 480.0, bottom = 1.0 - picture.max.y() / 480.0;
            CHECK(picture.min.z() > 0.0);
            CHECK(std::min({left, right, top, bottom}) == doctest::Approx(0.1));
            const bool tight_across = std::min(left, right) < std::min(top, bottom);
            CHECK((tight_across ? left - right : top - bottom) == doctest::Approx(0.0));
        }
    }
}

TEST_CASE("front, right and top look the way their documentation says") {
    const Box box{Vec3(-1, -1, -1), Vec3(1, 1, 1)};
    const FramingOptions z_up{.up = ViewUp::z};
    CHECK(frame_box(StandardView::front, box).forward().isApprox(-Vec3::UnitZ()));
    CHECK(frame_box(StandardView::right, box).forward().isApprox(-Vec3::UnitX()));
    CHECK(frame_box(StandardView::top, box).right().isApprox(Vec3::UnitX()));
    CHECK(frame_box(StandardView::front, box, z_up).forward().isApprox(Vec3::UnitY()));
    CHECK(frame_box(StandardView::front, box, z_up).up().isApprox(Vec3::UnitZ()));
    CHECK(frame_box(StandardView::right, box, z_up).forward().isApprox(-Vec3::UnitX()));
    CHECK(frame_box(StandardView::top, box, z_up).up().isApprox(Vec3::UnitY()));
}

TEST_CASE("points, segments along the view and flat sets can be framed") {
    const std::vector<std::vector<Vec3>> sets{
        {Vec3(5, 5, 5)},
        {Vec3(0, 0, -2), Vec3(0, 0, 2)},
        {Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
    };
    for (const auto& points : sets) {
        for (const bool ortho : {false, true}) {
            const Camera camera = frame_points(StandardView::front, points, {.ortho = ortho});
            const Box picture = seen(camera, points);
            CHECK(picture.min.z() > 0.0);
            CHECK(picture.min.x() >= 0.0);
            CHECK(picture.max.x() <= 640.0);
        }
    }
}

TEST_CASE("view names go back and forth") {
    for (const StandardView view : kViews) CHECK(find_view(view_name(view)) == view);
    CHECK(!find_view("sideways"));
}

TEST_CASE("cameras that see nothing are refused") {
    const auto code = [](const CameraOptions& options) {
        return test::error_of([&] { Camera camera(options); }).code();
    };
    CHECK(code({.eye = Vec3::Zero()}) == ErrorCode::invalid_argument);
    CHECK(code({.up = Vec3(0, 0, 3)}) == ErrorCode::invalid_argument);
    CHECK(code({.up = Vec3::Zero()}) == ErrorCode::invalid_argument);
    CHECK(code({.fov = 0.0}) == ErrorCode::invalid_argument);
    CHECK(code({.fov = kPi}) == ErrorCode::invalid_argument);
    CHECK(code({.fov = std::nan("")}) == ErrorCode::invalid_argument);
    CHECK(code({.ortho = -1.0}) == ErrorCode::invalid_argument);
    CHECK(code({.ortho = std::nan("")}) == ErrorCode::invalid_argument);
    CHECK(code({.eye = Vec3::Constant(std::nan(""))}) == ErrorCode::not_finite);
}

TEST_CASE("framing refuses nothing to frame and impossible margins") {
    const auto code = [](const Box& box, const FramingOptions& options) {
        return test::error_of([&] { frame_box(StandardView::front, box, options); }).code();
    };
    const Box box{Vec3(-1, -1, -1), Vec3(1, 1, 1)};
    CHECK(code({}, {}) == ErrorCode::invalid_argument);
    CHECK(code(box, {.margin = 0.5}) == ErrorCode::invalid_argument);
    CHECK(code(box, {.aspect = 0.0}) == ErrorCode::invalid_argument);
    CHECK(code(box, {.fov = 4.0}) == ErrorCode::invalid_argument);
}
