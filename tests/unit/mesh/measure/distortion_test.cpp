#include "kernel/mesh/measure/distortion.h"

#include <algorithm>
#include <cmath>

#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

TEST_CASE("distortion: none under a rigid motion, and factors under a scale") {
    const Mesh rest = make_sphere({.segments = 6});
    Mesh moved = rest, grown = rest;
    transform(moved, rotation(Vec3(1, 2, 3).normalized(), 1.1, Vec3(0, 1, 0)));
    transform(grown, scaling(Vec3(3, 3, 3), Vec3::Zero()));
    const Distortion still = distortion(moved, rest), larger = distortion(grown, rest);
    for (std::size_t v = 0; v < still.area.size(); ++v) {
        CHECK(still.stretch[v] == Approx(1.0));
        CHECK(still.area[v] == Approx(1.0));
        CHECK(still.angle[v] < 1e-9);
        CHECK(larger.stretch[v] == Approx(3.0));
        CHECK(larger.area[v] == Approx(9.0));
        CHECK(larger.angle[v] < 1e-9);
    }
    CHECK(still.flipped.empty());
    CHECK(larger.flipped.empty());
}

TEST_CASE("distortion: a shear changes angles, and the edge that changed most counts") {
    const Mesh rest = make_grid({.size = {1, 1}, .segments = {4, 4}});
    Mesh sheared = rest;
    for (Vec3& p : sheared.edit_positions()) p.x() += p.z();
    const Distortion found = distortion(sheared, rest);
    for (std::size_t v = 0; v < found.area.size(); ++v) {
        CHECK(found.stretch[v] == Approx(std::sqrt(2.0)));
        CHECK(found.area[v] == Approx(1.0));
        CHECK(found.angle[v] == Approx(0.25 * kPi));
    }
}

TEST_CASE("distortion: faces that fold over are flipped, those of the rest are not counted") {
    const Mesh rest = make_grid({.size = {1, 1}, .segments = {6, 6}});
    Mesh folded = rest;
    const Index middle = 24;  // of 49
    Vec3 out = folded.position(middle);
    out.x() += 0.45;
    folded.set_position(middle, out);
    const Distortion found = distortion(folded, rest);
    CHECK(found.flipped.size() == 2);
    CHECK(found.flips[middle] == 2.0);
    CHECK(distortion(folded, folded).flipped.empty());
    for (const Index f : found.flipped) {
        const auto face = rest.topology().face(f);
        CHECK(std::find(face.begin(), face.end(), middle) != face.end());
    }
}

TEST_CASE("distortion: the end of a bar has not flipped as soon as the sides beside it lean") {
    const Mesh rest = make_bar({.width = 1.0, .length = 4.0, .across = 1, .along = 4});
    Index longest = 0;
    const Box box = bounds(rest);
    (box.max - box.min).maxCoeff(&longest);
    for (const double scale : {0.2, 0.9, 0.999, 1.001, 1.1, 1.5}) {
        CAPTURE(scale);
        Mesh leaning = rest;
        for (Vec3& p : leaning.edit_positions()) {
            if (p[longest] < box.max[longest] - 1e-9) continue;
            const Vec3 center = box.max[longest] * Vec3::Unit(longest);
            p = center + scale * (p - center);
        }
        CHECK(distortion(leaning, rest).flipped.empty());
    }
}

TEST_CASE("distortion: what has no size at rest has no number, and other faces are refused") {
    Mesh rest = make_grid({.size = {1, 1}, .segments = {2, 2}});
    const Mesh spread = rest;
    for (Vec3& p : rest.edit_positions()) p.setZero();
    const Distortion found = distortion(spread, rest);
    CHECK(std::isnan(found.stretch[0]));
    CHECK(std::isnan(found.area[0]));
    CHECK(std::isnan(found.angle[0]));
    const Error error = test::error_of([&] { (void)distortion(rest, make_box()); });
    CHECK(error.code() == ErrorCode::topology_mismatch);
}
