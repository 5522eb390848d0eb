#include "kernel/merge/crossings/hidden_crossings.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/shapes/shapes.h"

using namespace lissom;

namespace {

// Two balls of radius .3 that run through one another.
Mesh two_balls() {
    Mesh mesh = make_sphere({.radius = 0.3, .segments = 16});
    Mesh other = mesh;
    for (Vec3& p : other.edit_positions()) p += Vec3(0.4, 0.013, 0.017);
    append(mesh, other);
    return mesh;
}

// The part of the pairs that is hidden.
double hidden_share(const Mesh& mesh) {
    const std::vector<FacePair> pairs = self_intersections(mesh);
    REQUIRE(!pairs.empty());
    const std::vector<char> hidden = hidden_pairs(mesh, pairs, {});
    REQUIRE(hidden.size() == pairs.size());
    return static_cast<double>(std::count(hidden.begin(), hidden.end(), 1)) /
           static_cast<double>(pairs.size());
}

// A tube of radius 1 from y = -6 to 2 around them, open at the lower end and closed at the other.
Mesh within_bottle() {
    Mesh mesh = two_balls();
    Mesh bottle = make_cylinder({.radius = 1.0, .height = 8.0, .segments = 24, .caps = false});
    for (Vec3& p : bottle.edit_positions()) p.y() -= 2.0;
    append(mesh, bottle);
    Mesh lid = make_sphere({.radius = 1.05, .segments = 24});
    for (Vec3& p : lid.edit_positions()) p += Vec3(0.0, 3.0, 0.0);
    append(mesh, lid);
    return mesh;
}

}  // namespace

TEST_CASE(
    "crossings in the open are seen, within a closed body or far down a tube they are hidden") {
    CHECK(hidden_share(two_balls()) == 0.0);
    Mesh within = two_balls();
    append(within, make_sphere({.radius = 2.0, .segments = 24}));
    CHECK(hidden_share(within) == 1.0);
    CHECK(hidden_share(within_bottle()) == 1.0);
}
