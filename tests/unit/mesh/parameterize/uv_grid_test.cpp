#include "kernel/mesh/parameterize/uv_grid.h"

#include "tests/unit/mesh/parameterize/parameterize_support.h"

using namespace lissom;
using namespace lissom::test;
using doctest::Approx;

namespace {

// The first triangle whose weights are all at least -`tolerance`, over all of them.
std::optional<UvPoint> by_trying_all(std::span<const Vec2> uv, std::span<const Triangle> triangles,
                                     const Vec2& p, double tolerance) {
    const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Vec2 &a = uv[triangles[t][0]], &b = uv[triangles[t][1]], &c = uv[triangles[t][2]];
        const double whole = cross(b - a, c - a);
        if (whole == 0.0) continue;
        const Vec3 w = Vec3(cross(b - p, c - p), cross(c - p, a - p), cross(a - p, b - p)) / whole;
        if (w.minCoeff() >= -tolerance) return UvPoint{index_of(t), w};
    }
    return {};
}

void check_against_all(const Parameterization& map, Random& random) {
    const UvGrid grid(map.uv, map.surface_triangles());
    double reach = 0.0;
    for (const Vec2& p : map.uv) reach = std::max(reach, 1.1 * p.norm());
    Index inside = 0;
    for (int i = 0; i < 400; ++i) {
        const Vec2 p(random.uniform(-reach, reach), random.uniform(-reach, reach));
        const auto found = grid.locate(p);
        const auto wanted = by_trying_all(map.uv, map.surface_triangles(), p, 1e-9);
        REQUIRE(found.has_value() == wanted.has_value());
        if (!found) continue;
        ++inside;
        CHECK(found->triangle == wanted->triangle);
        CHECK((found->barycentric - wanted->barycentric).norm() < 1e-9);
    }
    CHECK(inside > 50);
    CHECK(inside < 400);
}

}  // namespace

TEST_CASE("points of the plane are found in the triangles where a search through all finds them") {
    Random random(11);
    check_against_all(laid_out(bumpy_cap(), ParameterizeMethod::arap), random);
    check_against_all(laid_out(uneven_grid(), ParameterizeMethod::arap), random);
    check_against_all(laid_out(uneven_grid(), ParameterizeMethod::tutte), random);
    check_against_all(laid_out(grid_with_holes(), ParameterizeMethod::lscm), random);
}

TEST_CASE("triangles that are turned over or cover one another are found too, the first of them") {
    Random random(2);
    std::vector<Vec2> uv;
    std::vector<Triangle> triangles;
    for (Index t = 0; t < 300; ++t) {
        for (int k = 0; k < 3; ++k) uv.emplace_back(random.uniform(0, 1), random.uniform(0, 1));
        triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    const UvGrid grid(uv, triangles);
    for (int i = 0; i < 300; ++i) {
        const Vec2 p(random.uniform(0, 1), random.uniform(0, 1));
        const auto found = grid.locate(p), wanted = by_trying_all(uv, triangles, p, 1e-9);
        REQUIRE(found.has_value() == wanted.has_value());
        if (found) CHECK(found->triangle == wanted->triangle);
    }
}

TEST_CASE("vertices and points of edges are inside") {
    const Parameterization map = laid_out(bumpy_cap(), ParameterizeMethod::arap);
    const UvGrid grid(map.uv, map.surface_triangles());
    for (const Vec2& p : map.uv) CHECK(grid.locate(p).has_value());
    for (const auto& [a, b, c] : map.surface_triangles()) {
        const auto found = grid.locate(0.3 * map.uv[a] + 0.7 * map.uv[b]);
        REQUIRE(found.has_value());
        CHECK(found->barycentric.sum() == Approx(1.0));
    }
}

TEST_CASE("places without triangles hold nothing") {
    const std::vector<Vec2> uv{{0, 0}, {1, 0}, {0, 1}, {2, 0}};
    const std::vector<Triangle> one{{0, 1, 2}}, line{{0, 1, 3}};
    const UvGrid grid(uv, one);
    CHECK(grid.locate({0.3, 0.3}).has_value());
    CHECK(!grid.locate({0.6, 0.6}).has_value());
    CHECK(!grid.locate({-5.0, 0.3}).has_value());
    CHECK(!grid.locate({kNaN, 0.3}).has_value());
    CHECK(!UvGrid(uv, line).locate({0.5, 0.0}).has_value());
    CHECK(!UvGrid(uv, {}).locate({0.5, 0.0}).has_value());
}

TEST_CASE("points and triangles that do not exist are refused") {
    const std::vector<Vec2> uv{{0, 0}, {1, 0}, {0, 1}}, infinite{{0, 0}, {kInfinity, 0}, {0, 1}};
    const std::vector<Triangle> triangles{{0, 1, 2}}, wrong{{0, 1, 2}, {0, 1, 3}};
    CHECK(error_of([&] { UvGrid(infinite, triangles); }).code() == ErrorCode::not_finite);
    const Error error = error_of([&] { UvGrid(uv, wrong); });
    CHECK(error.code() == ErrorCode::out_of_range);
    CHECK(error.elements().ids == std::vector<Index>{1});
}
