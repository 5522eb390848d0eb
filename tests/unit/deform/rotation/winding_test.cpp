#include "kernel/deform/rotation/winding.h"

#include <Eigen/Geometry>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Scene bar_scene() {
    BarOptions options;
    options.across = 6;
    options.along = 30;
    return make_scene(make_bar(options), 0.1);
}

// Turns the top of the bar about its long axis by `degrees`.
void twist(Edit& edit, double degrees) {
    const Vec3 center = edit.deformer.handle(edit.high).center;
    const Vec3 turn = degrees * kDegree * Vec3::UnitY();
    edit.deformer.set_transform(edit.high, rotation(Vec3::UnitY(), turn.norm(), Vec3::Zero()),
                                center, turn);
}

// The angle, 0 to 360 degrees, by which the middle of the bar has turned.
double middle_angle(const Scene& scene, const std::vector<Vec3>& positions) {
    double cosine = 0.0, sine = 0.0;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        const Vec3& p = scene.mesh.position(v);
        if (std::abs(p.y()) > 1e-6) continue;
        const Vec3& q = positions[v];
        cosine += p.x() * q.x() + p.z() * q.z();
        sine += p.z() * q.x() - p.x() * q.z();
    }
    const double angle = std::atan2(sine, cosine) / kDegree;
    return angle < -1e-6 ? angle + 360.0 : angle;
}

}  // namespace

TEST_CASE("turn: the rotation vector nearest to where it was") {
    const Vec3 axis = Vec3(1.0, 2.0, -0.5).normalized();
    for (const double angle : {-7.0, -kPi, -0.1, 0.0, 0.2, 3.0, 3.3, 6.2, 6.4, 30.0}) {
        const Mat3 rotation = rotation_of_turn(angle * axis);
        CHECK((turn_near(rotation, (angle + 0.3) * axis) - angle * axis).norm() < 1e-8);
        CHECK((turn_near(rotation, (angle - 0.3) * axis) - angle * axis).norm() < 1e-8);
    }
    CHECK((turn_near(Mat3::Identity(), 6.0 * axis) - 2.0 * kPi * axis).norm() < 1e-12);
    CHECK(turn_near(Mat3::Identity(), 1.0 * axis).norm() < 1e-12);
}

TEST_CASE("turn: further turns add up along one axis, and about others follow the path") {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
    CHECK((turned(3.0 * x, 5.0 * x) - 8.0 * x).norm() < 1e-12);
    const Vec3 turn = turned(7.0 * x, 0.5 * y);
    CHECK((rotation_of_turn(turn) - rotation_of_turn(0.5 * y) * rotation_of_turn(7.0 * x)).norm() <
          1e-9);
    CHECK(turn.norm() == doctest::Approx(7.0).epsilon(0.1));
}

TEST_CASE("winding: the middle of a twisted bar turns half as far, at every angle") {
    const Scene scene = bar_scene();
    Edit edit = make_edit(scene);
    for (const double degrees : {60.0, 120.0, 135.0, 150.0, 170.0, 190.0, 270.0, 360.0, 540.0}) {
        CAPTURE(degrees);
        twist(edit, degrees);
        const double expected = std::fmod(0.5 * degrees, 360.0);
        CHECK(middle_angle(scene, edit.deformer.solve()) ==
              doctest::Approx(expected).epsilon(0.01));
    }
}

TEST_CASE("winding: a drag through half a turn goes on, and leaves no trace when it comes back") {
    const Scene scene = bar_scene();
    Edit edit = make_edit(scene);
    const auto drag = [&](double degrees) {
        const Vec3 center = edit.deformer.handle(edit.high).center;
        edit.deformer.set_transform(edit.high, rotation(Vec3::UnitY(), degrees * kDegree, center));
    };
    drag(100.0);
    const std::vector<Vec3> before = edit.deformer.solve();
    for (double degrees = 110.0; degrees <= 360.0; degrees += 10.0) drag(degrees);
    CHECK((edit.deformer.pose(edit.high).turn - 2.0 * kPi * Vec3::UnitY()).norm() < 1e-9);
    CHECK(middle_angle(scene, edit.deformer.solve()) == doctest::Approx(180.0).epsilon(0.01));
    for (double degrees = 350.0; degrees >= 100.0; degrees -= 10.0) drag(degrees);
    CHECK(edit.deformer.solve() == before);
    for (double degrees = 90.0; degrees >= 0.0; degrees -= 10.0) drag(degrees);
    CHECK(edit.deformer.solve() == rest_positions_of(edit.deformer));
}

TEST_CASE("winding: no step where one field takes over from the other") {
    const Scene scene = bar_scene();
    Edit edit = make_edit(scene);
    std::vector<Vec3> last;
    double least = 1e300, greatest = 0.0;
    for (double degrees = 110.0; degrees <= 160.0; degrees += 2.0) {
        twist(edit, degrees);
        const std::vector<Vec3> now = edit.deformer.solve();
        double step = 0.0;
        for (std::size_t i = 0; i < last.size(); ++i) {
            step = std::max(step, (now[i] - last[i]).norm());
        }
        if (!last.empty()) least = std::min(least, step);
        greatest = std::max(greatest, step);
        last = now;
    }
    CHECK(greatest < 2.5 * least);
}

TEST_CASE("winding: what all handles share does not count") {
    const Scene scene = bar_scene();
    Edit edit = make_edit(scene);
    const Vec3 turn = 400.0 * kDegree * Vec3(1.0, 1.0, 0.0).normalized();
    const Affine map = rotation(turn, turn.norm(), Vec3::Zero());
    edit.deformer.set_transform(edit.low, map, Vec3::Zero(), turn);
    edit.deformer.set_transform(edit.high, map, Vec3::Zero(), turn);
    const std::vector<Vec3>& positions = edit.deformer.solve();
    double worst = 0.0;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        worst = std::max(worst, (positions[v] - map(scene.mesh.position(v))).norm());
    }
    CHECK(worst < 1e-9 * scene.size);
}

TEST_CASE("winding: custom normals turn as far as the surface") {
    Scene scene = bar_scene();
    Attribute normals{"normal", Domain::vertex, 3, ScalarType::float32, {}};
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        normals.values.insert(normals.values.end(), {1.0, 0.0, 0.0});
    }
    scene.mesh.attributes().add(normals);
    // Half way along and in the middle of the sides: beside it the twisted surface leans over.
    const auto counts = [&](Index v) {
        const Vec3& at = scene.mesh.position(v);
        return std::abs(at.y()) < 1e-6 && std::abs(at.z()) < 1e-6;
    };
    Edit edit = make_edit(scene);
    Mesh mesh = scene.mesh;
    twist(edit, 360.0);
    edit.deformer.solve();
    edit.deformer.apply_to(mesh);
    const Attribute& turned_normals = *mesh.attributes().find("normal");
    double worst = 0.0;
    int counted = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (!counts(v)) continue;
        ++counted;
        const auto n = turned_normals.at(v);
        worst = std::max(worst, (Vec3(n[0], n[1], n[2]) + Vec3::UnitX()).norm());
    }
    CHECK(counted == 2);
    CHECK(worst < 0.2);
    edit.deformer.rebase();
    twist(edit, 0.0);
    edit.deformer.solve();
    edit.deformer.apply_to(mesh);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (!counts(v)) continue;
        const auto n = mesh.attributes().find("normal")->at(v);
        worst = std::max(worst, (Vec3(n[0], n[1], n[2]) + Vec3::UnitX()).norm());
    }
    CHECK(worst < 0.2);
}
