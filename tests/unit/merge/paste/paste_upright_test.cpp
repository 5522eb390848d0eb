// The way that parts are turned on targets of all kinds.
#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/paste/paste.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/merge/paste/paste_shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A ball with a bump in front; up is y on it.
Mesh nosed_ball() {
    Mesh mesh = make_sphere({1.0, 24, SphereKind::triangles});
    for (Vec3& p : mesh.edit_positions()) {
        const double square = p.x() * p.x() + p.y() * p.y() + (p.z() - 1.0) * (p.z() - 1.0);
        p *= 1.0 + 0.35 * std::exp(-square / 0.04);
    }
    return mesh;
}

Paste nose_at(const Mesh& nose, const Mesh& target, const PastePlacement& placement) {
    return {nose,         target,       select_sphere(nose, {0, 0, 1.1}, 0.6),
            std::nullopt, std::nullopt, placement};
}

Vec3 middle_of(std::span<const Vec3> points) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points) sum += p;
    return sum / static_cast<double>(points.size());
}

// The direction on the target that the part's up has become, by its boundary.
Vec3 up_on_target(const Paste& paste, const Mesh& source, const Vec3& up) {
    const Path loop = paste.loop(), image = paste.image();
    std::vector<Vec3> from;
    for (const Index v : loop.vertices()) from.push_back(source.position(v));
    const std::span<const Vec3> to = image.points();
    REQUIRE(from.size() == to.size());
    const Vec3 middle = middle_of(from), center = middle_of(to);
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < from.size(); ++k) {
        sum += (from[k] - middle).dot(up) * (to[k] - center);
    }
    return sum.normalized();
}

// The angle between the part's up and the world's, as far as the surface allows that.
double lean(const Paste& paste, const Mesh& source, const Mesh& target, const Vec3& at) {
    const Vec3 normal = SpatialTree(target).nearest(at).normal;
    const Vec3 up = Vec3::UnitY() - normal.y() * normal;
    const Vec3 found = up_on_target(paste, source, Vec3::UnitY());
    return angle_between(up, found - found.dot(normal) * normal);
}

struct UprightCase {
    std::string name;
    Mesh target;
    Vec3 at;
    double scale;
};

Mesh turned_mesh(Mesh mesh, const Vec3& axis, double degrees) {
    const Mat3 turn = Eigen::AngleAxisd(degrees * kDegree, axis.normalized()).toRotationMatrix();
    for (Vec3& p : mesh.edit_positions()) p = turn * p;
    return mesh;
}

Mesh slope(double degrees) {
    GridOptions options;
    options.size = {6.0, 6.0};
    options.segments = {30, 30};
    return turned_mesh(make_grid(options), Vec3::UnitX(), degrees);
}

std::vector<UprightCase> upright_cases() {
    const Mesh ball = make_sphere({3.0, 40, SphereKind::triangles});
    BoxOptions box;
    box.size = Vec3(4, 4, 4);
    const Mesh cube = make_box(box);
    const Mesh over = turned_mesh(cube, Vec3::UnitZ(), 180.0);
    const Mesh tilted = turned_mesh(cube, Vec3(1, 2, 3), 50.0);
    const Vec3 on_tilted = SpatialTree(tilted).nearest(Vec3(9, 1, 0)).position;
    return {
        {"ball, side", ball, {3, 0, 0}, 0.8},
        {"ball, back", ball, {0, 0, -3}, 0.8},
        {"ball, high", ball, Vec3(2, 2, 1).normalized() * 3.0, 0.8},
        {"ball, low", ball, Vec3(-2, -2, 1).normalized() * 3.0, 0.8},
        {"cube, side", cube, {2, 0.2, 0.1}, 0.8},
        {"cube upside down", over, {2, 0.2, 0.1}, 0.8},
        {"cube, tilted", tilted, on_tilted, 0.8},
        {"steep slope", slope(60.0), {0, 0, 0}, 1.0},
        {"gentle slope", slope(30.0), {0, 0, 0}, 1.0},
        {"egg", egg(24), {1.4, 0.1, 0}, 0.5},
    };
}

}  // namespace

