#include "kernel/sketch/gizmo.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "kernel/sketch/gizmo_drag.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

constexpr PictureSize kPicture{640.0, 480.0};
constexpr int kParts = 15;

GizmoPart part_at(int i) {
    return static_cast<GizmoPart>(i);
}

// A view of the origin from some side; every third without perspective.
View random_view(test::Random& random, int i, double distance = 5.0) {
    CameraOptions camera{.eye = distance * random.direction(),
                         .target = 0.1 * distance * random.direction(),
                         .fov = random.uniform(0.3, 1.3)};
    if (i % 3 == 2) camera.ortho = 0.7 * distance;
    return {Camera(camera), kPicture};
}

// Views along an axis, exactly and almost, and in a plane of axes.
std::vector<View> straight_views() {
    std::vector<View> views;
    for (const double off : {0.0, 1e-12, 1e-3}) {
        for (const Vec3& eye : {Vec3(0, 0, 5), Vec3(5, 0, 0), Vec3(4, 0, 3), Vec3(0, 3, 4)}) {
            const Vec3 up = eye.y() == 0.0 ? Vec3::UnitY() : Vec3::UnitX();
            CameraOptions camera{
                .eye = eye + Vec3(off, 0.7 * off, -off), .target = Vec3(0, 0, off), .up = up};
            views.push_back({Camera(camera), kPicture});
            camera.ortho = 4.0;
            views.push_back({Camera(camera), kPicture});
        }
    }
    return views;
}

Vec2 seen(const View& view, const Vec3& p) {
    return view.project(p).head<2>();
}

Gizmo gizmo_with(GizmoMode mode, GizmoAxes axes = GizmoAxes::world,
                 const Vec3& origin = {0, 0, 0}) {
    return Gizmo({.origin = origin,
                  .mode = mode,
                  .axes = axes,
                  .local = rotation(Vec3(1, 2, 3), 0.8, Vec3::Zero()).linear});
}

// A closed path of the cursor through and far beyond the picture.
Vec2 on_path(double t, int which) {
    const double angle = 2.0 * kPi * t;
    if (which == 0) return {320 + 900 * std::sin(angle), 240 + 700 * std::sin(2 * angle)};
    if (which == 1) return {300 + 150 * std::cos(3 * angle), 230 + 1500 * std::sin(angle)};
    return {320 + 60 * std::cos(angle), 240 + 60 * std::sin(angle)};
}

double change(const GizmoMotion& a, const GizmoMotion& b) {
    return (a.translation - b.translation).norm() + std::abs(a.angle - b.angle) +
           (a.factors.array().log() - b.factors.array().log()).matrix().norm();
}

struct Followed {
    bool finite = true;
    double greatest = 0.0;
    GizmoMotion last = {};
};

// The greatest change from one step of a path to the next, which must fall with the steps.
Followed follow_path(GizmoDrag drag, int path, int steps) {
    Followed result;
    result.last = drag.motion();
    for (int k = 1; k <= steps; ++k) {
        const GizmoMotion& now = drag.drag(on_path(k == steps ? 0.0 : 1.0 * k / steps, path));
        result.finite = result.finite && now.affine().is_finite() && now.factors.minCoeff() > 0.0;
        result.greatest = std::max(result.greatest, change(now, result.last));
        result.last = now;
    }
    return result;
}

}  // namespace

TEST_CASE("a gizmo has the same size in pixels at every distance") {
    for (const double distance : {0.01, 1.0, 5.0, 1e4}) {
        for (const bool ortho : {false, true}) {
            CameraOptions camera{.eye = Vec3(0, 0, distance)};
            if (ortho) camera.ortho = distance;
            const View view{Camera(camera), kPicture};
            const Gizmo gizmo({.size = 70.0});
            const Vec3 tip = gizmo.length(view) * Vec3::UnitX();
            CHECK((seen(view, tip) - seen(view, Vec3::Zero())).norm() == Approx(70.0));
        }
    }
}

