#include "kernel/sketch/navigation.h"

#include <cmath>
#include <random>

#include "tests/unit/support.h"

using namespace lissom;

namespace {

const PictureSize kWindow{1280, 960};

View window_view(const CameraOptions& options) {
    return {Camera(options), kWindow};
}

struct RandomCameras {
    std::mt19937 generator{7};
    std::uniform_real_distribution<double> uniform{-1.0, 1.0};

    Vec3 vector() { return {uniform(generator), uniform(generator), uniform(generator)}; }

    View next() {
        CameraOptions options;
        const double far = std::pow(10.0, 3.0 * uniform(generator));
        options.target = far * vector();
        options.eye = options.target + far * (vector() + Vec3(0.0, 0.2, 2.5));
        if (uniform(generator) > 0.0) options.ortho = far * (1.5 + uniform(generator));
        return window_view(options);
    }

    Vec2 pixel() {
        return {640.0 + 600.0 * uniform(generator), 480.0 + 400.0 * uniform(generator)};
    }
};

double target_depth(const Camera& camera) {
    return (camera.target() - camera.eye()).norm();
}

}  // namespace

TEST_CASE("navigation: an orbit keeps the target, the distance and a level horizon") {
    RandomCameras random;
    for (int i = 0; i < 200; ++i) {
        const View view = random.next();
        const Camera turned = orbited(view, random.pixel());
        CHECK((turned.target() - view.camera.target()).norm() == 0.0);
        CHECK(target_depth(turned) == doctest::Approx(target_depth(view.camera)));
        CHECK(std::abs(turned.right().dot(Vec3::UnitY())) < 1e-9);
    }
}

TEST_CASE("navigation: an orbit follows the cursor and goes no further than straight up and down") {
    const View view = window_view({});
    // To the right: the camera goes to the left of what it looks at.
    CHECK(orbited(view, {100.0, 0.0}).eye().x() < -0.1);
    // Down: the camera rises.
    CHECK(orbited(view, {0.0, 100.0}).eye().y() > 0.1);
    const Camera over = orbited(view, {0.0, 5000.0});
    CHECK(over.eye().y() == doctest::Approx(5.0));
    CHECK(over.right().x() == doctest::Approx(1.0));
    const Camera under = orbited(view, {0.0, -5000.0});
    CHECK(under.eye().y() == doctest::Approx(-5.0));
    // From the pole back: as if it had not been there.
    CHECK(orbited({over, kWindow}, {0.0, -480.0}).eye().z() == doctest::Approx(5.0));
    // A whole turn.
    const Camera round = orbited(view, {2.0 * kWindow.height, 0.0});
    CHECK((round.eye() - view.camera.eye()).norm() < 1e-9);
}

TEST_CASE("navigation: a drag in parts ends where the drag as a whole does") {
    RandomCameras random;
    for (int i = 0; i < 50; ++i) {
        const View view = random.next();
        View at = view;
        for (int step = 0; step < 10; ++step) at.camera = orbited(at, {12.0, 3.0});
        const Camera whole = orbited(view, {120.0, 30.0});
        CHECK((at.camera.eye() - whole.eye()).norm() < 1e-9 * target_depth(whole));
        for (int step = 0; step < 10; ++step) at.camera = panned(at, {12.0, 3.0});
        const Camera moved = panned({whole, kWindow}, {120.0, 30.0});
        CHECK((at.camera.eye() - moved.eye()).norm() < 1e-9 * (1.0 + moved.eye().norm()));
    }
}

TEST_CASE("navigation: a pan moves what lies at the target's depth with the cursor") {
    RandomCameras random;
    for (int i = 0; i < 200; ++i) {
        const View view = random.next();
        const Vec2 from = random.pixel(), to = random.pixel();
        const Vec3 point =
            view.camera.unproject({from.x(), from.y(), target_depth(view.camera)}, kWindow);
        const Vec3 seen = panned(view, to - from).project(point, kWindow);
        CHECK((seen.head<2>() - to).norm() < 1e-6);
    }
}

