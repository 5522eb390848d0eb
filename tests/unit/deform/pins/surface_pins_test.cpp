// Vertices that slide on planes, lines and spheres.
#include "kernel/deform/pins/surface_pins.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

namespace lissom::test {
namespace {

// A bar whose lower end is held, and whose upper end is moved and turned.
struct SlidingBar {
    Mesh mesh = make_bar({.across = 4, .along = 24});
    Deformer deformer{mesh};
    HandleId top;

    explicit SlidingBar(const Affine& motion = {}) {
        deformer.pin(mesh.region("bottom"));
        top = deformer.add_handle(mesh.region("top"));
        const Affine turn = rotation(Vec3::UnitZ(), -0.8, Vec3(0, 2.5, 0));
        deformer.set_transform(top, motion * translation({1, -0.4, 0}) * turn);
    }

    Index near(const Vec3& place) const {
        Index best = 0;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            const auto far = [&](Index w) { return (mesh.position(w) - place).norm(); };
            if (far(v) < far(best)) best = v;
        }
        return best;
    }
    Vec3 position(Index v) const {
        const auto& region = deformer.region().vertices();
        const auto row = std::lower_bound(region.begin(), region.end(), v) - region.begin();
        return deformer.positions()[at(index_of(row))];
    }
};

double off_plane(const SlidingPin& pin, const Vec3& p) {
    return std::abs((p - pin.point).dot(pin.direction.normalized()));
}

}  // namespace

TEST_CASE("sliding pins: vertices lie on their plane, line and sphere, and handles hold exactly") {
    SlidingBar bar;
    const SlidingPin plane{bar.near({-0.5, 0, 0.5}), PinPlace::plane, {0, 0, 0.8}, {0.2, 0, 3}};
    const SlidingPin line{bar.near({0.5, -1, 0.5}), PinPlace::line, {0.7, 0, 0.3}, {0, 2, 0.1}};
    const SlidingPin sphere{
        bar.near({0.5, 1, -0.5}), PinPlace::sphere, {2.5, 1, -0.5}, Vec3::UnitY(), 1.2};
    const std::vector<SlidingPin> pins{plane, line, sphere};
    CHECK(solve_with_pins(bar.deformer, pins) < 1e-9);
    CHECK(off_plane(plane, bar.position(plane.vertex)) < 1e-9);
    const Vec3 along = line.direction.normalized(), off = bar.position(line.vertex) - line.point;
    CHECK((off - off.dot(along) * along).norm() < 1e-9);
    CHECK(std::abs((bar.position(sphere.vertex) - sphere.point).norm() - 1.2) < 1e-9);
    const Affine& moved = bar.deformer.pose(bar.top).transform;
    for (const Index v : bar.deformer.handle(bar.top).region.vertices()) {
        CHECK((bar.position(v) - moved(bar.mesh.position(v))).norm() < 1e-9);
    }
}

TEST_CASE("sliding pins: spheres are reached from afar, however small, and by neighbours at once") {
    for (const double away : {0.1, 0.4}) {
        for (const double radius : {0.1, 0.02, 0.01, 1e-6}) {
            CAPTURE(away);
            CAPTURE(radius);
            SlidingBar bar;
            std::vector<SlidingPin> pins;
            for (const double y : {-0.2, 0.2}) {
                const Index v = bar.near({0.5, y, 0.0});
                const Vec3 center = bar.mesh.position(v) + Vec3(away, 0, 0);
                pins.push_back({v, PinPlace::sphere, center, Vec3::UnitY(), radius});
            }
            REQUIRE(pins[0].vertex != pins[1].vertex);
            CHECK(solve_with_pins(bar.deformer, pins) < 1e-9);
            for (const SlidingPin& pin : pins) {
                const double distance = (bar.position(pin.vertex) - pin.point).norm();
                CHECK(std::abs(distance - radius) < 1e-9);
            }
        }
    }
}

TEST_CASE("sliding pins: a vertex slides to where the surface wants it") {
    SlidingBar bar;
    const Index v = bar.near({-0.5, 0, 0.5});
    bar.deformer.solve();
    const Vec3 free = bar.position(v);
    // Nearly where it lies by itself: along the plane it hardly moves.
    const SlidingPin pin{v, PinPlace::plane, free + Vec3(0, 0, 0.05), Vec3::UnitZ()};
    CHECK(solve_with_pins(bar.deformer, std::vector{pin}) < 1e-9);
    const Vec3 way = bar.position(v) - free;
    CHECK(way.z() == doctest::Approx(0.05));
    CHECK(std::hypot(way.x(), way.y()) < 0.02);
}