TEST_CASE("what a gizmo shows is what is hit") {
    test::Random random(1);
    for (int i = 0; i < 60; ++i) {
        const View view = random_view(random, i);
        for (const auto mode :
             {GizmoMode::move, GizmoMode::rotate, GizmoMode::scale, GizmoMode::all}) {
            const Gizmo gizmo = gizmo_with(mode, i % 2 == 0 ? GizmoAxes::world : GizmoAxes::local,
                                           0.4 * random.direction());
            const GizmoShape shape = gizmo.shape(view);
            for (const GizmoPoint& point : shape.points) {
                CHECK(gizmo.hit(view, seen(view, point.position), 3.0) == point.part);
            }
            // On a line that part is hit, or one that crosses it; all of them can be grabbed.
            std::set<GizmoPart> shown, grabbed;
            for (const GizmoLine& line : shape.lines) {
                shown.insert(line.part);
                Vec2 middle = Vec2::Zero();
                for (std::size_t k = 0; k < line.points.size(); ++k) {
                    const Vec2 here = seen(view, line.points[k]);
                    middle += here / static_cast<double>(line.points.size());
                    if (k == 0) continue;
                    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
                        const Vec2 before = seen(view, line.points[k - 1]);
                        const auto found = gizmo.hit(view, before + t * (here - before));
                        REQUIRE(found);
                        grabbed.insert(*found);
                    }
                }
                if (const auto found = gizmo.hit(view, middle)) grabbed.insert(*found);
            }
            for (const GizmoPart part : shown) {
                CAPTURE(part_name(part));
                CHECK(grabbed.contains(part));
            }
            CHECK(!gizmo.hit(view, Vec2(-1000, 0)));
        }
    }
}

TEST_CASE("a plane is hit inside, but an axis before it") {
    const View view{Camera({.eye = Vec3(0, 0, 5), .ortho = 4.8}), kPicture};
    const Gizmo gizmo({.mode = GizmoMode::move, .size = 100.0});
    const auto hit = [&](double x, double y) { return gizmo.hit(view, {320 + x, 240 - y}); };
    CHECK(hit(38, 38) == GizmoPart::move_xy);
    CHECK(hit(38, 1) == GizmoPart::move_x);
    CHECK(hit(2, 60) == GizmoPart::move_y);
    CHECK(hit(3, 4) == GizmoPart::move_view);
    CHECK(!hit(-60, 0));
    CHECK(!hit(70, 70));
}

TEST_CASE("axes that are seen end-on and planes from the side are not offered") {
    for (const View& view : straight_views()) {
        if (std::abs(view.camera.forward().z()) < 0.99) continue;
        for (const auto mode : {GizmoMode::move, GizmoMode::scale, GizmoMode::all}) {
            const GizmoShape shape = Gizmo({.mode = mode}).shape(view);
            std::set<GizmoPart> parts;
            for (const auto& line : shape.lines) parts.insert(line.part);
            for (const auto& point : shape.points) parts.insert(point.part);
            for (const auto part :
                 {GizmoPart::move_z, GizmoPart::move_yz, GizmoPart::move_zx, GizmoPart::scale_z}) {
                CHECK(!parts.contains(part));
            }
            CHECK(
                parts.contains(mode == GizmoMode::scale ? GizmoPart::scale_x : GizmoPart::move_x));
        }
    }
    const View view{Camera({.eye = Vec3(1, 2, 3)}), kPicture};
    const GizmoShape shape = gizmo_with(GizmoMode::move, GizmoAxes::view).shape(view);
    for (const auto& line : shape.lines) CHECK(line.part != GizmoPart::move_z);
}

