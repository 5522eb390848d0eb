#include "kernel/mesh/parameterize/parameterize.h"

#include <numeric>

#include "tests/unit/mesh/parameterize/parameterize_support.h"

using namespace lissom;
using namespace lissom::test;
using doctest::Approx;

namespace {

constexpr ParameterizeMethod kMethods[] = {ParameterizeMethod::lscm, ParameterizeMethod::arap,
                                           ParameterizeMethod::tutte};

// The xz plane seen from +y.
std::vector<Vec2> seen_from_above(const Mesh& mesh, const Parameterization& map) {
    std::vector<Vec2> points;
    for (const Index v : map.vertex) {
        points.emplace_back(mesh.position(v).z(), mesh.position(v).x());
    }
    return points;
}

void check_one_to_one(const Parameterization& map) {
    CHECK(map.flipped.empty());
    CHECK(map.flipped_fill == 0);
    CHECK(map.boundary_crossings == 0);
}

}  // namespace

TEST_CASE("a flat region is laid out as it is: up to scale by lscm, exactly by arap") {
    for (const Mesh& mesh : {make_grid({}), uneven_grid(), grid_with_holes()}) {
        for (const bool close_holes : {true, false}) {
            const Parameterization conformal =
                laid_out(mesh, ParameterizeMethod::lscm, close_holes);
            CHECK(deviation(conformal.uv, seen_from_above(mesh, conformal), false) < 1e-7);
            const Parameterization rigid = laid_out(mesh, ParameterizeMethod::arap, close_holes);
            CHECK(rigid.method == ParameterizeMethod::arap);
            CHECK(deviation(rigid.uv, seen_from_above(mesh, rigid), true) < 1e-7);
            CHECK(rigid.least_scale == Approx(1.0).epsilon(1e-6));
            CHECK(rigid.greatest_scale == Approx(1.0).epsilon(1e-6));
            check_one_to_one(rigid);
        }
    }
}
