#include "kernel/sketch/stroke_depth.h"

#include <algorithm>
#include <array>
#include <limits>

#include "kernel/mesh/shapes/head.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

constexpr PictureSize kDrawnPicture{900.0, 900.0};

// A head whose upper half grows hair.
struct DrawnHead {
    Mesh mesh = make_head({.vertices = 6000});
    SpatialTree tree{mesh};
    Box bounds = tree.bounds();
    std::vector<char> faces = upper_faces();
    double metre = (bounds.max.x() - bounds.min.x()) / 0.155;

    DrawnSurface surface() const { return {tree, faces}; }
    EnvelopeOptions options() const {
        EnvelopeOptions result;
        result.metre = metre;
        return result;
    }
    View view(StandardView side) const {
        return {frame_box(side, bounds, {.aspect = 1.0, .margin = 0.2}), kDrawnPicture};
    }
    std::vector<char> upper_faces() const {
        std::vector<char> result;
        for (Index f = 0; f < mesh.face_count(); ++f) {
            double lowest = test::kInfinity;
            for (const Index v : mesh.topology().face(f)) {
                lowest = std::min(lowest, mesh.position(v).y());
            }
            result.push_back(lowest > bounds.max.y() - 0.35 * (bounds.max.y() - bounds.min.y()));
        }
        return result;
    }
    // By the number of times that a ray leaves it.
    bool contains(const Vec3& point) const {
        return tree.pick_all(point, Vec3(0.31, 0.83, 0.46)).size() % 2 == 1;
    }
};

const DrawnHead& head() {
    static const DrawnHead made;
    return made;
}

// From near the crown outward and down past the silhouette, in a bow.
std::vector<Vec2> falling_stroke(const View& view, test::Random& random) {
    const Box& box = head().bounds;
    const Vec3 top(box.center().x(), box.max.y(), box.center().z());
    const Vec3 crown = view.project(top);
    const double side = random.uniform(-1.0, 1.0), down = random.uniform(120.0, 380.0);
    std::vector<Vec2> stroke;
    for (int i = 0; i <= 120; ++i) {
        const double t = i / 120.0;
        stroke.emplace_back(crown.x() + side * 330.0 * std::sin(1.4 * t) + 6.0,
                            crown.y() + 40.0 + down * t * t);
    }
    return stroke;
}

// The sharpest angle between steps of some points.
double sharpest_bend(const std::vector<Vec3>& points) {
    constexpr std::size_t kStep = 4;
    double sharpest = 0.0;
    // Not at the root, where a curve rises from the skin.
    for (std::size_t i = 4 * kStep; i + kStep < points.size(); ++i) {
        const Vec3 a = points[i] - points[i - kStep], b = points[i + kStep] - points[i];
        sharpest = std::max(sharpest,
                            std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0)));
    }
    return sharpest;
}

// The message that refuses, with `code`, a stroke over the head that starts at a pixel.
std::string refusal(const Vec2& start, const View& view,
                    ErrorCode code = ErrorCode::invalid_argument) {
    const std::vector<Vec2> stroke{start, start + Vec2(0, 5), start + Vec2(0, 10)};
    const Error error = test::error_of(
        [&] { (void)stroke_over_head(stroke, view, head().surface(), head().options()); });
    CHECK(error.code() == code);
    return error.what();
}

}  // namespace

TEST_CASE("a stroke over a head never enters it, from any side, and is seen where it was drawn") {
    test::Random random(21);
    for (const StandardView side : {StandardView::front, StandardView::left, StandardView::back,
                                    StandardView::three_quarter}) {
        const View view = head().view(side);
        for (int n = 0; n < 12; ++n) {
            const std::vector<Vec2> stroke = falling_stroke(view, random);
            const auto points = stroke_over_head(stroke, view, head().surface(), head().options());
            REQUIRE(points.size() >= stroke.size() - 20);
            const std::size_t offset = stroke.size() - std::min(points.size(), stroke.size());
            int inside = 0;
            for (std::size_t i = 1; i < points.size(); ++i) inside += head().contains(points[i]);
            CHECK(inside == 0);
            for (std::size_t i = 2; i < points.size() && points.size() <= stroke.size(); ++i) {
                const Vec3 seen = view.project(points[i]);
                CHECK((Vec2(seen.x(), seen.y()) - stroke[i + offset]).norm() < 1e-6);
            }
            CHECK(head().tree.nearest(points.front()).distance < 1e-6 * head().metre);
            CHECK(head().tree.nearest(points.back()).distance > 0.0049 * head().metre);
        }
    }
}