TEST_CASE("sliding pins: on their places already, and without any, the result is that of solve") {
    SlidingBar bar;
    const std::vector<Vec3> plain = bar.deformer.solve();
    CHECK(solve_with_pins(bar.deformer, {}) == 0.0);
    CHECK(bar.deformer.positions() == plain);
    const Index v = bar.near({-0.5, 0, 0.5});
    const SlidingPin pin{v, PinPlace::plane, bar.position(v), Vec3(1, 2, 3)};
    solve_with_pins(bar.deformer, std::vector{pin});
    CHECK(bar.deformer.positions() == plain);
}

TEST_CASE("sliding pins: they move with the frame of everything") {
    const Affine motion = translation({0.4, 2, -1}) * rotation(Vec3(1, 0.4, 2), 0.7, Vec3::Zero());
    SlidingBar bar;
    SlidingPin pin{bar.near({-0.5, 0, 0.5}), PinPlace::sphere, {-2, 0, 0.5}, Vec3::UnitY(), 1.0};
    REQUIRE(solve_with_pins(bar.deformer, std::vector{pin}) < 1e-9);
    Mesh turned = bar.mesh;
    for (Vec3& p : turned.edit_positions()) p = motion(p);
    Deformer other(turned);
    other.pin(turned.region("bottom"));
    const HandleId top = other.add_handle(turned.region("top"));
    const Affine& pose = bar.deformer.pose(bar.top).transform;
    const Affine back{motion.linear.transpose(), -(motion.linear.transpose() * motion.translation)};
    other.set_transform(top, motion * pose * back);
    pin.point = motion(pin.point);
    REQUIRE(solve_with_pins(other, std::vector{pin}) < 1e-9);
    for (std::size_t i = 0; i < other.positions().size(); ++i) {
        CHECK((other.positions()[i] - motion(bar.deformer.positions()[i])).norm() < 1e-6);
    }
}

TEST_CASE("sliding pins: many, as the vertices of a plane, and a surface at rest") {
    Mesh mesh = make_bar({.across = 4, .along = 24});
    Deformer deformer(mesh);
    deformer.pin(mesh.region("bottom"));
    std::vector<SlidingPin> pins;
    const Region end = mesh.region("top");
    for (const Index v : end.vertices()) {
        pins.push_back({v, PinPlace::plane, {0, 2.7, 0}, {0.3, 1, 0}});
    }
    CHECK(solve_with_pins(deformer, pins) < 1e-6);
    deformer.apply_to(mesh);
    for (const SlidingPin& pin : pins) CHECK(off_plane(pin, mesh.position(pin.vertex)) < 1e-6);
}

TEST_CASE("sliding pins: bad ones are refused, and nothing moves") {
    SlidingBar bar;
    const std::vector<Vec3> plain = bar.deformer.solve();
    const auto code_of = [&](const std::vector<SlidingPin>& pins) {
        const ErrorCode code = error_of([&] { solve_with_pins(bar.deformer, pins); }).code();
        CHECK(bar.deformer.positions() == plain);
        return code;
    };
    const Index v = bar.near({-0.5, 0, 0.5});
    const SlidingPin good{v, PinPlace::plane, {0, 0, 1}, Vec3::UnitZ()};
    SlidingPin bad = good;
    bad.direction = Vec3::Zero();
    CHECK(code_of({bad}) == ErrorCode::invalid_argument);
    bad = good;
    bad.point.x() = NAN;
    CHECK(code_of({bad}) == ErrorCode::not_finite);
    bad = {v, PinPlace::sphere, {0, 0, 1}, Vec3::UnitY(), 0.0};
    CHECK(code_of({bad}) == ErrorCode::invalid_argument);
    bad = good;
    bad.vertex = 1 << 20;
    CHECK(code_of({bad}) == ErrorCode::out_of_range);
    bad.vertex = bar.deformer.handle(bar.top).region.vertices().front();
    CHECK(code_of({bad}) == ErrorCode::handle_overlap);
    CHECK(code_of({good, good}) == ErrorCode::handle_overlap);
    const Error twice = error_of([&] { solve_with_pins(bar.deformer, std::vector{good, good}); });
    CHECK(std::string(twice.what()).find(std::to_string(good.vertex)) != std::string::npos);
    CHECK(twice.elements().ids == std::vector<Index>{good.vertex});
    CHECK(code_of(std::vector<SlidingPin>(513, good)) == ErrorCode::invalid_argument);
    Deformer part(bar.mesh, select_sphere(bar.mesh, {0, 2, 0}, 1.0));
    bad.vertex = bar.near({0.5, -2, 0.5});
    CHECK(error_of([&] { solve_with_pins(part, std::vector{bad}); }).code() ==
          ErrorCode::handle_outside_region);
}

}  // namespace lissom::test
