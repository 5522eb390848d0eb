#include "kernel/hair/strands/strand_place.h"

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/hair/strands/strand_support.h"

using namespace lissom;
using namespace lissom::test;

TEST_CASE("the unit of a mesh is doubted where strands are much larger or smaller than it") {
    // 0.2 m in metres, centimetres and millimetres.
    const Strands strands = random_hair(20);
    for (const double unit : {1.0, 0.01, 0.001}) {
        CAPTURE(unit);
        const Mesh mesh = make_sphere({.radius = 0.1 / unit});
        CHECK(doubt_about_unit(strands, mesh, unit).empty());
        CHECK(!doubt_about_unit(strands, mesh, 100.0 * unit).empty());
        CHECK(!doubt_about_unit(strands, mesh, unit / 100.0).empty());
    }
}

TEST_CASE("of strands without any extent nothing is said about the unit") {
    const Strands point = strands_of({{{0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}}});
    CHECK(doubt_about_unit(point, make_sphere({.radius = 0.1}), 1.0).empty());
}
