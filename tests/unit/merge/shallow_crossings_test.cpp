#include "kernel/merge/crossings/shallow_crossings.h"

#include <doctest/doctest.h>

#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/shapes/shapes.h"

using namespace lissom;

namespace {

// Two balls of radius 1 that reach into one another by `overlap`.
Mesh balls(double overlap) {
    Mesh mesh = make_sphere({.segments = 24});
    Mesh other = mesh;
    for (Vec3& p : other.edit_positions()) p += Vec3(2.0 - overlap, 0.013, 0.017);
    append(mesh, other);
    return mesh;
}

bool shallow(const Mesh& mesh, double depth) {
    const std::vector<FacePair> pairs = self_intersections(mesh);
    REQUIRE(!pairs.empty());
    return is_shallow(mesh, pairs, depth, {});
}

}  // namespace

TEST_CASE("surfaces that reach into one another by less than the depth are shallow, others not") {
    CHECK(shallow(balls(0.01), 0.02));
    CHECK(!shallow(balls(0.2), 0.02));
    CHECK(shallow(balls(0.2), 0.25));
    Mesh inside_out = balls(0.01);
    flip(inside_out);
    CHECK(shallow(inside_out, 0.02));
}