TEST_CASE("paste: without a direction the part's up is the world's, on targets of all kinds") {
    const Mesh nose = nosed_ball();
    for (const UprightCase& one : upright_cases()) {
        CAPTURE(one.name);
        PastePlacement placement;
        placement.at = one.at;
        placement.scale = one.scale;
        placement.up = Vec3::UnitY();
        Paste paste = nose_at(nose, one.target, placement);
        CHECK(lean(paste, nose, one.target, one.at) < 8.0 * kDegree);
        const PasteResult result = paste.merge({.draft = true});
        CHECK(result.report.upright);
        CHECK_FALSE(result.report.angle_chosen);
    }
}

TEST_CASE("paste: at poles and on level ground no way is up, and the report says so") {
    const Mesh nose = nosed_ball();
    const Mesh ball = make_sphere({3.0, 40, SphereKind::triangles});
    for (const auto& [target, at] :
         {std::pair(ball, Vec3(0, 3, 0)), std::pair(ball, Vec3(0, -3, 0)),
          std::pair(slope(0.0), Vec3(0, 0, 0))}) {
        PastePlacement placement;
        placement.at = at;
        placement.scale = 0.8;
        placement.up = Vec3::UnitY();
        const PasteResult result = nose_at(nose, target, placement).merge({.draft = true});
        CHECK_FALSE(result.report.upright);
        CHECK(result.report.angle_chosen);
    }
}

TEST_CASE("paste: a part that is turned by an angle is turned from up") {
    const Mesh nose = nosed_ball();
    const Mesh ball = make_sphere({3.0, 40, SphereKind::triangles});
    PastePlacement placement;
    placement.at = {3, 0, 0};
    placement.scale = 0.8;
    placement.up = Vec3::UnitY();
    placement.angle = 40.0 * kDegree;
    const Paste paste = nose_at(nose, ball, placement);
    CHECK(lean(paste, nose, ball, placement.at) == doctest::Approx(40.0 * kDegree).epsilon(0.1));
}

namespace {

Mesh mirrored(Mesh mesh) {
    Affine mirror;
    mirror.linear = Vec3(-1, 1, 1).asDiagonal();
    transform(mesh, mirror);
    return mesh;
}

// The vertex that lies farthest from the origin on one side of the plane x = 0.
Vec3 tip_at(const Mesh& mesh, double side) {
    Vec3 tip = Vec3::Zero();
    for (const Vec3& p : mesh.positions()) {
        if (side * p.x() > 0.0 && p.norm() > tip.norm()) tip = p;
    }
    return tip;
}

// A horn that bends to `side` along x, pasted on that side of a target.
PasteResult horn_on_side(const Mesh& horn, const Mesh& target, double side) {
    PastePlacement placement;
    placement.at = {side * 0.8, 1.5, 0.3};
    placement.up = Vec3(side, 0.0, 0.0);
    placement.toward = placement.up;
    placement.scale = 0.45;
    Paste paste(horn, target, around_horn(horn), std::nullopt, std::nullopt, placement);
    paste.optimize();
    return paste.merge();
}

}  // namespace

TEST_CASE("paste: a horn and its mirror image stand as a pair, on either side alike") {
    const Mesh horn = horned_ball();
    Mesh both = egg(40);
    std::vector<double> volumes;
    for (const double side : {1.0, -1.0}) {
        const PasteResult result = horn_on_side(side > 0.0 ? horn : mirrored(horn), both, side);
        CHECK(result.merged.report.ok);
        CHECK(result.merged.mesh.topology().is_closed());
        volumes.push_back(volume(result.merged.mesh) - volume(both));
        both = result.merged.mesh;
    }
    const Vec3 right = tip_at(both, 1.0), left = tip_at(both, -1.0);
    REQUIRE(right.norm() > 2.05);
    CHECK((right - Vec3(-left.x(), left.y(), left.z())).norm() < 0.03);
    CHECK(volumes[0] == doctest::Approx(volumes[1]).epsilon(0.05));
}

TEST_CASE("paste: the mirror image of a paste is the paste of the mirror images") {
    const Mesh horn = horned_ball(), target = egg(40);
    const PasteResult plain = horn_on_side(horn, target, 1.0);
    const PasteResult other = horn_on_side(mirrored(horn), mirrored(target), -1.0);
    CHECK(plain.merged.report.ok == other.merged.report.ok);
    const Vec3 right = tip_at(plain.merged.mesh, 1.0), left = tip_at(other.merged.mesh, -1.0);
    CHECK((right - Vec3(-left.x(), left.y(), left.z())).norm() < 0.01);
}