TEST_CASE("what is held stays under the cursor: along axes, in planes, around rings") {
    test::Random random(2);
    int along_axes = 0, in_planes = 0;
    for (int i = 0; i < 100; ++i) {
        const View view = random_view(random, i);
        const Gizmo gizmo =
            gizmo_with(GizmoMode::all, i % 2 == 0 ? GizmoAxes::world : GizmoAxes::local,
                       0.5 * random.direction());
        const Mat3 axes = gizmo.axes(view.camera);
        const double length = gizmo.length(view);
        const Vec3 to_eye = view.camera.is_ortho()
                                ? Vec3(-view.camera.forward())
                                : Vec3((view.camera.eye() - gizmo.origin()).normalized());
        const auto place = [&](const Vec3& direction) {
            return seen(view, gizmo.origin() + direction);
        };
        for (int k = 0; k < 3; ++k) {
            const Vec3 x = axes.col(k), y = axes.col((k + 1) % 3), z = axes.col((k + 2) % 3);
            const double from = random.uniform(0.2, 1.0) * length,
                         to = random.uniform(-2, 2) * length;
            if (x.cross(to_eye).norm() > 0.3) {
                GizmoDrag move(gizmo, part_at(k), view, place(from * x));
                CHECK((move.drag(place(to * x)).translation - (to - from) * x).norm() <
                      1e-9 * length);
                GizmoDrag scale(gizmo, part_at(11 + k), view, place(from * x));
                const double out = random.uniform(1.0, 3.0);
                const Vec3 factors = scale.drag(place(out * from * x)).factors;
                CHECK(factors[(k + 1) % 3] == 1.0);
                if (from > 0.31 * length) CHECK(factors[k] == Approx(out));
                ++along_axes;
            }
            if (std::abs(x.dot(to_eye)) < 0.3) continue;
            ++in_planes;
            const Vec2 a(random.uniform(-1, 1), random.uniform(-1, 1)),
                b(random.uniform(-2, 2), random.uniform(-2, 2));
            const auto in_plane = [&](const Vec2& p) {
                return Vec3(length * (p.x() * y + p.y() * z));
            };
            GizmoDrag move(gizmo, part_at(3 + k), view, place(in_plane(a)));
            CHECK((move.drag(place(in_plane(b))).translation - in_plane(b - a)).norm() <
                  1e-9 * length);
            CHECK((move.motion().amount - length * (b - a)).norm() < 1e-9 * length);
            // Twice around and back a part, in steps.
            const auto on_ring = [&](double angle) {
                return place(length * (std::cos(angle) * y + std::sin(angle) * z));
            };
            const double start = random.uniform(0.0, 6.0);
            GizmoDrag turn(gizmo, part_at(7 + k), view, on_ring(start));
            for (const double way : {1.0, -1.0}) {
                for (int degrees = 0; degrees <= 800; degrees += 20) {
                    const double angle = way * degrees * kDegree;
                    CHECK(turn.drag(on_ring(start + angle)).angle == Approx(angle).epsilon(1e-9));
                }
                for (int degrees = 780; degrees >= 0; degrees -= 20) {
                    turn.drag(on_ring(start + way * degrees * kDegree));
                }
            }
            CHECK(std::abs(turn.motion().angle) < 1e-9);
            CHECK((turn.motion().axis - x).norm() < 1e-12);
        }
        const Vec2 press = place(Vec3::Zero()), drop(500, 100);
        GizmoDrag move(gizmo, GizmoPart::move_view, view, press);
        CHECK((place(move.drag(drop).translation) - drop).norm() < 1e-6);
    }
    CHECK(along_axes > 200);
    CHECK(in_planes > 150);
}

TEST_CASE("counter-clockwise in the picture is a positive turn about the direction to the viewer") {
    const View view{Camera({.eye = Vec3(0, 0, 5)}), kPicture};
    for (const auto part : {GizmoPart::rotate_view, GizmoPart::rotate_z}) {
        GizmoDrag turn(Gizmo(), part, view, Vec2(400, 240));
        const GizmoMotion& motion = turn.drag(Vec2(320, 160));
        CHECK(motion.angle == Approx(kPi / 2));
        CHECK((motion.affine()(Vec3::UnitX()) - Vec3::UnitY()).norm() < 1e-12);
    }
}

TEST_CASE("whole paths of the cursor move every part continuously and back to where it was") {
    test::Random random(3);
    std::vector<View> views = straight_views();
    for (int i = 0; i < 12; ++i) views.push_back(random_view(random, i));
    for (std::size_t v = 0; v < views.size(); ++v) {
        const View& view = views[v];
        // Off the paths, which otherwise pass by it: there an angle may change fast.
        const Vec3 origin = view.camera.unproject(
            view.camera.project(view.camera.target(), kPicture) + Vec3(17, 9, 0), kPicture);
        const Gizmo gizmo({.origin = origin});
        for (int i = 0; i < kParts; ++i) {
            for (int path = 0; path < 3; ++path) {
                CAPTURE(v);
                CAPTURE(i);
                CAPTURE(path);
                const auto follow = [&](int steps) {
                    return follow_path(GizmoDrag(gizmo, part_at(i), view, on_path(0.0, path)), path,
                                       steps);
                };
                const Followed coarse = follow(2000), fine = follow(8000);
                CHECK(fine.finite);
                CHECK(fine.greatest < 0.6 * coarse.greatest + 1e-12);
                const double turns = fine.last.angle / (2.0 * kPi);
                CHECK(std::abs(turns - std::round(turns)) < 1e-12);
                CHECK(fine.last.translation == Vec3::Zero());
                CHECK(fine.last.factors == Vec3::Ones());
            }
        }
    }
}