TEST_CASE("the envelope passes the silhouette without the corner that the last depth makes") {
    test::Random random(22);
    double envelope = 0.0, last = 0.0;
    const View view = head().view(StandardView::front);
    for (int n = 0; n < 30; ++n) {
        const std::vector<Vec2> stroke = falling_stroke(view, random);
        const auto over = stroke_over_head(stroke, view, head().surface(), head().options());
        envelope = std::max(envelope, sharpest_bend(over));
        const auto start = std::find_if(stroke.begin(), stroke.end(), [&](const Vec2& p) {
            try {
                return !stroke_on_surface(std::array{p}, view, head().surface()).empty();
            } catch (const Error&) {
                return false;
            }
        });
        const std::vector<Vec2> on_it(start, stroke.end());
        last = std::max(last, sharpest_bend(stroke_on_surface(on_it, view, head().surface())));
    }
    CHECK(envelope < 60.0 * kPi / 180.0);
    CHECK(last > 1.15 * envelope);
}

TEST_CASE("a stroke that starts beside the hair says where, and a near one is moved onto it") {
    const View view = head().view(StandardView::front);
    CHECK(refusal({5.0, 5.0}, view, ErrorCode::out_of_range).find("beside the surface") !=
          std::string::npos);
    const Vec3 chin = view.project(head().bounds.center() + Vec3(0, -0.2 * head().metre * 0.2, 0));
    CHECK(refusal({chin.x(), chin.y()}, view).find("not to be drawn on") != std::string::npos);

    // Just above the head: the nearest pixel of the hair comes first.
    Vec2 above(chin.x(), 0.0);
    while (!head().tree.pick(view.ray(above).origin, view.ray(above).direction)) above.y() += 1.0;
    above.y() -= 8.0;
    const std::vector<Vec2> upward{above, above - Vec2(0, 30), above - Vec2(0, 60)};
    const auto points = stroke_over_head(upward, view, head().surface(), head().options());
    CHECK(points.size() == 4);
    CHECK(head().tree.nearest(points[0]).distance < 1e-6 * head().metre);
}

TEST_CASE("from inside the head, and through a hole onto its inside, a stroke is refused") {
    Camera camera({.eye = head().bounds.center(), .target = head().bounds.max});
    const View inside{camera, kDrawnPicture};
    const Vec3 top(head().bounds.center().x(), head().bounds.max.y(), head().bounds.center().z());
    const Vec3 seen = inside.project(top);
    CHECK(refusal({seen.x(), seen.y()}, inside).find("move it out") != std::string::npos);
    const std::vector<Vec2> stroke{{seen.x(), seen.y()}, {seen.x() + 5, seen.y()}};
    const Error error =
        test::error_of([&] { (void)stroke_on_surface(stroke, inside, head().surface()); });
    CHECK(error.message().find("move it out") != std::string::npos);
}

TEST_CASE("on a surface a stroke follows it, and beyond it keeps the last depth") {
    const Mesh box = make_box();
    const SpatialTree tree(box);
    CameraOptions options;
    options.ortho = 2.0;
    const View view{Camera(options), {200.0, 200.0}};
    const std::vector<Vec2> stroke{{100, 100}, {140, 100}, {190, 100}};
    const auto points = stroke_on_surface(stroke, view, {tree, {}}, 0.1);
    CHECK(points[0].isApprox(Vec3(0.0, 0.0, 0.6)));
    CHECK(points[1].isApprox(Vec3(0.4, 0.0, 0.6)));
    CHECK(points[2].isApprox(Vec3(0.9, 0.0, 0.6)));
}

TEST_CASE("on a plane a stroke is where its rays meet it") {
    const View view{Camera({.eye = {0, 0, 5}}), kDrawnPicture};
    const std::vector<Vec2> stroke{{450, 450}, {600, 300}, {20, 700}};
    const Vec3 at(0, 0, -1), normal(0.3, 0.2, 1.0);
    const auto points = stroke_on_plane(stroke, view, at, normal);
    for (std::size_t i = 0; i < stroke.size(); ++i) {
        CHECK((points[i] - at).dot(normal) == Approx(0.0).epsilon(1e-9));
        const Vec3 seen = view.project(points[i]);
        CHECK((Vec2(seen.x(), seen.y()) - stroke[i]).norm() < 1e-9);
    }
    const auto code = [&](const Vec3& point, const Vec3& direction) {
        return test::error_of([&] { (void)stroke_on_plane(stroke, view, point, direction); })
            .code();
    };
    CHECK(code({0, 0, 9}, normal) == ErrorCode::invalid_argument);
    CHECK(code(at, Vec3::Zero()) == ErrorCode::invalid_argument);
    CHECK(code(at, Vec3::UnitX()) == ErrorCode::invalid_argument);
    CHECK(code(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()), normal) ==
          ErrorCode::not_finite);
}