TEST_CASE("navigation: a zoom keeps what is under the cursor and can be taken back") {
    RandomCameras random;
    for (int i = 0; i < 200; ++i) {
        const View view = random.next();
        const Vec2 cursor = random.pixel();
        const double size = target_depth(view.camera);
        const Vec3 point =
            view.camera.unproject({cursor.x(), cursor.y(), target_depth(view.camera)}, kWindow);
        const Camera nearer = zoomed(view, cursor, 1.7, size);
        const Vec3 seen = nearer.project(point, kWindow);
        CHECK((seen.head<2>() - cursor).norm() < 1e-6);
        const Camera back = zoomed({nearer, kWindow}, cursor, 1.0 / 1.7, size);
        CHECK((back.eye() - view.camera.eye()).norm() < 1e-9 * (size + back.eye().norm()));
    }
    View view = window_view({});
    for (int i = 0; i < 1000; ++i) view.camera = zoomed(view, {0.0, 0.0}, 2.0, 1.0);
    CHECK(target_depth(view.camera) == doctest::Approx(1e-6));
    for (int i = 0; i < 1000; ++i) view.camera = zoomed(view, {0.0, 0.0}, 0.5, 1.0);
    CHECK(target_depth(view.camera) == doctest::Approx(1e6));
}

TEST_CASE("navigation: with and without perspective a camera shows as much at the target") {
    RandomCameras random;
    for (int i = 0; i < 50; ++i) {
        const View view = random.next();
        const double height = view.camera.half_height(target_depth(view.camera));
        const Camera flat = without_perspective(view.camera);
        CHECK(flat.is_ortho());
        CHECK(flat.half_height(1.0) == doctest::Approx(height));
        const Camera deep = with_perspective(flat, 0.7);
        CHECK_FALSE(deep.is_ortho());
        CHECK(deep.half_height(target_depth(deep)) == doctest::Approx(height));
        CHECK((deep.forward() - view.camera.forward()).norm() < 1e-9);
    }
}

TEST_CASE("navigation: a framed box lies in the picture and fills it") {
    RandomCameras random;
    for (int i = 0; i < 200; ++i) {
        View view = random.next();
        if (i % 3 == 0) view.size = {400, 900};
        Box box;
        const Vec3 middle = 100.0 * random.vector();
        for (int k = 0; k < 3; ++k) box.extend(middle + random.vector());
        const Camera camera = framed(view, box);
        double widest = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 p(corner & 1 ? box.max.x() : box.min.x(),
                         corner & 2 ? box.max.y() : box.min.y(),
                         corner & 4 ? box.max.z() : box.min.z());
            const Vec3 seen = camera.project(p, view.size);
            CHECK(seen.z() > 0.0);
            const double x = std::abs(seen.x() / view.size.width - 0.5);
            const double y = std::abs(seen.y() / view.size.height - 0.5);
            CHECK(x < 0.5);
            CHECK(y < 0.5);
            widest = std::max({widest, x, y});
        }
        // It touches the margin.
        CHECK(widest == doctest::Approx(0.5 - 0.06));
        CHECK((camera.forward() - view.camera.forward()).norm() < 1e-9);
    }
    CHECK(test::error_of([&] { framed(window_view({}), Box()); }).code() ==
          ErrorCode::invalid_argument);
}

TEST_CASE("navigation: what is not a number is refused") {
    const View view = window_view({});
    const Vec2 nan(std::nan(""), 0.0);
    CHECK(test::error_of([&] { orbited(view, nan); }).code() == ErrorCode::not_finite);
    CHECK(test::error_of([&] { panned(view, nan); }).code() == ErrorCode::not_finite);
    CHECK(test::error_of([&] { zoomed(view, nan, 2.0, 1.0); }).code() == ErrorCode::not_finite);
    CHECK(test::error_of([&] {
              zoomed(view, {0.0, 0.0}, 0.0, 1.0);
          }).code() == ErrorCode::invalid_argument);
    CHECK(test::error_of([&] {
              zoomed(view, {0.0, 0.0}, 2.0, 0.0);
          }).code() == ErrorCode::invalid_argument);
}