TEST_CASE("a cursor that goes once around its origin turns a ring once, however it is seen") {
    const View view{Camera({.eye = Vec3(0, 1.5, 5)}), kPicture};
    const Gizmo gizmo;
    const auto around = [&](GizmoPart part, double radius) {
        const Vec2 center = seen(view, Vec3::Zero());
        GizmoDrag drag(gizmo, part, view, center + Vec2(radius, 0));
        for (int k = 1; k <= 200; ++k) {
            const double angle = -2.0 * kPi * k / 200;
            drag.drag(center + radius * Vec2(std::cos(angle), std::sin(angle)));
        }
        return drag.motion().angle;
    };
    for (const double radius : {8.0, 90.0, 2000.0}) {
        CHECK(around(GizmoPart::rotate_view, radius) == Approx(2.0 * kPi));
        CHECK(around(GizmoPart::rotate_z, radius) == Approx(2.0 * kPi));
        CHECK(around(GizmoPart::rotate_y, radius) == Approx(2.0 * kPi));
        // From the side there is no around: back is back.
        CHECK(around(GizmoPart::rotate_x, radius) == Approx(0.0));
    }
}

TEST_CASE("a ring that is seen from the side turns along its line") {
    const View view{Camera({.eye = Vec3(0, 0, 5), .ortho = 4.8}), kPicture};
    const Gizmo gizmo({.size = 100.0});
    // The front of a ring about y moves to the right when it turns on.
    GizmoDrag turn(gizmo, GizmoPart::rotate_y, view, Vec2(320, 240));
    CHECK(turn.drag(Vec2(420, 240)).angle == Approx(1.0));
    CHECK(turn.drag(Vec2(420, 400)).angle == Approx(1.0));
    CHECK(turn.drag(Vec2(320 - 1000, 240)).angle == Approx(-10.0));
    GizmoDrag other(gizmo, GizmoPart::rotate_x, view, Vec2(320, 240));
    CHECK(other.drag(Vec2(320, 340)).angle == Approx(1.0));
}

TEST_CASE("snapping takes whole steps from the press") {
    const View view{Camera({.eye = Vec3(0, 0, 5), .ortho = 4.8}), kPicture};
    const Gizmo gizmo({.size = 100.0});
    const GizmoModifiers snap{.snap = true};
    GizmoDrag turn(gizmo, GizmoPart::rotate_view, view, Vec2(420, 240));
    CHECK(turn.drag(Vec2(420, 210), snap).angle == Approx(15 * kDegree));
    CHECK(turn.drag(Vec2(420, 230), snap).angle == 0.0);
    // A pixel is a hundredth: by default steps of a tenth.
    GizmoDrag move(gizmo, GizmoPart::move_xy, view, Vec2(320, 240));
    CHECK((move.drag(Vec2(347, 200), snap).translation - Vec3(0.3, 0.4, 0)).norm() < 1e-12);
    GizmoDrag by_length(gizmo, GizmoPart::move_x, view, Vec2(320, 240), {.length = 0.25});
    CHECK((by_length.drag(Vec2(355, 200), snap).translation - Vec3(0.25, 0, 0)).norm() < 1e-12);
    GizmoDrag scale(gizmo, GizmoPart::scale_x, view, Vec2(420, 240));
    CHECK(scale.drag(Vec2(458, 240), snap).factors.x() == Approx(1.4));
    CHECK(scale.drag(Vec2(-2000, 240), snap).factors.x() == Approx(0.1));
    CHECK(scale.drag(Vec2(-2000, 240)).factors.x() > 0.0);
}

TEST_CASE("precision slows the cursor down from where it is, without a jump") {
    const View view{Camera({.eye = Vec3(0, 0, 5), .ortho = 4.8}), kPicture};
    const Gizmo gizmo({.size = 100.0});
    const GizmoModifiers precise{.precise = true};
    GizmoDrag move(gizmo, GizmoPart::move_x, view, Vec2(320, 240));
    CHECK(move.drag(Vec2(370, 240)).translation.x() == Approx(0.5));
    CHECK(move.drag(Vec2(370, 240), precise).translation.x() == Approx(0.5));
    CHECK(move.drag(Vec2(420, 240), precise).translation.x() == Approx(0.55));
    CHECK(move.drag(Vec2(420, 240)).translation.x() == Approx(0.55));
    CHECK(move.drag(Vec2(430, 240)).translation.x() == Approx(0.65));
    GizmoDrag turn(gizmo, GizmoPart::rotate_z, view, Vec2(420, 240));
    turn.drag(Vec2(420, 240), precise);
    CHECK(turn.drag(Vec2(320, 140), precise).angle == Approx(kPi / 20));
}

