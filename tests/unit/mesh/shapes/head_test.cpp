#include "kernel/mesh/shapes/head.h"

#include <algorithm>
#include <map>

#include "kernel/mesh/shapes/hairline.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

TEST_CASE("a head is one closed piece with about the vertices asked for") {
    for (const Index vertices : {3000, 10000, 40000}) {
        const Mesh head = make_head({.vertices = vertices});
        CHECK(std::abs(head.vertex_count() - vertices) < vertices / 10);
        CHECK(head.topology().is_closed());
        CHECK(head.topology().component_count() == 1);
        CHECK(genus(head.topology()) == 0);
        CHECK(volume(head) > 0.0);
    }
}

TEST_CASE("a head is symmetric to the bit") {
    const Mesh head = make_head({.vertices = 3000});
    const auto order = [](const Vec3& a, const Vec3& b) {
        return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    };
    std::vector<Vec3> points(head.positions().begin(), head.positions().end()), mirrored;
    for (const Vec3& p : points) mirrored.emplace_back(-p.x(), p.y(), p.z());
    for (Vec3& p : mirrored) p.x() += 0.0;  // -0 becomes 0
    for (Vec3& p : points) p.x() += 0.0;
    std::sort(points.begin(), points.end(), order);
    std::sort(mirrored.begin(), mirrored.end(), order);
    CHECK(points == mirrored);
}

TEST_CASE("a head has the proportions of one") {
    const Mesh head = make_head();
    const Box box = bounds(head);
    CHECK(std::abs(box.max.y() - 0.1) < 0.002);
    CHECK(std::abs(box.max.y() - box.min.y() - 0.4) < 0.004);
    double width = 0.0, front = 0.0, back = 0.0;
    for (const Vec3& p : head.positions()) {
        if (std::abs(p.y() - 0.022) > 0.006) continue;
        width = std::max(width, 2.0 * p.x());
        front = std::max(front, p.z());
        back = std::min(back, p.z());
    }
    CHECK(std::abs(width - 0.155) < 0.003);
    CHECK(std::abs(front - back - 0.19) < 0.005);
}

TEST_CASE("faces of a head are neither folded nor thin") {
    const Mesh head = make_head();
    CHECK(zero_area_faces(head).empty());
    const std::vector<Vec3> normals = face_normals(head);
    int folded = 0;
    for (Index v = 0; v < head.vertex_count(); ++v) {
        const auto fan = head.topology().faces_around(v);
        for (std::size_t i = 0; i + 1 < fan.size(); ++i) {
            folded += normals[fan[i]].dot(normals[fan[i + 1]]) < -0.5;
        }
    }
    CHECK(folded == 0);
}

TEST_CASE("the regions of a head are where they should be") {
    const Mesh head = make_head();
    const Region *scalp = head.find_region("scalp"), *ears = head.find_region("ears"),
                 *bottom = head.find_region("bottom");
    REQUIRE((scalp && ears && bottom));
    CHECK(scalp->intersected(*ears).empty());
    CHECK(scalp->boundaries().size() == 1);
    double scalp_area = 0.0;
    const std::vector<double> areas = face_areas(head);
    for (const Index f : scalp->faces()) scalp_area += areas[f];
    CHECK(scalp_area > 0.050);
    CHECK(scalp_area < 0.068);
    for (const Index v : ears->vertices()) CHECK(std::abs(head.position(v).x()) > 0.06);
    for (const Index v : bottom->vertices()) CHECK(head.position(v).y() < -0.29);
}

TEST_CASE("height scales a head and the number of threads changes nothing") {
    const Mesh one = make_head({.vertices = 3000});
    const Mesh ten = make_head({.height = 4.0, .vertices = 3000});
    for (Index v = 0; v < one.vertex_count(); ++v) {
        CHECK((10.0 * one.position(v) - ten.position(v)).norm() < 1e-12);
    }
    ContextOptions options;
    options.threads = 2;
    CHECK(test::same_shape(one, make_head({.vertices = 3000}, Context(options))));
}

TEST_CASE("heads without sense are refused") {
    const auto code = [](const HeadOptions& options) {
        return test::error_of([&] { (void)make_head(options); }).code();
    };
    CHECK(code({.height = 0.0}) == ErrorCode::invalid_argument);
    CHECK(code({.height = test::kNaN}) == ErrorCode::invalid_argument);
    CHECK(code({.vertices = 100}) == ErrorCode::invalid_argument);
    CHECK(code({.vertices = 10000000}) == ErrorCode::invalid_argument);
    const Context context;
    context.cancel();
    CHECK(test::error_of([&] { (void)make_head({}, context); }).code() == ErrorCode::cancelled);
}

TEST_CASE("the hairline is smooth between its points and the same on both sides") {
    const std::vector<HairlinePoint> hairline = {{0.0, 1.0}, {1.0, 0.0}, {kPi, -0.5}};
    CHECK(hairline_elevation(hairline, 0.0) == 1.0);
    CHECK(hairline_elevation(hairline, -0.5) == hairline_elevation(hairline, 0.5));
    CHECK(hairline_elevation(hairline, 1.0) == Approx(0.0));
    CHECK(hairline_elevation(hairline, 2.0 * kPi - 1.0) == Approx(0.0));
    CHECK(hairline_elevation(hairline, kPi) == -0.5);
    CHECK(hairline_elevation(default_hairline(), 0.0) > 0.5);
}

TEST_CASE("the hairline falls from the forehead to the ear without steps") {
    const std::vector<HairlinePoint> hairline = default_hairline();
    for (int degrees = 45; degrees < 75; ++degrees) {
        CAPTURE(degrees);
        const double fall = hairline_elevation(hairline, degrees * kDegree) -
                            hairline_elevation(hairline, (degrees + 1) * kDegree);
        CHECK(fall > 0.4 * kDegree);
        CHECK(fall < 2.0 * kDegree);
    }
}

TEST_CASE("head: a manifold at every resolution, of about as many vertices as asked for") {
    for (Index vertices = 3000; vertices <= 5000; vertices += 250) {
        const Mesh head = make_head({.vertices = vertices});
        CHECK(head.topology().is_closed());
        CHECK(std::abs(head.vertex_count() - vertices) < 0.12 * vertices);
    }
    for (const Index vertices : {9800, 11600}) {
        CHECK(make_head({.vertices = vertices}).topology().is_closed());
    }
}