TEST_CASE("typed numbers take the place of the cursor") {
    const View view{Camera({.eye = Vec3(1, 2, 5)}), kPicture};
    const Gizmo gizmo = gizmo_with(GizmoMode::all, GizmoAxes::local, Vec3(1, 0, 0));
    const Mat3 axes = gizmo.axes(view.camera);
    const auto drag = [&](GizmoPart part) { return GizmoDrag(gizmo, part, view, Vec2(10, 20)); };
    CHECK(drag(GizmoPart::move_y).set_amount(2.5).translation == 2.5 * axes.col(1));
    const Vec3 in_plane = drag(GizmoPart::move_zx).set_amount(Vec2(1.0, -2.0)).translation;
    CHECK((in_plane - (axes.col(2) - 2.0 * axes.col(0))).norm() < 1e-12);
    CHECK(drag(GizmoPart::rotate_x).set_amount(5.0 * kPi).angle == 5.0 * kPi);
    CHECK(drag(GizmoPart::scale_y).set_amount(-3.0).factors == Vec3(1, -3, 1));
    CHECK(drag(GizmoPart::scale_all).set_amount(0.5).factors == Vec3::Constant(0.5));
    GizmoDrag again = drag(GizmoPart::move_y);
    again.set_amount(7.0);
    CHECK(again.drag(Vec2(10, 20)).translation == Vec3::Zero());
}

TEST_CASE("a motion is about the gizmo's origin, and the gizmo moves along") {
    const View view{Camera({.eye = Vec3(1, 2, 8)}), kPicture};
    const Vec3 origin(1, -1, 0.5);
    const Gizmo gizmo = gizmo_with(GizmoMode::all, GizmoAxes::local, origin);
    const Mat3 axes = gizmo.axes(view.camera);
    for (int i = 0; i < kParts; ++i) {
        GizmoDrag drag(gizmo, part_at(i), view, Vec2(100, 100));
        CHECK(drag.motion().affine().is_identity());
        const GizmoMotion& motion = drag.set_amount(0.3);
        const Affine map = motion.affine();
        CHECK((map(origin) - origin - motion.translation).norm() < 1e-12);
        CHECK((drag.moved().origin() - map(origin)).norm() < 1e-12);
        if (motion.kind == GizmoKind::rotate) {
            CHECK((drag.moved().axes(view.camera) - map.linear * axes).norm() < 1e-12);
        }
        if (motion.kind == GizmoKind::scale) {
            const Vec3 along = axes * Vec3(1, 2, 3);
            CHECK((map(origin + along) - origin - axes * motion.factors.cwiseProduct(Vec3(1, 2, 3)))
                      .norm() < 1e-12);
        }
    }
}

TEST_CASE("a gizmo behind the camera shows nothing, and cannot be dragged") {
    const View view{Camera({.eye = Vec3(0, 0, 5)}), kPicture};
    const Gizmo gizmo = gizmo_with(GizmoMode::all, GizmoAxes::world, Vec3(0, 0, 6));
    CHECK(gizmo.shape(view).lines.empty());
    CHECK(gizmo.shape(view).points.empty());
    CHECK(!gizmo.hit(view, Vec2(320, 240)));
    const auto code = [](const auto& action) { return test::error_of(action).code(); };
    CHECK(code([&] { GizmoDrag(gizmo, GizmoPart::move_x, view, Vec2(0, 0)); }) ==
          ErrorCode::invalid_argument);
}

TEST_CASE("part names go back and forth, and gizmos without sense are refused") {
    std::set<std::string_view> names;
    for (int i = 0; i < kParts; ++i) {
        CHECK(find_part(part_name(part_at(i))) == part_at(i));
        names.insert(part_name(part_at(i)));
    }
    CHECK(names.size() == kParts);
    CHECK(!find_part("move-w"));
    const auto code = [](const auto& action) { return test::error_of(action).code(); };
    CHECK(code([] { Gizmo({.origin = Vec3(test::kNaN, 0, 0)}); }) == ErrorCode::not_finite);
    CHECK(code([] { Gizmo({.size = 0.0}); }) == ErrorCode::invalid_argument);
    CHECK(code([] { Gizmo({.local = 2.0 * Mat3::Identity()}); }) == ErrorCode::invalid_argument);
    const View view{Camera(), kPicture};
    GizmoDrag drag(Gizmo(), GizmoPart::scale_x, view, Vec2(400, 240));
    CHECK(code([&] { drag.drag(Vec2(test::kNaN, 0)); }) == ErrorCode::not_finite);
    CHECK(code([&] { drag.set_amount(0.0); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { drag.set_amount(test::kInfinity); }) == ErrorCode::not_finite);
    CHECK(code([&] { GizmoDrag(Gizmo(), GizmoPart::move_x, view, Vec2(0, 0), {.length = 0.0}); }) ==
          ErrorCode::invalid_argument);
}
